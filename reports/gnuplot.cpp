#include "reports/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace veritrack::reports {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw FigureError("figures need gnuplot: " + what);
}

/// An anonymous file in memory, closed at the end of its life.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0) {
      fail(std::string("memfd_create: ") + std::strerror(errno));
    }
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  MemoryFile(MemoryFile&&) = delete;
  MemoryFile& operator=(MemoryFile&&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  void write_all(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = write(descriptor_, text.data(), text.size());
      if (written < 0) {
        fail(std::string("write: ") + std::strerror(errno));
      }
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(descriptor_, 0, SEEK_SET);
  }

  [[nodiscard]] std::string read_all() const {
    lseek(descriptor_, 0, SEEK_SET);
    std::string text;
    std::array<char, 65536> buffer{};
    for (;;) {
      const ssize_t count = read(descriptor_, buffer.data(), buffer.size());
      if (count < 0) {
        fail(std::string("read: ") + std::strerror(errno));
      }
      if (count == 0) {
        return text;
      }
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  int descriptor_;
};

/// gnuplot repeats the offending line, points at the place, and says last what is wrong.
std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) {
    return "no message";
  }
  const auto line = text.rfind('\n', end);
  const auto start = text.find_first_not_of(" \t", line == std::string::npos ? 0 : line + 1);
  return text.substr(start, end + 1 - start);
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const MemoryFile input("gnuplot-script");
  const MemoryFile output("gnuplot-output");
  const MemoryFile errors("gnuplot-errors");
  input.write_all(script);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  std::string program = "gnuplot";
  std::string no_settings = "-d";  // no ~/.gnuplot: the same figure for everyone
  std::array<char*, 3> arguments{program.data(), no_settings.data(), nullptr};
  pid_t child = 0;
  const int spawned = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (spawned != 0) {
    fail(std::strerror(spawned));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      fail(std::string("waitpid: ") + std::strerror(errno));
    }
  }
  std::string picture = output.read_all();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || picture.empty()) {
    fail(last_line(errors.read_all()));
  }
  return picture;
}

std::string gnuplot_style(std::size_t height) {
  return "set terminal svg size 820," + std::to_string(height) +
         " font 'sans-serif,13' background '#ffffff' rounded\n"
         "set datafile missing 'NaN'\n"
         "set border 3 lw 1 lc rgb '#444444'\n"
         "set tics nomirror\n"
         "set grid ytics lw 0.5 lc rgb '#cccccc'\n"
         "set xlabel offset 0,0.4\n"
         "set key outside below center horizontal Left reverse samplen 4\n";
}

std::string gnuplot_version() {
  std::string version = run_gnuplot(
      "set print '-'\nprint sprintf('gnuplot %s patchlevel %s', gprintf('%.1f', GPVAL_VERSION), "
      "GPVAL_PATCHLEVEL)\n");
  version.erase(std::find(version.begin(), version.end(), '\n'), version.end());
  return version;
}

}  // namespace veritrack::reports

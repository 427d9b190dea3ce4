#include "reports/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

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

/// Follows each picture in what gnuplot writes. No text of a picture can have it: there, "<" is "&lt;".
constexpr std::string_view kEndOfPicture = "<end of picture>";

/// Everything as gnuplot has it when it starts: its settings, and the pen that its SVG terminal would leave
/// to the next picture, which a page without anything in it resets.
constexpr std::string_view kAnew =
    "\nreset session\nset terminal svg\nset output '/dev/null'\nset multiplot\nunset multiplot\nset output\n"
    "reset session\n";

struct GnuplotRun {
  std::string output;
  std::string errors;
  bool has_succeeded = false;
};

GnuplotRun execute(const std::string& script) {
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
  return {output.read_all(), errors.read_all(), WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  GnuplotRun run = execute(script);
  if (!run.has_succeeded || run.output.empty()) {
    fail(last_line(run.errors));
  }
  return std::move(run.output);
}

std::vector<std::string> draw_pictures(const std::vector<GnuplotScript>& scripts) {
  if (scripts.empty()) {
    return {};
  }
  std::string all;
  for (const GnuplotScript& script : scripts) {
    all += all.empty() ? "" : kAnew;
    all += script.text + "\nset print '-'\nprint '" + std::string(kEndOfPicture) + "'\n";
  }
  const GnuplotRun run = execute(all);
  const std::string end = std::string(kEndOfPicture) + '\n';
  std::vector<std::string> pictures;
  std::size_t from = 0;
  for (const GnuplotScript& script : scripts) {
    const std::size_t to = run.output.find(end, from);
    if (to == std::string::npos || to == from) {
      fail(script.name + ": " + last_line(run.errors));
    }
    pictures.push_back(run.output.substr(from, to - from));
    from = to + end.size();
  }
  if (!run.has_succeeded || from != run.output.size()) {
    fail(last_line(run.errors));
  }
  return pictures;
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

std::string gnuplot_version(std::string_view svg) {
  constexpr std::string_view kBefore = "<desc>Produced by GNUPLOT ";
  const std::size_t before = svg.find(kBefore);
  const std::size_t end = svg.find(" </desc>", before);
  if (before == std::string_view::npos || end == std::string_view::npos) {
    fail("a picture without its version");
  }
  const std::size_t start = before + kBefore.size();
  return "gnuplot " + std::string(svg.substr(start, end - start));
}

}  // namespace veritrack::reports

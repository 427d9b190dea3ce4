#include "certificates/document/program.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace veritrack::certificates {

namespace {

[[noreturn]] void fail_with(const std::string& what, int error = errno) {
  throw std::system_error(error, std::generic_category(), what);
}

/// The work of the new process. Other threads may have been at work when it was made: only calls that are
/// safe in a signal handler.
[[noreturn]] void become(char* const* words, const std::array<int, 3>& streams, const std::vector<int>& files,
                         pid_t parent, const FileDescriptor& failure, unsigned seconds) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() == parent) {
    for (int stream = 0; stream < 3; ++stream) {
      ::dup2(streams.at(static_cast<std::size_t>(stream)), stream);
    }
    for (const int file : files) {
      ::fcntl(file, F_SETFD, 0);
    }
    if (seconds > 0) {
      const rlimit most{seconds, seconds + 1};
      ::setrlimit(RLIMIT_CPU, &most);
    }
    ::execvp(words[0], words);
    const int error = errno;
    static_cast<void>(::write(failure.get(), &error, sizeof error));
  }
  ::_exit(127);
}

}  // namespace

MemoryFile::MemoryFile(std::string_view content) : file_(::memfd_create("veritrack", MFD_CLOEXEC)) {
  if (!file_.is_open()) {
    fail_with("memfd_create");
  }
  while (!content.empty()) {
    const ssize_t written = file_.write(content.data(), content.size());
    if (written < 0) {
      fail_with("a file in memory");
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  ::lseek(file_.get(), 0, SEEK_SET);
}

std::string MemoryFile::text() const {
  ::lseek(file_.get(), 0, SEEK_SET);
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t count = file_.read(buffer.data(), buffer.size());
    if (count < 0) {
      fail_with("a file in memory");
    }
    if (count == 0) {
      return text;
    }
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

ProgramRun run_program(const std::string& program, const std::vector<std::string>& arguments,
                       std::string_view input, const std::vector<const MemoryFile*>& handed_over,
                       unsigned seconds) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  std::vector<int> files;
  files.reserve(handed_over.size());
  for (const MemoryFile* file : handed_over) {
    files.push_back(file->descriptor());
  }
  const MemoryFile in(input);
  const MemoryFile out;
  const MemoryFile errors;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    fail_with("a pipe");
  }
  const FileDescriptor reported(ends[0]);
  FileDescriptor failure(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) {
    fail_with("a process for " + program);
  }
  if (child == 0) {
    become(pointers.data(), {in.descriptor(), out.descriptor(), errors.descriptor()}, files, parent, failure,
           seconds);
  }
  failure.close();
  int error = 0;
  const bool is_started = reported.read(reinterpret_cast<char*>(&error), sizeof error) == 0;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      fail_with("waiting for " + program);
    }
  }
  if (!is_started) {
    fail_with(program, error);
  }
  ProgramRun run{out.text(), errors.text()};
  run.status = WEXITSTATUS(status);
  run.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return run;
}

}  // namespace veritrack::certificates

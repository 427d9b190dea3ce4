#include "cli/standard_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace veritrack::cli {

void prepare_standard_streams() {
  for (const int standard : std::array{STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(standard, F_GETFD) < 0) {
      // The lowest free descriptor, hence this one. Reading only: writing to it fails, as it should.
      (void)::open("/dev/null", O_RDONLY);
    }
  }
  (void)std::signal(SIGPIPE, SIG_IGN);
}

namespace {

int first_error = 0;  ///< of writing; what the library keeps of one does not say which

}  // namespace

void flush_standard_output() {
  if (std::fflush(stdout) != 0 && first_error == 0) {
    first_error = errno;
  }
}

void finish_standard_output() {
  const int last_error = errno;  // of what the library flushed by itself, if of nothing later
  flush_standard_output();
  if (first_error != 0 || std::ferror(stdout) != 0) {
    const int error = first_error != 0 ? first_error : last_error != 0 ? last_error : EIO;
    throw std::runtime_error("standard output cannot be written: " + std::generic_category().message(error));
  }
}

}  // namespace veritrack::cli

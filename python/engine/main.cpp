// veritrack-engine: certifies for the package for Python, in a process of its own.
//
// Why a process: a search cannot be interrupted from within, but a process can be ended at any moment; what
// goes wrong in it does not take the interpreter along; and the rounding modes of proofs never meet those of
// the interpreter. It answers one request at a time, a line of JSON each way (answers.hpp), and ends with its
// standard input.
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <thread>

#include "python/engine/answers.hpp"

namespace {

constexpr int kBroken = 2;

/// Ends the process when nobody can ask any more, even in the middle of a search: whoever asked was killed.
void end_with_standard_input() {
  pollfd input{STDIN_FILENO, 0, 0};
  while (::poll(&input, 1, -1) <= 0 || (input.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0) {
  }
  ::_exit(0);
}

/// Answers go to what was the standard output. The output of a library goes to standard error.
std::FILE* take_standard_output() {
  const int descriptor = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (descriptor < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    return nullptr;
  }
  return ::fdopen(descriptor, "w");
}

bool say(std::FILE* output, const veritrack::python::Json& json) {
  // Bytes that are not UTF-8 can only come from a design, and are reported as such in its messages.
  const std::string line =
      json.dump(-1, ' ', false, veritrack::python::Json::error_handler_t::replace) + "\n";
  return std::fwrite(line.data(), 1, line.size(), output) == line.size() && std::fflush(output) == 0;
}

}  // namespace

int main() {
  std::FILE* output = take_standard_output();
  if (output == nullptr) {
    return kBroken;
  }
  try {
    if (!say(output, veritrack::python::greeting())) {
      return kBroken;
    }
    std::thread(end_with_standard_input).detach();
    for (std::string line; std::getline(std::cin, line);) {
      if (!say(output, veritrack::python::answer(veritrack::python::Json::parse(line)))) {
        return kBroken;
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "veritrack-engine: %s\n", error.what());
    return kBroken;
  }
  return 0;
}

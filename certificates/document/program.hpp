// Other programs, run to their end.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/file_descriptor.hpp"

namespace veritrack::certificates {

/// An anonymous file in memory.
class MemoryFile {
 public:
  /// With this content. Throws std::system_error.
  explicit MemoryFile(std::string_view content = {});

  [[nodiscard]] int descriptor() const { return file_.get(); }
  /// For a program that it is handed over to.
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor()); }
  /// Its whole contents. Throws std::system_error.
  [[nodiscard]] std::string text() const;

 private:
  FileDescriptor file_;
};

/// The output of a program until its end.
struct ProgramRun {
  std::string output, errors;  ///< standard output and standard error
  int status = 0;              ///< its exit status; meaningless after a signal
  int signal = 0;              ///< that ended it; 0: none

  [[nodiscard]] bool has_succeeded() const { return signal == 0 && status == 0; }
};

/// Runs it with these arguments and, as its standard input, `input`, without a shell. It is looked for in
/// PATH unless there is a slash in its name, it may open the files that are handed over by their path(), and
/// it ends with this process in every case. With `seconds` above 0 it ends by SIGXCPU after so many of
/// processor time. Throws std::system_error when it cannot be started.
[[nodiscard]] ProgramRun run_program(const std::string& program, const std::vector<std::string>& arguments,
                                     std::string_view input,
                                     const std::vector<const MemoryFile*>& handed_over = {},
                                     unsigned seconds = 0);

}  // namespace veritrack::certificates

// The target that the name of an output stands for: a file to be replaced, or something that is written as it
// is.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace veritrack::certificates {

/// Thrown when an output cannot be written. what() is one line, `path: cannot be written: reason`.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::filesystem::path& path, const std::string& reason);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  std::filesystem::path path_;
  std::string reason_;
};

/// The destination of an output.
struct OutputTarget {
  std::filesystem::path name;  ///< as the user gave it, for messages
  std::filesystem::path file;  ///< the file that is made or replaced: links are followed
  /// A device, a FIFO, or the target of standard output or error: it is opened and written, never replaced.
  bool as_it_is = false;
  int open_descriptor = -1;  ///< standard output or error when the target is that; otherwise negative
};

/// Follows links, so that a link stays a link. Throws OutputError for a directory, a name without a file, and
/// links in a circle.
[[nodiscard]] OutputTarget resolve_output(const std::filesystem::path& name);

/// True when both name one thing: one file, existing or to be made.
[[nodiscard]] bool same_target(const OutputTarget& a, const OutputTarget& b);

/// True when the output is that file, under this name or another.
[[nodiscard]] bool is_file(const OutputTarget& output, const std::filesystem::path& file);

}  // namespace veritrack::certificates

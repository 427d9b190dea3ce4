// Lines of a file or of standard input, in a constant amount of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "certificates/design/file_descriptor.hpp"

namespace veritrack::reports {

class LineSource {
 public:
  /// "-" is standard input. Throws certificates::InputError when the file cannot be opened or is a folder.
  explicit LineSource(const std::string& path);

  /// The next line without its end (line feed, or carriage return and line feed), valid until the next call;
  /// none at the end of the input. A byte-order mark before the first line is left out. Throws
  /// certificates::InputError when reading fails, and for a line longer than kLongestLine bytes.
  [[nodiscard]] std::optional<std::string_view> next();

  /// The number of the line that was returned last, from 1; 0 before it.
  [[nodiscard]] std::int64_t line() const { return line_; }
  /// The share of the file that has been returned; none when its size is unknown.
  [[nodiscard]] std::optional<double> progress() const;
  /// The name for messages.
  [[nodiscard]] const std::string& name() const { return name_; }

  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

 private:
  void refill();

  std::string name_;
  certificates::FileDescriptor file_;
  std::string buffer_;
  std::size_t begin_ = 0;  ///< what is left of the buffer
  std::size_t end_ = 0;
  bool at_end_ = false;
  std::int64_t line_ = 0;
  std::int64_t size_ = 0;  ///< of the file, bytes; 0 when unknown
  std::int64_t taken_ = 0;
};

}  // namespace veritrack::reports

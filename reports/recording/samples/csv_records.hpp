// Records of a CSV file (RFC 4180), one after the other.
#pragma once

#include <cstddef>
#include <list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/design.hpp"
#include "reports/recording/samples/line_source.hpp"

namespace veritrack::reports {

struct CsvField {
  std::string_view text;            ///< without quotes and, unless it was quoted, without blanks around it
  certificates::Position position;  ///< of its first character
};

/// As RFC 4180 has it: fields between commas, or between quotes, where two quotes stand for one and lines may
/// end; line ends with or without carriage return. Beyond it: fields may be parted by semicolons or tabs in
/// place of commas, which the first record decides; empty lines and lines that begin with # are left out.
class CsvRecords {
 public:
  /// "-" is standard input. Throws certificates::InputError when it cannot be opened.
  explicit CsvRecords(const std::string& path) : lines_(path) {}

  /// Goes on to the next record; false at the end. Throws certificates::InputError for a quote that is not
  /// closed or text behind one, for a record of more than 1 MiB, and what LineSource throws.
  [[nodiscard]] bool next();

  /// The fields of the record, valid until the next call of next().
  [[nodiscard]] std::span<const CsvField> fields() const { return fields_; }
  [[nodiscard]] const LineSource& lines() const { return lines_; }

  /// Throws certificates::InputError.
  [[noreturn]] void refuse(certificates::Position position, const std::string& message) const;

 private:
  void split(std::string_view line);
  /// Reads more lines until quotes are closed.
  void split_quoted(std::string_view line);
  void choose_separator(std::string_view line);
  [[nodiscard]] certificates::Position position_of(std::size_t column) const;

  LineSource lines_;
  char separator_ = 0;  ///< 0: not known yet
  std::vector<CsvField> fields_;
  std::string record_;               ///< of a record with quotes: all its lines
  std::list<std::string> unquoted_;  ///< texts of its fields
};

}  // namespace veritrack::reports

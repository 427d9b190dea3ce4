// The numbers that a figure shows: once as a data block for gnuplot, once as CSV.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace veritrack::reports {

/// A table of numbers, with words in some of its columns. The picture and the file have the same doubles:
/// with nine digits in the picture, with all of them in the file.
class FigureTable {
 public:
  using Cell = std::variant<double, std::string>;

  /// `name`: of the data block, and, unless it is the first table of a figure, of the file. `columns`: what
  /// each column is, with its unit in brackets.
  FigureTable(std::string name, std::vector<std::string> columns);

  /// A row of as many cells as there are columns; NaN and infinities are missing values. Throws
  /// std::invalid_argument for another number of cells.
  void add(std::vector<Cell> row);
  /// In the picture, lines are not drawn across it. Nothing in the file.
  void gap();
  /// In the picture, the rows up to the next are addressed by the next `index`. Nothing in the file.
  void next_index();

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Rows that are not gaps.
  [[nodiscard]] std::size_t size() const;

  /// "$name << END ... END": for a script, before `plot $name using ...`. Never empty, which gnuplot refuses.
  [[nodiscard]] std::string block() const;
  /// RFC 4180: a header, CRLF at the end of each line, quotes where they are needed; empty cells are missing.
  [[nodiscard]] std::string csv() const;

 private:
  std::string name_;
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;  // an empty row is an empty line of the block
};

/// The text as a string of a gnuplot script, quotes included: no part of it can act as a command.
[[nodiscard]] std::string gnuplot_text(std::string_view text);

/// A field of CSV: in quotes where it has a comma, a quote or a line end.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace veritrack::reports

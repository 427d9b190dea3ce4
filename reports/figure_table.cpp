#include "reports/figure_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace veritrack::reports {

namespace {

/// A word in a data block is in double quotes; what would end it or the line is left out.
std::string block_cell(const FigureTable::Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::isfinite(*number) ? fmt::format("{:.9g}", *number) : "NaN";
  }
  std::string word = std::get<std::string>(cell);
  std::erase_if(word, [](char c) { return c == '"' || c == '\\' || c == '\n' || c == '\r'; });
  return '"' + word + '"';
}

std::string csv_cell(const FigureTable::Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::isfinite(*number) ? fmt::format("{}", *number) : "";
  }
  return csv_field(std::get<std::string>(cell));
}

template <typename Row, typename Words>
std::string line_of(const Row& row, std::string_view separator, const Words& words) {
  std::string line;
  bool is_first = true;
  for (const auto& cell : row) {
    line += is_first ? "" : std::string(separator);
    line += words(cell);
    is_first = false;
  }
  return line;
}

}  // namespace

FigureTable::FigureTable(std::string name, std::vector<std::string> columns)
    : name_(std::move(name)), columns_(std::move(columns)) {}

void FigureTable::add(std::vector<Cell> row) {
  if (row.size() != columns_.size()) {
    throw std::invalid_argument(fmt::format("a row of {} cells in the table {}, which has {} columns",
                                            row.size(), name_, columns_.size()));
  }
  rows_.push_back(std::move(row));
}

void FigureTable::gap() {
  rows_.emplace_back();
}

void FigureTable::next_index() {
  gap();
  gap();
}

std::size_t FigureTable::size() const {
  return static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return !row.empty(); }));
}

std::string FigureTable::block() const {
  std::string text = "$" + name_ + " << END\n";
  for (const auto& row : rows_) {
    text += line_of(row, " ", block_cell) + "\n";
  }
  if (size() == 0) {
    text += line_of(columns_, " ", [](const std::string& /*column*/) { return std::string("NaN"); }) + "\n";
  }
  return text + "END\n";
}

std::string FigureTable::csv() const {
  std::string text = line_of(columns_, ",", csv_field) + "\r\n";
  for (const auto& row : rows_) {
    if (!row.empty()) {
      text += line_of(row, ",", csv_cell) + "\r\n";
    }
  }
  return text;
}

std::string gnuplot_text(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c == '\'' ? "''" : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
  }
  return quoted + "'";
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return std::string(text);
  }
  std::string field = "\"";
  for (const char c : text) {
    field += c == '"' ? "\"\"" : std::string(1, c);
  }
  return field + '"';
}

}  // namespace veritrack::reports

// Numbers as certificate.json writes them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/interval.hpp"
#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// Members in the order in which they were added.
using Json = nlohmann::ordered_json;

/// "lo" and "hi" as hexadecimal floats.
[[nodiscard]] Json enclosure_json(const rigor::Interval& value);

/// The same with "decimal" beside them, outward rounded for the reader of report.json.
[[nodiscard]] Json readable_enclosure_json(const rigor::Interval& value);

/// A number of the design file: its text and its enclosure.
[[nodiscard]] Json number_json(const Number& number);

/// Adds the number under that name when there is one.
void add_number(Json& json, const char* name, const std::optional<Number>& number);

/// A matrix of exact doubles, row by row, as hexadecimal floats.
template <typename Matrix>
[[nodiscard]] Json matrix_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (decltype(matrix.rows()) i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (decltype(matrix.cols()) j = 0; j < matrix.cols(); ++j) {
      row.push_back(rigor::to_hexadecimal(matrix(i, j)));
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace veritrack::certificates

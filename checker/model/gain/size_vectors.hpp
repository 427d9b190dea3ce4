// Vectors and matrices of numbers that are not negative: what is computed from them is not below what is
// meant.
#pragma once

#include <optional>
#include <vector>

#include "checker/model/gain/wide_number.hpp"

namespace veritrack::checker {

std::vector<double> product_above(const Table& matrix, const std::vector<double>& vector);
Table product_above(const Table& x, const Table& y);
void add_to(std::vector<double>& sum, const std::vector<double>& more);
/// The larger ones.
void raise_all(std::vector<double>& most, const std::vector<double>& values);

/// At least given + M T for all of these, or nothing.
std::optional<std::vector<double>> closed_together(const std::vector<const Table*>& defects,
                                                   const std::vector<std::vector<double>>& given);

}  // namespace veritrack::checker

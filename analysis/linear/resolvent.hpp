// The answer of a linear recursion x+ = A x + Re(g e^(i t phase)) to an input that turns with a signal
// (docs/gain-proof.md, section 9): Pi = (e^(i t omega) - A)^-1 g e^(i t omega).
#pragma once

#include <optional>
#include <vector>

#include "analysis/linear/worst_case_gains.hpp"

namespace veritrack::linear {

/// Upper bounds over a band. Pi = direct g + rest, with direct = e^(i t omega)/(e^(i t omega) - 1).
struct TurningResponse {
  std::vector<double> states;  ///< |Pi_j|
  std::vector<double> forms;   ///< |c Pi|
  double direct = 0.0;         ///< |direct|
  std::vector<double> rest;    ///< |rest_j|
};

/// g = real + i imaginary; `band`, rad/sample, is cut into `parts` of equal width. Empty where e^(i t omega)
/// may be an eigenvalue. Needs the upward rounding mode.
[[nodiscard]] std::optional<TurningResponse> turning_response(const std::vector<Row>& a, const Row& real,
                                                              const Row& imaginary, int turns,
                                                              const std::vector<Row>& forms,
                                                              const rigor::Interval& band, int parts);

}  // namespace veritrack::linear

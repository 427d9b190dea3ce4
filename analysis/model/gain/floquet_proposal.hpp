// A basis in which the errors about a steady state have constant coefficients: a proposal, in floating point.
#pragma once

#include <optional>

#include "analysis/model/gain/phase_step.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"

namespace veritrack::model {

/// At one frequency: basis and matrix of `curve` with A(phi) P(phi) = P(phi + omega) matrix, the mean of P
/// the identity, nearly. By Newton's method from P = I, each step a Sylvester equation for each harmonic: it
/// converges where the periodic part of A matters little, that is for loops that are slow against their
/// signal. Empty where it does not.
struct FloquetNode {
  Eigen::MatrixXcd basis;  ///< n^2 (row by row) x (H + 1): Re sum_h basis_h exp(i h phi)
  Eigen::MatrixXd matrix;  ///< n x n
};
[[nodiscard]] std::optional<FloquetNode> floquet_node(const TrackedTone& tone, const NodeCurve& curve,
                                                      int harmonics);

/// Over the frequencies low to high, rad/sample. Empty where there is no steady state, or no basis. Holds
/// round-to-nearest.
[[nodiscard]] std::optional<FloquetCell> propose_floquet_cell(const TrackedTone& tone, double low,
                                                              double high);

}  // namespace veritrack::model

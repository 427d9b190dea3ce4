// Bases in which the errors about a steady state have constant coefficients, at some frequencies: from the
// modes of the errors by Newton's method, in floating point.
#pragma once

#include <optional>
#include <vector>

#include "analysis/model/gain/floquet_modes.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"

namespace veritrack::model {

/// At one frequency: A(phi) P(phi) = P(phi + omega) [L, 0; 0, F(phi)], nearly: the modes that a grid of
/// phases resolves have a constant matrix L, with one block for each group of them; F is of what decays
/// faster, and its mean is in `matrix`.
struct FloquetNode {
  Eigen::MatrixXcd basis;  ///< n^2 (row by row) x (H + 1): Re sum_h basis_h exp(i h phi)
  Eigen::MatrixXd matrix;  ///< n x n
};

/// At the frequencies of these curves, from the middle one on, so that it depends on the frequency smoothly.
/// Empty where there is no basis.
[[nodiscard]] std::optional<std::vector<FloquetNode>> floquet_nodes(const TrackedTone& tone,
                                                                    const std::vector<NodeCurve>& curves,
                                                                    FloquetGauge gauge, int harmonics);

}  // namespace veritrack::model

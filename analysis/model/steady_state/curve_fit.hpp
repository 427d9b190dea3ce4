// The curve that a tracker follows in its steady state, over the phase and a cell of frequencies: a proposal.
//
// It starts from simulated states; Newton's method on C(phi + omega) = G(C(phi), Y(phi + omega)) on a grid of
// phases makes it as exact as doubles are. The linear equation of each step is solved by doubling
// (cocycle.hpp).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "analysis/model/steady_state/cocycle.hpp"
#include "analysis/model/steady_state/steady_state.hpp"

namespace veritrack::model {

/// At one frequency.
struct NodeCurve {
  double frequency = 0.0;  ///< rad/sample
  std::vector<int> turns;
  Eigen::MatrixXcd harmonics;  ///< n x (H + 1): C = turns phi + Re sum_h harmonics_h exp(i h phi)
  /// The largest G(C) - C between the phases of the grid, relative to the size of its state.
  double residual = 0.0;
};

/// The state at a phase.
[[nodiscard]] Eigen::VectorXd state_at(const NodeCurve& curve, double phase);
/// n x grid.size(): G(C(phi), Y(phi + omega)) - C(phi + omega) at the phases of the grid.
[[nodiscard]] Eigen::MatrixXd residual_of(const TrackedTone& tone, const NodeCurve& curve,
                                          const PhaseGrid& grid);
/// DG in states along the curve: n^2 x grid.size(), column-major matrices.
[[nodiscard]] Eigen::MatrixXd jacobians_along(const TrackedTone& tone, const NodeCurve& curve,
                                              const PhaseGrid& grid);

/// Refines a settled simulation at `frequency`, with at most `most_harmonics` harmonics. Empty when Newton's
/// method does not converge.
[[nodiscard]] std::optional<NodeCurve> fit_curve_at(const TrackedTone& tone, double frequency,
                                                    const SteadyState& settled, int most_harmonics = 128);

inline constexpr int kNodes = 5;
/// For a curve that must be known more accurately.
inline constexpr int kFineNodes = 9;

/// z of the nodes: Chebyshev's points in (-1, 1), the middle one 0.
[[nodiscard]] const std::array<double, kNodes>& node_places();
/// Coefficients of z^d, d = 0, ..., 4, of the polynomial through values at the nodes: entry (d, node).
[[nodiscard]] const Eigen::Matrix<double, kNodes, kNodes>& node_weights();

/// Over the frequencies |omega - frequency| <= half_width.
struct CurveFit {
  double frequency = 0.0;   ///< rad/sample
  double half_width = 0.0;  ///< rad/sample
  std::vector<int> turns;
  std::vector<Eigen::MatrixXcd> coefficients;  ///< of z^d, from d = 0: n x (H + 1) each
  std::vector<NodeCurve> nodes;
  /// An estimate of the distance of estimated frequencies on the curve from those on the true one,
  /// rad/sample, at worst over z in [-1, 1].
  double frequency_error = 0.0;

  /// The curve at frequency + z half_width, and its derivative by omega there.
  [[nodiscard]] NodeCurve at(double z) const;
  [[nodiscard]] Eigen::MatrixXcd slope_at(double z) const;
};

/// Fits the cell from a settled simulation at its middle. Coefficients below `negligible` of the size of
/// their state are left out. `nodes`: an odd number of frequencies, one more than the degree in z. Empty when
/// some node has no curve. Throws std::invalid_argument for a half width <= 0 and for another number of
/// nodes.
[[nodiscard]] std::optional<CurveFit> fit_curve(const TrackedTone& tone, double frequency, double half_width,
                                                const SteadyState& settled, double negligible = 1e-13,
                                                int nodes = kNodes);

}  // namespace veritrack::model

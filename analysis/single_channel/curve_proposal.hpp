// Proposals, in floating point, for the verification of an invariant curve: where it runs and in which
// coordinates the map contracts along it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/single_channel/phase_series.hpp"

namespace veritrack::single_channel {

/// How many harmonics a proposed curve has, unless it needs more.
inline constexpr std::size_t kFewHarmonics = 28;

/// The steady state that a simulation settles on from the exact estimate, in double: a proposal, no proof.
/// Nothing when it does not come out finite. `frequency` in rad/sample.
[[nodiscard]] std::optional<PhaseSeries> propose_invariant_curve(const trackers::ToneModel<double>& design,
                                                                 double frequency);

/// The same for an interval of frequencies, by interpolation; a single curve for a very narrow one.
[[nodiscard]] std::optional<PhaseFamily> propose_invariant_curves(const trackers::ToneModel<double>& design,
                                                                  const rigor::Interval& frequency);

/// Coordinates along a curve: X = C(phi) + V u, one V for each phase that was asked for.
struct CurveCoordinates {
  double rate = 1.0;  ///< by which the map is expected to contract in them
  std::vector<rigor::Matrix<9>> matrices;
};

/// V = M(phi)^(-1/2), by Cholesky, with M(phi) = sum_k rate^(-2k) Phi_k' D Phi_k over the products Phi_k of
/// the Jacobians along the orbit of phi: then DG' M(phi + omega) DG <= rate^2 M(phi). Nothing when the sum
/// does not converge, or too slowly. `frequency` in rad/sample, `phases` in rad.
[[nodiscard]] std::optional<CurveCoordinates> propose_coordinates(const trackers::ToneModel<double>& design,
                                                                  double frequency, const PhaseSeries& curve,
                                                                  const std::vector<double>& phases);

}  // namespace veritrack::single_channel

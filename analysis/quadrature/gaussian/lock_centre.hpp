// Where the tracker settles on a tone of constant frequency, roughly: the middle of a proposed set.
#pragma once

#include <array>
#include <optional>

#include "analysis/quadrature/contraction/gain_spread.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// Errors (Re delta, Im delta, nu) in the frame of the true phase and a covariance, P12 = P13 = 0.
struct LockCentre {
  std::array<double, 3> errors{};
  BlockCovariance<double> covariance{};
};

/// The steady state without noise at this frequency (rad/sample), followed from frequency 0, where the
/// estimate is exact; of its covariance the entries 12 and 13 are left out, which a leak makes different from
/// zero. Nothing when there is no steady state (q1 = 0), or when it was not reached. A proposal.
[[nodiscard]] std::optional<LockCentre> lock_centre(const trackers::ToneModel<double>& design,
                                                    double frequency);

}  // namespace veritrack::quadrature

// Where the tracker settles on a tone of constant frequency, roughly: the middle of a proposed set.
#pragma once

#include <array>
#include <optional>

#include "analysis/quadrature/gaussian/level_covariance.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// Errors (Re delta, Im delta, nu) and a covariance, in the frame of the true phase.
struct LockCentre {
  std::array<double, 3> errors{};
  LevelCovariance<double> covariance{};
};

/// The steady state without noise at this frequency (rad/sample), followed from frequency 0, where the
/// estimate is exact. Nothing when there is no steady state (q1 = 0), or when it was not reached. A proposal.
[[nodiscard]] std::optional<LockCentre> lock_centre(const trackers::ToneModel<double>& design,
                                                    double frequency);

}  // namespace veritrack::quadrature

// Which set might the noise leave seldom? Proposals in floating point; nothing here is evidence.
#pragma once

#include <array>
#include <optional>

#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The numbers that are searched: T, D_h, D_l, four each, and gamma, in coordinates in which good sets of all
/// noise levels look alike.
using LockShape = std::array<double, 13>;

/// The request for a proposal, for a signal of amplitude 1.
struct LockRequest {
  trackers::ToneModel<double> design;  ///< 0 <= epsilon < 1
  double noise_deviation = 0.0;        ///< of each channel, relative to the amplitude
  double frequency_walk = 0.0;         ///< deviation of the frequency's step, rad/sample
  double level = 27.63;                ///< L
  double decay = 0.95;                 ///< kappa
  double drift = 1.0;                  ///< c_0
  int evaluations = 400;               ///< of the search a round; some hundred take a second
  std::optional<LockShape> near;       ///< of a set for nearly the same noise: to start from, which is faster
  /// With a leak: the signal's frequencies, rad/sample.
  double lowest_frequency = 0.0, highest_frequency = 0.0;
};

/// A proposal, and its margin in the drift inequality at the sampled points of the set: the least
/// DriftInequality::margin_at.
struct LockProposal {
  LockSet set;
  double margin = 0.0;
  LockShape shape{};
};

/// The set with the largest margin found over all thirteen shape parameters; points at which the inequality
/// is worst are added on the way. Where the usual shapes fail, the shape is followed from a usual design to
/// this one, with little noise. Nothing when there is no steady state (q1 = 0). Deterministic; needs the
/// upward mode.
[[nodiscard]] std::optional<LockProposal> propose_lock_set(const LockRequest& request);

}  // namespace veritrack::quadrature

// The lowest signal-to-noise ratio at which the probability of losing lock is certified to be as small as is
// required.
#pragma once

#include "analysis/quadrature/gaussian/lock_certificate.hpp"

namespace veritrack::quadrature {

/// A LockCertificate for more noise, or less, than the question's.
struct LowestSnr {
  /// "lowest-snr": the conditions at this signal-to-noise ratio, and what follows from them.
  theorems::Derivation derivation;
  std::optional<LockSet> set;  ///< when one is certified
  std::int64_t cells = 0;
  /// Multiples of the start covariance for which the result holds.
  rigor::Interval covariance_multiples;
};

/// Looks for the most noise for which a set has a chance of being proved, by bisection of the margin at
/// sampled points in steps of a quarter of a decibel, and proves one for that noise or, if it cannot, for
/// little less: for noise for which about this many cells suffice, half a minute of one core. Samples,
/// starts, walk and probability are the question's, its noise is not: `at_its_noise`, a proposal for that,
/// only helps the search. Deterministic. Sets its own rounding mode. Throws std::invalid_argument for a
/// design with a leak.
[[nodiscard]] LowestSnr certify_lowest_snr(const LockQuestion& question,
                                           const std::optional<LockProposal>& at_its_noise,
                                           std::int64_t affordable_cells = 600'000);

/// A little more than the deviation at a ratio of this many quarters of a decibel: the tried ratios, which do
/// not depend on the assumptions.
[[nodiscard]] double deviation_at(int quarters);

/// The signal-to-noise ratio in dB of a deviation in each channel, at amplitude 1: -10 log10(2 sigma^2).
/// Needs the upward mode.
[[nodiscard]] rigor::Interval decibels_of(const rigor::Interval& deviation);

}  // namespace veritrack::quadrature

// The certificate for Gaussian noise: with which probability the tracker loses lock.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/quadrature/gaussian/lock_start.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "analysis/theorems/derivation.hpp"

namespace veritrack::quadrature {

/// What is asked, for a signal of amplitude 1.
struct LockQuestion {
  trackers::ToneModel<rigor::Interval> design;
  rigor::Interval noise_deviation;  ///< sigma of each channel, relative to the amplitude
  rigor::Interval frequency_walk;   ///< deviation of the frequency's step, rad/sample
  rigor::Interval samples;          ///< N
  /// Of the signal, rad/sample; a leak needs them.
  rigor::Interval frequencies = rigor::Interval(0.0);
  LockStarts starts;
  TrackedSignal signal;       ///< for what rounding depends on
  double probability = 1e-6;  ///< which the search is to reach
};

struct LockCertificate {
  /// "lock": the conditions, and what follows from them.
  theorems::Derivation derivation;
  /// When everything is proved of them: one set, or with a leak one for each piece of the band of
  /// frequencies.
  std::vector<LockSet> sets;
  std::int64_t cells = 0;
  /// Multiples of the start covariance for which the result holds; those of the question, or more.
  rigor::Interval covariance_multiples;
};

/// Searches and verifies. Sets its own rounding mode.
[[nodiscard]] LockCertificate certify_lock(const LockQuestion& question);

/// exp(-L) (exp(start level) + N c_0) and what noise beyond 30 deviations adds: an upper bound on the
/// probability that the program is outside the set at one of the first N samples (docs/gaussian.md, (5)).
/// Needs the upward mode.
[[nodiscard]] rigor::Interval losing_probability(const LockSet& set, const rigor::Interval& start_level,
                                                 const rigor::Interval& samples);

}  // namespace veritrack::quadrature

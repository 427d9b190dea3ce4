// The certificate for Gaussian noise: with which probability the tracker loses lock.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/quadrature/gaussian/lock_search.hpp"
#include "analysis/quadrature/gaussian/lock_start.hpp"
#include "analysis/quadrature/gaussian/lock_verification.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// The question, for a signal of amplitude 1.
struct LockQuestion {
  trackers::ToneModel<rigor::Interval> design;
  rigor::Interval noise_deviation;  ///< sigma of each channel, relative to the amplitude
  rigor::Interval frequency_walk;   ///< deviation of the frequency's step, rad/sample
  rigor::Interval samples;          ///< N
  /// The signal's frequencies, rad/sample; a leak needs them.
  rigor::Interval frequencies = rigor::Interval(0.0);
  LockStarts starts;
  TrackedSignal signal;       ///< for what rounding depends on
  double probability = 1e-6;  ///< which the search is to reach
  /// Root mean square of the frequency error that is enough, rad/sample: found faster than the least.
  std::optional<double> enough_rms;
  /// The same, which is to be reached, however much more there is to find.
  std::optional<double> required_rms;
};

struct LockCertificate {
  /// "lock": the conditions, and what follows from them.
  theorems::Derivation derivation;
  /// When everything is proved of them: one set, or with a leak one for each piece of the band of
  /// frequencies.
  std::vector<LockSet> sets;
  /// Without a leak: the result of the search, proved or not.
  std::optional<LockProposal> proposal;
  std::int64_t cells = 0;
  /// Multiples of the start covariance for which the result holds; those of the question, or more.
  rigor::Interval covariance_multiples;
};

/// Searches and verifies. Sets its own rounding mode.
[[nodiscard]] LockCertificate certify_lock(const LockQuestion& question);

/// The same with a search for the request: for more noise, or more frequencies, than the question's. A set
/// for more is also one for less. Sets its own rounding mode.
[[nodiscard]] LockCertificate certify_lock(const LockQuestion& question, const LockRequest& request);

/// The same without a search, without a leak: for this proposal, with as many cells in each part
/// (verify_lock_set). Sets its own rounding mode.
[[nodiscard]] LockCertificate certify_lock(const LockQuestion& question,
                                           const std::optional<LockProposal>& proposal,
                                           std::int64_t most_cells = kMostLockCells);

/// True only when nothing of the question is out of range; for others nothing is proposed. Needs the upward
/// mode.
[[nodiscard]] bool is_well_posed(const LockQuestion& question);

/// The level that the assumed starts may have for a probability that hardly depends on them.
inline constexpr double kUsualStartLevel = 8.0;

/// The request for a proposal that answers the question, with starts up to that level. Needs the upward mode.
[[nodiscard]] LockRequest proposal_request(const LockQuestion& question,
                                           double start_level = kUsualStartLevel);

/// exp(start level) + c_0/(1 - kappa): an upper bound on E[W; lock] at every sample. Needs the upward mode.
[[nodiscard]] rigor::Interval expected_weight(const LockSet& set, const rigor::Interval& start_level);

/// exp(-L) (expected_weight + N c_0) and what noise beyond 30 deviations adds: an upper bound on the
/// probability that the program leaves the set at one of any N successive samples (docs/gaussian.md, (5)).
/// Needs the upward mode.
[[nodiscard]] rigor::Interval losing_probability(const LockSet& set, const rigor::Interval& start_level,
                                                 const rigor::Interval& samples);

}  // namespace veritrack::quadrature

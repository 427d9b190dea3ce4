// Tubes over a band of frequencies that states rarely leave in Gaussian noise.
#pragma once

#include <string>
#include <vector>

#include "analysis/model/set/tube_set.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// The purpose of a set for Gaussian noise.
struct GaussianTask {
  std::string name;
  double deviation = 0.0;          ///< of each sample, signal units
  bool largest_deviation = false;  ///< search for the largest one
  double samples = 0.0;            ///< N: how long lock is to be kept
  double probability = 0.0;        ///< of losing lock in them, at most
  double start_share = 0.5;
  search::Deadline deadline;  ///< after which nothing more is proved
  /// The deviations of starts, one for each state; empty: starts have a level of at most `start_share` R.
  std::vector<rigor::Interval> deviations;
};

/// For low <= omega <= high, rad/sample, a constant frequency. When complete, all of them are covered and
/// `gaussian` is set. Deterministic, whatever the number of threads. Throws std::invalid_argument unless 0 <
/// low < high < pi.
[[nodiscard]] TubeSet prove_gaussian_set(const TrackedTone& tone, const TrackerModel& model, double low,
                                         double high, const GaussianTask& task,
                                         const SetProgress& progress = {});

/// An upper bound of the probability that a state which starts at the level `start_share` R leaves the tubes
/// within any `samples` successive samples, however late, when it has not left them before:
///   exp(-L) (exp(L start_share^2) + (c0 + t exp(L))/(1 - kappa) + N c0) + N t,
/// t a bound of the probability of a noise longer than V in a sample of `channels` channels. Infinity when
/// nothing is known. Needs the upward rounding mode.
[[nodiscard]] double leaving_probability(const GaussianTerms& terms, int channels,
                                         const rigor::Interval& samples, double start_share);

}  // namespace veritrack::model

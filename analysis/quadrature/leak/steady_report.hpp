// The claims of a verified set around the steady state, in engineering units and about the assumed starts.
#pragma once

#include <cstddef>
#include <string>

#include "analysis/quadrature/leak/steady_start.hpp"
#include "analysis/sets/fixed_point_bias.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// What is known of the assumed starts and a set around the steady state.
struct SteadyStartFinding {
  SteadyStart start;             ///< all of them
  double bias = 0.0;             ///< of the steady state, at most, rad/sample
  std::string covariance_range;  ///< a noun for the covariances that the question asks for; or empty
};

/// Needs the upward mode. Bounds are of the frequency error from the true signal, rad/sample.
class SteadyReport {
 public:
  /// The set must be PROVED for the question's design, noise and slew over the cells of the branch.
  SteadyReport(const sets::ContractionQuestion& question, const sets::LockBranch& branch,
               const SteadySet& set);

  /// The condition start-in-set, without words.
  [[nodiscard]] theorems::Condition start_in_set() const;
  /// Its reason.
  [[nodiscard]] SteadyStartFinding start() const { return {start_, bias_, covariance_range_}; }
  /// |e_i - e*_i| at level 1: amplitude, phase (rad), frequency (rad/sample).
  [[nodiscard]] rigor::Interval radius(Eigen::Index i) const;
  /// In the long run.
  [[nodiscard]] rigor::Interval ultimate() const { return bound_at(set_.levels.back(), bias_); }
  /// For ever; nothing when not all assumed starts come into the set.
  [[nodiscard]] std::optional<rigor::Interval> bound() const;
  /// Samples from the start to the last level; nothing when not all assumed starts come into the set.
  [[nodiscard]] std::optional<rigor::Interval> settling() const;
  /// The largest share of a level that the next one is.
  [[nodiscard]] rigor::Interval rate() const;
  /// After which the starts are in the set; zero when they begin there.
  [[nodiscard]] std::optional<rigor::Interval> capture_samples() const;

 private:
  /// The index of the last of the levels that are not below this one, which is at most 1.
  [[nodiscard]] std::size_t last_level_with(double level) const;
  /// On |frequency error| in Omega_level, where the bias of the steady state is at most `bias`.
  [[nodiscard]] rigor::Interval bound_at(double level, double bias) const;

  SteadySet set_;
  std::vector<SteadyStart> starts_;  ///< by cells of frequencies
  SteadyStart start_;                ///< all of them
  std::vector<double> biases_;       ///< by cells: of the steady states that starts of the cell may reach
  double bias_ = 0.0;                ///< the largest
  std::string covariance_range_;     ///< of the question, for reasons
};

}  // namespace veritrack::quadrature

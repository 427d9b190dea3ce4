// The question to the contraction certificate.
#pragma once

#include <optional>
#include <string>

#include "analysis/rigor/interval.hpp"
#include "analysis/sets/start_covariance.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::sets {

/// How far a search goes.
enum class SearchEffort {
  everything,  ///< for the best value of every quantity
  sufficient,  ///< until the requirements are proved; for everything where one set does not prove them
  quick        ///< only for one set that proves the requirements
};

/// The requirements of [require] on the assumed starts.
struct RequiredBounds {
  std::optional<double> frequency_error;  ///< rad/sample: never reached
  std::optional<double> samples;          ///< after which the error is at most `settled_frequency_error`
  [[nodiscard]] bool any() const { return frequency_error || samples; }
};

/// The question, for a signal of amplitude 1: design, noise and amplitudes relative to the true one
/// (trackers::at_unit_amplitude).
struct ContractionQuestion {
  trackers::ToneModel<rigor::Interval> design;
  rigor::Interval noise = rigor::Interval(0.0);  ///< |v(k)| <= noise
  rigor::Interval slew = rigor::Interval(0.0);   ///< |omega(k+1) - omega(k)| <= slew, rad/sample per sample
  rigor::Interval initial_amplitude_error = rigor::Interval(0.0);  ///< bounds on absolute values
  rigor::Interval initial_phase_error = rigor::Interval(0.0);      ///< rad
  rigor::Interval initial_frequency_error = rigor::Interval(0.0);  ///< rad/sample
  /// P(0|0) in the frame of the estimated phase; none: the filter's steady state.
  std::optional<StartCovariance> start_covariance;
  /// The frequency error that counts as settled, rad/sample; none: twice the bound of the long run.
  std::optional<double> settled_frequency_error;
  /// The signal, as far as the rounding of the program depends on it: its amplitude in signal units, and
  /// |omega(k)| <= largest_frequency, rad/sample; by default pi, from above.
  rigor::Interval amplitude = rigor::Interval(1.0);
  double largest_frequency = 0x1.921fb54442d19p+1;
  RequiredBounds required;
  /// Other than `everything` only where `required` is all that a verdict needs.
  SearchEffort effort = SearchEffort::everything;
  int search_evaluations = 40;  ///< per set
  bool with_samples = true;     ///< also sampled results of a search, which prove nothing
  /// Also as much noise, and as much slew, as sets of their own tolerate. Without, they are looked for only
  /// where nothing is certified under the assumed ones, for a filter without a leak.
  bool with_limits = true;
};

/// True only when r, q2 are certainly positive and every bound is a number certainly not negative: other
/// questions have no answer. Needs the upward mode.
[[nodiscard]] bool is_well_posed(const ContractionQuestion& question);

/// Why no set tolerates the assumed noise and slew: which of the two is beyond the largest that was certified
/// without the other, and by how much; a clause. Needs the upward mode.
[[nodiscard]] std::string beyond_the_limits(const ContractionQuestion& question,
                                            const std::optional<double>& largest_noise,
                                            const std::optional<double>& largest_slew);

}  // namespace veritrack::sets

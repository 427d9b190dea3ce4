// The result of a contraction certificate: of the two extended Kalman filters, the quadrature tracker's and
// the single-channel one's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statements/derivation.hpp"

namespace veritrack::sets {

/// The quantities that contraction certificates have in common, without their values: name, symbol, words and
/// sense. Quantities that are not set are not applicable.
namespace quantities {
[[nodiscard]] theorems::Quantity contraction_rate();
[[nodiscard]] theorems::Quantity radius();
[[nodiscard]] theorems::Quantity frequency_error_radius();
[[nodiscard]] theorems::Quantity phase_error_radius();
[[nodiscard]] theorems::Quantity amplitude_error_radius();
[[nodiscard]] theorems::Quantity frequency_error_bound();
[[nodiscard]] theorems::Quantity ultimate_frequency_error();
[[nodiscard]] theorems::Quantity settling_samples();
[[nodiscard]] theorems::Quantity settled_frequency_error();
[[nodiscard]] theorems::Quantity capture_samples();
[[nodiscard]] theorems::Quantity wrong_lock_frequency_error();
[[nodiscard]] theorems::Quantity largest_noise();
[[nodiscard]] theorems::Quantity largest_slew();
[[nodiscard]] theorems::Quantity bias_frequency();
}  // namespace quantities

/// The proved claims about the assumed starts, under the assumed noise and slew.
struct StartResult {
  /// Whether every assumed start is covered: all conditions together.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::vector<theorems::Condition> conditions;
  theorems::Quantity frequency_error_bound = quantities::frequency_error_bound();        ///< for ever
  theorems::Quantity ultimate_frequency_error = quantities::ultimate_frequency_error();  ///< in the long run
  theorems::Quantity settling_samples = quantities::settling_samples();
  theorems::Quantity settled_frequency_error = quantities::settled_frequency_error();  ///< from then on
  /// The multiples of the start covariance for which all this is true; nothing where it is given or the
  /// filter's steady state.
  std::optional<rigor::Interval> covariance_multiples;
  std::optional<theorems::Quantity> capture_samples;             ///< only where starts are followed
  std::optional<theorems::Quantity> wrong_lock_frequency_error;  ///< of a start that is certainly lost
  /// Some assumed start certainly locks elsewhere, with noise and slew that are allowed.
  bool loses_lock = false;
  /// A sentence: the claim that is PROVED under less noise and slew, where the assumed ones are too large.
  std::string proved_instead;

  /// On |frequency error| at every sample, rad/sample; nothing unless every assumed start is covered.
  [[nodiscard]] std::optional<rigor::Interval> proved_bound() const;
  /// The first condition that is not PROVED; null when all are.
  [[nodiscard]] const theorems::Condition* first_open_condition() const;
  /// The first condition with that verdict; null when there is none.
  [[nodiscard]] const theorems::Condition* first_condition(rigor::Verdict wanted) const;
};

/// The certified results for a design: quantities with words, symbol, formula, source, sense and value.
struct KalmanFilterResult {
  // The largest certified set under the assumed noise and slew.
  theorems::Quantity contraction_rate = quantities::contraction_rate();
  int rate_window = 1;              ///< samples over which the rate is a geometric mean
  bool about_steady_state = false;  ///< radii are measured from a biased steady state, not from the truth
  theorems::Quantity radius = quantities::radius();
  theorems::Quantity frequency_error_radius = quantities::frequency_error_radius();
  theorems::Quantity phase_error_radius = quantities::phase_error_radius();
  theorems::Quantity amplitude_error_radius = quantities::amplitude_error_radius();
  StartResult starts;
  theorems::Quantity largest_noise = quantities::largest_noise();  ///< without slew
  theorems::Quantity largest_slew = quantities::largest_slew();    ///< without noise
  std::optional<theorems::Quantity> bias_frequency;  ///< where the tracker may settle with a bias
};

/// The quantities of a result in the order in which certificates have them.
[[nodiscard]] std::vector<theorems::Quantity> quantities_of(const KalmanFilterResult& result);
/// The same ones, to be changed.
[[nodiscard]] std::vector<theorems::Quantity*> quantities_in(KalmanFilterResult& result);

/// Completes the derivation "contraction", which has its conditions: the quantities of the result come first,
/// before what it has of sampled ones. The result has conditions and verdict afterwards.
void conclude(theorems::Derivation& derivation, KalmanFilterResult& result);

}  // namespace veritrack::sets

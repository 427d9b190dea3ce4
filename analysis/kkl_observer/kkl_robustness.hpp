// The effect of a disturbance on the estimates of the KKL observer (trackers/kkl_observer/kkl_observer.hpp),
// bounded for every signal of a range: the robustness that its paper leaves open.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "analysis/kkl_observer/kkl_ell.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::kkl_observer {

/// No disturbance.
struct NoDisturbance {};
/// |d(t)| <= bound at all times, and nothing else; signal units.
struct BoundedDisturbance {
  rigor::Interval bound;
};
/// d(t) = amplitude sin(W t + p) for any p and any frequency W >= frequency (rad/s); signal units.
struct SinusoidalDisturbance {
  rigor::Interval amplitude;
  rigor::Interval frequency;
};
using Disturbance = std::variant<NoDisturbance, BoundedDisturbance, SinusoidalDisturbance>;

/// A number for each of M filters.
template <int M>
using KklFilters = std::array<rigor::Interval, static_cast<std::size_t>(M)>;

/// A question about M filters.
template <int M>
struct KklRobustnessQuestionOf {
  KklRangeOf<M> range;
  rigor::Interval amplitude;  ///< of the signal, certainly positive, signal units
  rigor::Interval ell;        ///< in use in (9)
  Disturbance disturbance;
  /// The time between samples, s, of a program in double precision that takes the input to be straight
  /// between them; the disturbance is that of the samples. None: filters in continuous time
  /// (kAllowedDeviation).
  std::optional<rigor::Interval> interval;
  double relative_tolerance = 0.05;  ///< of the bounds; a wish, not a condition
  std::int64_t cells = 120'000;      ///< at most, for each bound
};
/// The question for the paper's four filters.
using KklRobustnessQuestion = KklRobustnessQuestionOf<4>;

/// Bounds from the settling time on, for every signal of the range and filters that start at rest. They are
/// about estimates that are computed in double precision.
struct KklRobustness {
  rigor::Interval settling_time;          ///< s
  rigor::Interval frequency_error_bound;  ///< rad/s; empty when none was found
  rigor::Interval amplitude_error_bound;  ///< signal units; empty when none was found
  /// Twice the smallest |M xi|^2 / |xi|^2 that the disturbed filters can reach: mu of (9) vanishes for any
  /// ell up to its lower end. Empty when not found.
  rigor::Interval largest_ell;
  /// Whether there is a bound on the distance of the program's filters from their differential equations.
  bool knows_filters = false;
  /// The contribution of rounding of the static map, included in the bounds, rad/s. Empty when there is no
  /// bound.
  rigor::Interval rounding;
  /// A lower bound on x3_hat / x3, which has to be positive for a frequency to exist.
  rigor::Interval smallest_relative_square;
  /// A disturbed signal near the worst one for the frequency: frequency (rad/s), phase (rad), amplitude, and
  /// for a sinusoidal disturbance its phase (rad) and frequency (rad/s; infinite when the search ended
  /// there). With more than four filters the first two only.
  std::array<double, 5> worst{};
  std::int64_t cells = 0;  ///< examined
};

/// Bounds the errors of four to eight filters by branch and bound, in parallel: with four over signal and
/// disturbance, with more over the signal (kkl_split_errors.hpp). The result does not depend on the number of
/// threads. Opens its own rounding scopes. Never throws for odd numbers.
template <int M>
[[nodiscard]] KklRobustness bound_kkl_errors(const KklRobustnessQuestionOf<M>& question);

/// The same over the signal alone, also for four filters.
template <int M>
[[nodiscard]] KklRobustness bound_kkl_errors_over_signals(const KklRobustnessQuestionOf<M>& question);

/// The derivation "kkl-robustness": quantities frequency_error_bound, amplitude_error_bound, settling_time,
/// largest_ell, and what simulation finds, frequency_error_simulated and amplitude_error_simulated (not
/// proved); conditions regular (mu vanishes, so that the bounds apply to the ell in use), frequency-exists
/// and bounded. For four to eight filters.
template <int M>
[[nodiscard]] theorems::Derivation derive_kkl_robustness(const KklRobustnessQuestionOf<M>& question);

}  // namespace veritrack::kkl_observer

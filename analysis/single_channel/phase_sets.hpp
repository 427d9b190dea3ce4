// Sets of errors of the single-channel tracker that are verified over all phases and a band of frequencies.
#pragma once

#include <optional>
#include <vector>

#include "analysis/sets/contraction_question.hpp"
#include "analysis/single_channel/diagonal_start.hpp"
#include "analysis/single_channel/window_errors.hpp"
#include "analysis/single_channel/window_proposal.hpp"
#include "analysis/single_channel/window_rounding.hpp"

namespace veritrack::single_channel {

/// The question, at amplitude 1.
struct PhaseQuestion {
  sets::ContractionQuestion tracker;  ///< design, noise, slew and start
  rigor::Interval band;               ///< true frequencies, rad/sample
};

/// A verified window with the slew that it was verified for, and the noise that goes with it.
struct PhaseSet {
  WindowClaim claim;
  WindowFloor floor;
  rigor::Interval noise;  ///< relative to the amplitude
  rigor::Interval slew;   ///< rad/sample per sample
  /// A start with e' P^-1 e <= start_level^2 keeps e' P^-1 e <= R^2 for ever.
  double start_level = 0.0;
  /// The level of the assumed starts, and their P(0|0); only when they are certainly in the set.
  std::optional<double> assumed_level;
  std::optional<DiagonalStart> start = std::nullopt;
};

/// The recursion of the errors in the set. Needs the upward mode.
[[nodiscard]] WindowErrors errors_of(const PhaseQuestion& question, const PhaseSet& set);

/// A bound on |nu_k| for all k, for starts of that level; a part of the recursion is evaluated, and then a
/// level that is kept. Needs the upward mode.
[[nodiscard]] rigor::Interval frequency_error_bound(const PhaseQuestion& question, const PhaseSet& set,
                                                    double level);

/// A bound on limsup |nu_k|. Needs the upward mode.
[[nodiscard]] rigor::Interval ultimate_frequency_error(const PhaseQuestion& question, const PhaseSet& set);

/// Looks for sets: proposals in floating point, each verified. Each function opens its own rounding mode.
class PhaseSearch {
 public:
  explicit PhaseSearch(const PhaseQuestion& question);

  /// The largest starts under the assumed noise and slew.
  [[nodiscard]] std::optional<PhaseSet> largest_set() const;
  /// The least bound on the frequency error from the assumed starts on.
  [[nodiscard]] std::optional<PhaseSet> least_bound() const;
  /// A set that does what question.tracker.required asks of the assumed starts.
  [[nodiscard]] std::optional<PhaseSet> sufficient_set() const;
  /// The largest noise, without slew.
  [[nodiscard]] std::optional<PhaseSet> largest_noise() const;
  /// The largest slew, without noise.
  [[nodiscard]] std::optional<PhaseSet> largest_slew() const;
  /// A level of this set that contains the assumed starts, computed on a grid: no proof.
  [[nodiscard]] double start_level_seen(const PhaseSet& set) const;

 private:
  /// The proposal with as little slack as lets it verify. With starts, the set is for the assumed ones:
  /// nothing unless one of those that `starts_of(set)` gives, at most three, is below all covariances, the
  /// first such.
  template <typename StartsOf>
  [[nodiscard]] std::optional<PhaseSet> verified(const WindowClaim& proposal, const rigor::Interval& noise,
                                                 const rigor::Interval& slew,
                                                 const StartsOf& starts_of) const;
  [[nodiscard]] std::optional<PhaseSet> verified(const WindowClaim& proposal, const rigor::Interval& noise,
                                                 const rigor::Interval& slew) const;
  /// Sets for the assumed starts, each the least bound's first, until `accept(set)`.
  template <typename Accept>
  [[nodiscard]] std::optional<PhaseSet> set_for_starts(const Accept& accept) const;
  [[nodiscard]] const std::vector<WindowClaim>& still_proposals() const;
  template <typename Value>
  [[nodiscard]] static std::vector<WindowClaim> best_first(const std::vector<WindowClaim>& proposals,
                                                           const Value& value);

  PhaseQuestion question_;
  WindowRequest request_;
  StartBox box_;
  std::vector<WindowClaim> proposals_;  ///< under the assumed slew
  /// Without slew, when they were asked for.
  mutable std::optional<std::vector<WindowClaim>> still_proposals_;
};

}  // namespace veritrack::single_channel

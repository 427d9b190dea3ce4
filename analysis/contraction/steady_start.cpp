#include "analysis/contraction/steady_start.hpp"

#include <algorithm>

#include "analysis/rigor/definiteness.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;

/// The first level of a ladder up to 1 at which the covariance lies between the bounds; nothing when none.
std::optional<double> covariance_level(const IntervalMatrix<3>& deviation, const SteadySet& set) {
  constexpr int kSteps = 40;
  const IntervalMatrix<3> below = rigor::to_interval(set.below);
  const IntervalMatrix<3> above = rigor::to_interval(set.above);
  for (int i = 1; i <= kSteps; ++i) {
    const Interval level(static_cast<double>(i) / kSteps);
    const IntervalMatrix<3> room_below = deviation + below * level;
    const IntervalMatrix<3> room_above = above * level - deviation;
    if (rigor::is_positive_definite(room_below) == rigor::Verdict::proved &&
        rigor::is_positive_definite(room_above) == rigor::Verdict::proved) {
      return level.upper();
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Interval> start_level(const ContractionQuestion& question,
                                    const std::vector<FixedPointTube<QuadraturePolarLoop::kStates>>& cells,
                                    const SteadySet& set) {
  rigor::require_upward_rounding();
  IntervalVector<3> start;
  start << rigor::symmetric(question.initial_amplitude_error.upper()),
      rigor::symmetric(question.initial_phase_error.upper()),
      rigor::symmetric(question.initial_frequency_error.upper());
  Interval worst(0.0);
  for (const auto& cell : cells) {
    const IntervalVector<QuadraturePolarLoop::kStates> steady = cell.box();
    worst = rigor::max(worst, metric_norm(set, IntervalVector<3>(start - steady.head<3>())));
    if (question.initial_covariance) {
      IntervalMatrix<3> covariance;
      covariance << steady[3], steady[4], steady[5], steady[4], steady[6], steady[7], steady[5], steady[7],
          steady[8];
      const auto level = covariance_level(IntervalMatrix<3>(*question.initial_covariance - covariance), set);
      if (!level) {
        return std::nullopt;
      }
      worst = rigor::max(worst, Interval(*level));
    }
  }
  return is_finite(worst) ? std::optional(Interval(worst.upper())) : std::nullopt;
}

}  // namespace veritrack::contraction

#include "analysis/model/tube/tube_verification.hpp"

#include <fmt/format.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/model/filter/filter_step.hpp"
#include "analysis/model/tube/angle_check.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// Whether all bounds are at most the requested ones. A comparison with NaN is false.
bool holds(const StepBounds& bounds, const LevelQuestion& question, const std::vector<double>& scales) {
  if (bounds.steps.size() != scales.size() || scales.empty() || rigor::is_empty(bounds.frequency_error)) {
    return false;
  }
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const Interval allowed = Interval(question.shrinking) * Interval(scales[i]);
    // |F| is in units of the shape, in which the ball has the radius R.
    const Interval relative = Interval(bounds.steps[i]) / Interval(question.radius);
    if (!rigor::certainly_less_equal(relative, allowed)) {
      return false;
    }
  }
  return true;
}

StepBounds bounds_of(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                     const LevelQuestion& question, const std::vector<double>& scales, PlaceStore* store) {
  return tube.bounds_covariance()
             ? bound_filter_step(model, tube, cell,
                                 {question.radius, question.noise, question.slew, question.with_covariance,
                                  question.covariance_margin},
                                 scales, store)
             : bound_step(model, tube, cell, question.radius, question.noise, scales, question.slew, store);
}

/// Points of a tube, at the middle and both ends of its frequencies.
constexpr std::array<double, 3> kPlaces{-1.0, 0.0, 1.0};

std::size_t points_of(int phases) {
  return static_cast<std::size_t>(phases) * kPlaces.size();
}

/// |F|/R at point number `number`; infinity when nothing is known.
double growth_at(const TrackerModel& model, const Tube& tube, const LevelQuestion& question, int phases,
                 std::size_t number, PlaceStore* store) {
  const std::size_t phase = number / kPlaces.size();
  const TubeCell point{static_cast<double>(phase) / phases, 0.0, kPlaces.at(number % kPlaces.size()), 0.0};
  const double step = bounds_of(model, tube, point, question, {1.0}, store).steps.front();
  return std::isfinite(step) ? step / question.radius : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string objection_to_phases(const TrackerModel& model, const Tube& tube) {
  std::string reason = angle_objection(*model.recursion, model.constants);
  if (!reason.empty()) {
    return reason;
  }
  if (!is_periodic(*model.signal, model.constants)) {
    return "the signal is not known to have the period 2 pi in its phase";
  }
  if (tube.bounds_covariance() &&
      std::any_of(tube.turns.begin(), tube.turns.end(), [](int turns) { return turns != 0; })) {
    return "the estimate of a filter turns";
  }
  for (std::size_t i = 0; i < tube.turns.size(); ++i) {
    if (tube.turns[i] != 0 && !model.recursion->is_angle[i]) {
      return "the curve turns in a state that is no angle";
    }
  }
  return {};
}

std::string place_of_failure(const Tube& tube, const TubeCell& cell) {
  return fmt::format("at phases about {:.4g} of a turn and frequencies about {:.4g} rad/sample", cell.turn,
                     tube.frequency + tube.half_width * cell.z);
}

LevelResult verify_level(const TrackerModel& model, const Tube& tube, const LevelQuestion& question,
                         const VerificationBudget& budget, PlaceStore* store) {
  LevelResult result;
  const rigor::UpwardRounding upward;
  result.reason = objection_to_phases(model, tube);
  if (!result.reason.empty()) {
    return result;
  }
  const bool is_question = std::isfinite(question.radius) && question.radius > 0.0 && question.noise >= 0.0 &&
                           std::isfinite(question.noise) && question.least_scale > 0.0 &&
                           question.least_scale <= 1.0 && question.shrinking > 0.0 &&
                           question.shrinking <= 1.0 && question.slew >= 0.0 &&
                           std::isfinite(question.slew) && question.covariance_margin >= 0.0 &&
                           question.covariance_margin < 1.0 && is_grid(budget);
  if (!is_question) {
    result.reason = "no radius, noise, slew or budget that could be verified";
    return result;
  }
  std::vector<double> scales{1.0};
  if (question.least_scale < 1.0) {
    scales.push_back(question.least_scale);
  }
  const auto ask = [&](const TubeCell& cell) -> CellAnswer {
    const StepBounds bounds = bounds_of(model, tube, cell, question, scales, store);
    return {holds(bounds, question, scales), bounds.frequency_error, bounds.by_phase, bounds.by_frequency};
  };
  const CoverResult cover = cover_cells(ask, budget);
  if (!cover.is_proved) {
    result.worst_cell = cover.failed;
    result.reason = place_of_failure(tube, cover.failed) + " a step may grow beyond the tube";
    return result;
  }
  result.cells = cover.cells;
  result.frequency_error = cover.range;
  result.verdict = Verdict::proved;
  return result;
}

double sampled_growth(const TrackerModel& model, const Tube& tube, const LevelQuestion& question,
                      int phases) {
  std::vector<double> growths(points_of(phases));
  tbb::parallel_for(std::size_t{0}, growths.size(), [&](std::size_t number) {
    growths[number] = growth_at(model, tube, question, phases, number, nullptr);
  });
  return *std::max_element(growths.begin(), growths.end());
}

bool may_shrink(const TrackerModel& model, const Tube& tube, const LevelQuestion& question, int phases,
                double most, PlaceStore* store) {
  std::atomic<bool> all{true};
  tbb::parallel_for(std::size_t{0}, points_of(phases), [&](std::size_t number) {
    if (all.load() && !(growth_at(model, tube, question, phases, number, store) <= most)) {
      all.store(false);
    }
  });
  return all.load();
}

double growth_on_grid(const TrackerModel& model, const Tube& tube, const LevelQuestion& question,
                      const VerificationBudget& grid, PlaceStore* store) {
  constexpr std::size_t kPhases = 6;
  const auto rows = static_cast<std::size_t>(std::min(3, grid.frequencies));
  const auto phases = static_cast<double>(grid.phases);
  const auto frequencies = static_cast<double>(grid.frequencies);
  const std::array<double, 2> scales{1.0, question.least_scale};
  std::vector<double> growths(kPhases * rows);
  tbb::parallel_for(std::size_t{0}, growths.size(), [&](std::size_t number) {
    const rigor::UpwardRounding upward;
    const std::size_t phase = number / rows;
    const std::size_t place = number % rows;
    const double share = (static_cast<double>(phase) + 0.3) / kPhases;
    const double row = std::floor(static_cast<double>(place) / static_cast<double>(rows) * frequencies);
    const TubeCell cell{(std::floor(share * phases) + 0.5) / phases, 0.5 / phases,
                        (2.0 * row + 1.0) / frequencies - 1.0, 1.0 / frequencies};
    const StepBounds bounds = bounds_of(model, tube, cell, question, {scales.begin(), scales.end()}, store);
    double largest = bounds.steps.size() == scales.size() ? 0.0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scales.size() && std::isfinite(largest); ++i) {
      const double here = bounds.steps[i] / (scales.at(i) * question.radius);
      largest = std::isfinite(here) ? std::max(largest, here) : std::numeric_limits<double>::infinity();
    }
    growths[number] = largest;
  });
  return *std::max_element(growths.begin(), growths.end());
}

std::optional<VerificationBudget> coarsest_grid(const TrackerModel& model, const Tube& tube,
                                                const LevelQuestion& question, VerificationBudget grid,
                                                int most, PlaceStore* store) {
  const auto growth_with = [&](int phases, int frequencies) {
    VerificationBudget tried = grid;
    tried.phases *= phases;
    tried.frequencies *= frequencies;
    return growth_on_grid(model, tube, question, tried, store);
  };
  double growth = growth_with(1, 1);
  while (!(growth <= question.shrinking)) {
    if (2 * grid.phases * grid.frequencies > most || grid.deadline.is_over()) {
      return std::nullopt;
    }
    const double by_phase = growth_with(2, 1);
    const double by_frequency = growth_with(1, 2);
    // While nothing is known, both take turns.
    constexpr int kPhasesAsWide = 32;
    const bool is_known = std::isfinite(by_phase) || std::isfinite(by_frequency);
    const bool divides_frequencies =
        is_known ? by_frequency < by_phase : grid.phases > kPhasesAsWide * grid.frequencies;
    (divides_frequencies ? grid.frequencies : grid.phases) *= 2;
    growth = divides_frequencies ? by_frequency : by_phase;
  }
  return grid;
}

}  // namespace veritrack::model

#include "analysis/model/gaussian/gaussian_drift.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "analysis/model/filter/filter_step.hpp"
#include "analysis/model/gaussian/drift_shells.hpp"
#include "analysis/model/step/map_bound.hpp"
#include "analysis/model/tube/tube_verification.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

bool is_positive(double number) {
  return std::isfinite(number) && number > 0.0;
}

/// The same for a filter whose covariance is between the bounds of the tube.
CellAnswer filter_drift_over(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                             const DriftQuestion& question) {
  const rigor::UpwardRounding upward;
  const rigor::BallModelScope scope(static_cast<int>(tube.curve.size()), model.recursion->samples);
  const double share = question.deviation / question.most_noise;
  const FilterStepQuestion asked{
      .radius = question.radius, .noise = question.most_noise, .with_covariance = question.with_covariance};
  const FilterStepOver step =
      filter_step_over(model, tube, cell, asked, 2.0 * question.exponent * share * share);
  if (!step.is_known) {
    return {};
  }
  const WidthShares shares = width_shares(step.vector);
  const bool holds = drift_holds(VectorParts(step.vector, false), question, model.recursion->samples);
  return {holds, step.frequency_error, shares.by_phase, shares.by_frequency};
}

CellAnswer drift_over(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                      const DriftQuestion& question) {
  if (tube.bounds_covariance()) {
    return filter_drift_over(model, tube, cell, question);
  }
  const rigor::UpwardRounding upward;
  const rigor::BallModelScope scope(model.recursion->states, model.recursion->samples);
  const StepOver step = step_over(model, tube, cell, question.radius, question.most_noise);
  const WidthShares shares = width_shares(step.deviation);
  const bool holds =
      step.is_known && drift_holds(VectorParts(step.deviation, false), question, model.recursion->samples);
  return {holds, step.frequency_error, shares.by_phase, shares.by_frequency};
}

}  // namespace

DriftResult verify_drift(const TrackerModel& model, const Tube& tube, const DriftQuestion& question,
                         const VerificationBudget& budget) {
  DriftResult result;
  const rigor::UpwardRounding upward;
  result.reason = objection_to_phases(model, tube);
  if (!result.reason.empty()) {
    return result;
  }
  if (model.amplitude_varies) {
    result.reason = "in Gaussian noise the amplitude must be constant";
    return result;
  }
  if (!is_positive(question.radius) || !is_positive(question.deviation) ||
      !is_positive(question.most_noise) || !is_positive(question.exponent) || !is_positive(question.factor) ||
      question.factor > 1.0 || !is_positive(question.constant) || !(question.room >= 1.0) ||
      !is_positive(question.room) || !is_grid(budget)) {
    result.reason = "no radius, noise, weight or budget that could be verified";
    return result;
  }
  const auto ask = [&](const TubeCell& cell) { return drift_over(model, tube, cell, question); };
  const CoverResult cover = cover_cells(ask, budget);
  if (!cover.is_proved) {
    result.reason = place_of_failure(tube, cover.failed) + " the tube may be left too often";
    return result;
  }
  result.cells = cover.cells;
  result.frequency_error = cover.range;
  result.verdict = rigor::is_finite(cover.range) ? rigor::Verdict::proved : rigor::Verdict::undecided;
  return result;
}

bool drift_may_hold(const TrackerModel& model, const Tube& tube, const DriftQuestion& question, int phases) {
  constexpr std::array<double, 3> kPlaces{-1.0, 0.0, 1.0};
  std::vector<char> holds(static_cast<std::size_t>(phases) * kPlaces.size());
  tbb::parallel_for(std::size_t{0}, holds.size(), [&](std::size_t number) {
    const std::size_t phase = number / kPlaces.size();
    const TubeCell point{static_cast<double>(phase) / phases, 0.0, kPlaces.at(number % kPlaces.size()), 0.0};
    holds[number] = drift_over(model, tube, point, question).is_proved ? 1 : 0;
  });
  return std::all_of(holds.begin(), holds.end(), [](char one) { return one != 0; });
}

}  // namespace veritrack::model

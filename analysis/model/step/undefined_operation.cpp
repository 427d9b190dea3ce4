#include "analysis/model/step/undefined_operation.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "analysis/model/step/tube_models.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;

/// The instruction that is undefined at some phase, or -1.
int undefined_at(const TrackerModel& model, const Tube& tube, double radius, double noise) {
  constexpr int kPhases = 32;
  const rigor::BallModelScope scope(model.recursion->states,
                                    is_disturbed(model, noise) ? model.recursion->samples : 0);
  const trackers::StraightLineProgram& step = model.recursion->step;
  std::vector<BallModel> registers;
  std::vector<BallModel> next(step.results().size());
  for (int k = 0; k < kPhases; ++k) {
    const TubeCell point{static_cast<double>(k) / kPhases, 0.0, 0.0, 0.0};
    const CellFrame frame = frame_of(model, tube, point, FrameParts::with_next);
    std::vector<BallModel> inputs;
    for (const rigor::Interval& constant : model.constants) {
      inputs.emplace_back(constant);
    }
    for (BallModel& state : state_in(frame.here, radius)) {
      inputs.push_back(std::move(state));
    }
    for (BallModel& sample : noisy_samples(model, frame.next, noise, 1.0)) {
      inputs.push_back(std::move(sample));
    }
    step.run(std::span<const BallModel>(inputs), registers, std::span(next));
    const int found =
        first_unknown(step, registers, [](const BallModel& value) { return std::isfinite(value.error()); });
    if (found >= 0) {
      return found;
    }
  }
  return -1;
}

}  // namespace

std::optional<UndefinedOperation> find_undefined(const TrackerModel& model, const Tube& tube, double radius,
                                                 double noise) {
  if (tube.bounds_covariance() || !(radius > 0.0) || !std::isfinite(radius) || !std::isfinite(noise)) {
    return std::nullopt;
  }
  const int found = undefined_at(model, tube, radius, noise);
  if (found < 0) {
    return std::nullopt;
  }
  UndefinedOperation undefined{found, 0.0};
  constexpr double kStep = 0.8;
  constexpr int kMostTries = 40;
  double tried = radius;
  for (int i = 0; i < kMostTries && undefined.defined_radius == 0.0; ++i) {
    tried *= kStep;
    undefined.defined_radius = undefined_at(model, tube, tried, noise) < 0 ? tried : 0.0;
  }
  return undefined;
}

}  // namespace veritrack::model

#include "analysis/model/step/tube_step.hpp"

#include <cstddef>
#include <limits>
#include <utility>

#include "analysis/model/step/map_bound.hpp"
#include "analysis/model/step/tube_models.hpp"

namespace veritrack::model {

namespace {

/// At least the square root of 2.
constexpr double kRootOfTwo = 0x1.6a09e667f3bcdp0;

}  // namespace

using rigor::BallModel;
using rigor::Interval;

StepOver step_over(const TrackerModel& model, const Tube& tube, const TubeCell& cell, double radius,
                   double noise, double slew, double stretch, PlaceStore* store) {
  require_sizes(model, tube);
  const auto states = static_cast<std::size_t>(model.recursion->states);
  const bool is_moving = slew > 0.0;
  CellFrame frame =
      frame_of(model, tube, cell, is_moving ? FrameParts::with_samples : FrameParts::with_next, store);
  if (is_moving) {
    // Rounded up: more slew than requested.
    const int last = is_disturbed(model, noise) ? model.recursion->samples : 0;
    frame.there =
        tube_at(tube, frame.next_phase,
                frame.z + BallModel(slew * stretch / tube.half_width) * BallModel::disturbance(last));
  }
  const std::vector<BallModel> state = state_in(frame.here, radius);
  std::vector<BallModel> inputs = state;
  for (BallModel& sample : noisy_samples(model, frame.next, noise, stretch)) {
    inputs.push_back(std::move(sample));
  }
  std::vector<BallModel> next = run(model, model.recursion->step, inputs);
  for (std::size_t i = 0; i < states; ++i) {
    next[i] -= frame.there.curve[i];
  }
  StepOver step;
  step.deviation = in_units_of(frame.there, next);
  const std::vector<BallModel> frequency = run(model, model.recursion->frequency, state);
  // The shape must be valid: no component of it vanishes, here or there.
  step.is_known = is_shape(frame.here) && is_shape(frame.there);
  step.frequency_error = step.is_known ? (frequency.front() - frame.frequency).range() : Interval::empty();
  return step;
}

StepBounds bound_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell, double radius,
                      double noise, const std::vector<double>& scales, double slew, PlaceStore* store) {
  const bool is_noisy = is_disturbed(model, noise);
  const bool is_moving = slew > 0.0;
  const int of_noise = is_noisy ? model.recursion->samples : 0;
  const rigor::BallModelScope scope(model.recursion->states, is_moving ? of_noise + 1 : of_noise);
  // Noise and slew are in the unit ball together when the squared length of each is at most 1/2.
  const double stretch = is_noisy && is_moving ? kRootOfTwo : 1.0;
  const StepOver step = step_over(model, tube, cell, radius, noise, slew, stretch, store);
  StepBounds bounds;
  bounds.steps = length_bounds(step.deviation, scales, is_noisy && is_moving);
  const WidthShares shares = width_shares(step.deviation);
  bounds.by_phase = shares.by_phase;
  bounds.by_frequency = shares.by_frequency;
  bounds.frequency_error = step.frequency_error;
  if (!step.is_known) {
    bounds.steps.assign(scales.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return bounds;
}

}  // namespace veritrack::model

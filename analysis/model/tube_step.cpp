#include "analysis/model/tube_step.hpp"

#include <cstddef>
#include <limits>

#include "analysis/model/map_bound.hpp"
#include "analysis/model/tube_models.hpp"

namespace veritrack::model {

namespace {

/// At least the square root of 2.
constexpr double kRootOfTwo = 0x1.6a09e667f3bcdp0;

}  // namespace

using rigor::BallModel;
using rigor::Interval;

StepBounds bound_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell, double radius,
                      double noise, const std::vector<double>& scales, double slew) {
  require_sizes(model, tube);
  const auto states = static_cast<std::size_t>(model.recursion->states);
  const auto samples = static_cast<std::size_t>(model.recursion->samples);
  const bool is_noisy = noise > 0.0;
  const bool is_moving = slew > 0.0;
  const int of_noise = is_noisy ? static_cast<int>(samples) : 0;
  const rigor::BallModelScope scope(static_cast<int>(states), is_moving ? of_noise + 1 : of_noise);
  // Noise and slew are in the unit ball together when the squared length of each is at most 1/2.
  const double stretch = is_noisy && is_moving ? kRootOfTwo : 1.0;

  const CellPlace place = place_of(cell);
  const BallModel omega = frequency_at(tube, place.z);
  const BallModel next_phase = place.phase + omega;
  const TubeHere here = tube_at(tube, place.phase, place.z);
  // Rounded up: more slew than is asked for.
  const BallModel next_z =
      is_moving ? place.z + BallModel(slew * stretch / tube.half_width) * BallModel::disturbance(of_noise)
                : place.z;
  const TubeHere there = tube_at(tube, next_phase, next_z);

  const std::vector<BallModel> state = state_in(here, radius);
  std::vector<BallModel> inputs = state;
  const std::vector<BallModel> signal = run(model, *model.signal, {BallModel(model.amplitude), next_phase});
  for (std::size_t c = 0; c < samples; ++c) {
    inputs.push_back(is_noisy ? signal[c] +
                                    BallModel(noise * stretch) * BallModel::disturbance(static_cast<int>(c))
                              : signal[c]);
  }
  std::vector<BallModel> next = run(model, model.recursion->step, inputs);
  for (std::size_t i = 0; i < states; ++i) {
    next[i] = next[i] - there.curve[i];
  }
  const std::vector<BallModel> deviation = in_units_of(there, next);  // F
  StepBounds bounds;
  for (const double scale : scales) {
    bounds.steps.push_back(length_bound(deviation, scale, is_noisy && is_moving));
  }
  const WidthShares shares = width_shares(deviation);
  bounds.by_phase = shares.by_phase;
  bounds.by_frequency = shares.by_frequency;
  const std::vector<BallModel> frequency = run(model, model.recursion->frequency, state);
  bounds.frequency_error = (frequency.front() - omega).range();
  // The shape must be one: no component of it vanishes, here or there.
  if (!is_shape(here) || !is_shape(there)) {
    bounds.steps.assign(scales.size(), std::numeric_limits<double>::quiet_NaN());
    bounds.frequency_error = Interval::empty();
  }
  return bounds;
}

}  // namespace veritrack::model

#include "analysis/model/tube_step.hpp"

#include <cstddef>
#include <limits>

#include "analysis/model/map_bound.hpp"
#include "analysis/model/tube_models.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;

StepBounds bound_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell, double radius,
                      double noise, const std::vector<double>& scales) {
  require_sizes(model, tube);
  const auto states = static_cast<std::size_t>(model.recursion->states);
  const auto samples = static_cast<std::size_t>(model.recursion->samples);
  const rigor::BallModelScope scope(static_cast<int>(states), noise > 0.0 ? static_cast<int>(samples) : 0);

  const CellFrame frame = frame_of(model, tube, cell, true);
  const std::vector<BallModel> state = state_in(frame.here, radius);
  std::vector<BallModel> inputs = state;
  for (std::size_t c = 0; c < samples; ++c) {
    inputs.push_back(noise > 0.0
                         ? frame.next[c] + BallModel(noise) * BallModel::disturbance(static_cast<int>(c))
                         : frame.next[c]);
  }
  std::vector<BallModel> next = run(model, model.recursion->step, inputs);
  for (std::size_t i = 0; i < states; ++i) {
    next[i] = next[i] - frame.there.curve[i];
  }
  const std::vector<BallModel> deviation = in_units_of(frame.there, next);  // F
  StepBounds bounds;
  for (const double scale : scales) {
    bounds.steps.push_back(length_bound(deviation, scale));
  }
  const auto& classes = deviation.front().monomials().classes();
  for (const BallModel& component : deviation) {
    for (std::size_t number = 0; number < classes.size(); ++number) {
      bounds.by_phase += classes[number].s > 0 ? component.norm(number) : 0.0;
      bounds.by_frequency += classes[number].z > 0 ? component.norm(number) : 0.0;
    }
  }
  const std::vector<BallModel> frequency = run(model, model.recursion->frequency, state);
  bounds.frequency_error = (frequency.front() - frame.frequency).range();
  // The shape must be one: no component of it vanishes, here or there.
  if (!is_shape(frame.here) || !is_shape(frame.there)) {
    bounds.steps.assign(scales.size(), std::numeric_limits<double>::quiet_NaN());
    bounds.frequency_error = Interval::empty();
  }
  return bounds;
}

}  // namespace veritrack::model

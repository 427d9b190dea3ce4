#include "certificates/model/filter_belief.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace veritrack::certificates {

namespace {

/// The same instructions without results.
trackers::StraightLineProgram without_results(const trackers::StraightLineProgram& program) {
  trackers::StraightLineProgram copy(program.inputs());
  for (const trackers::Instruction& instruction : program.instructions()) {
    (void)copy.append(instruction);
  }
  return copy;
}

int register_called(const language::CompiledProgram& compiled, const std::string& name) {
  const auto found = compiled.places.find(name);
  if (found == compiled.places.end()) {
    throw std::logic_error("the step of a filter has no " + name);
  }
  return found->second;
}

}  // namespace

FilterBelief::FilterBelief(const Model& model, std::size_t states)
    : innovation_(without_results(model.step.program)),
      frequency_(model.frequency.program),
      constants_(model.constants.size()),
      states_(states),
      channels_(model.samples.size()) {
  for (const std::string& sample : model.samples) {
    innovation_.add_result(register_called(model.step, "innovation." + sample));
  }
  for (std::size_t i = 0; i < channels_; ++i) {
    innovation_.add_result(register_called(model.step, "S." + model.samples[i] + "." + model.samples[i]));
  }
  const auto frequency = static_cast<std::size_t>(frequency_.results().front());
  if (frequency >= constants_ && frequency < constants_ + states_) {
    frequency_state_ = variance_of(frequency - constants_);
  }
  results_.resize(2 * channels_);
  if (channels_ == 2) {
    // Without correlation, S has no such entry.
    const std::string name = "S." + model.samples[0] + "." + model.samples[1];
    if (model.step.places.contains(name)) {
      innovation_.add_result(register_called(model.step, name));
      results_.push_back(0.0);
    }
  }
}

/// The place of a state's variance among the inputs.
std::size_t FilterBelief::variance_of(std::size_t state) const {
  // The upper triangle, row by row: the rows above have states, states - 1, ... entries.
  return constants_ + states_ + state * states_ - state * (state - 1) / 2;
}

FilterBelief::Innovation FilterBelief::innovation(std::span<const double> inputs) {
  innovation_.run(inputs, registers_, std::span(results_));
  if (channels_ == 1) {
    return {{results_[0], NAN}, results_[0] * results_[0] / results_[1]};
  }
  const double v1 = results_[0];
  const double v2 = results_[1];
  const double s11 = results_[2];
  const double s22 = results_[3];
  const double s12 = results_.size() > 4 ? results_[4] : 0.0;
  return {{v1, v2}, (s22 * v1 * v1 - 2.0 * s12 * v1 * v2 + s11 * v2 * v2) / (s11 * s22 - s12 * s12)};
}

double FilterBelief::frequency_deviation(std::span<const double> inputs) {
  if (frequency_state_) {
    return std::sqrt(inputs[*frequency_state_]);
  }
  constexpr double kStep = 1e-6;  // relative: the losses in rounding and in the remainder are about equal
  shifted_.assign(inputs.begin(), inputs.end());
  gradient_.resize(states_);
  for (std::size_t i = 0; i < states_; ++i) {
    double& state = shifted_[constants_ + i];
    const double middle = state;
    const double step = kStep * std::max(1.0, std::fabs(middle));
    std::array<double, 2> values{};
    for (const std::size_t side : {0U, 1U}) {
      state = side == 0 ? middle - step : middle + step;
      frequency_.run(std::span<const double>(shifted_), registers_, std::span(&values[side], 1));
    }
    state = middle;
    gradient_[i] = (values[1] - values[0]) / (2.0 * step);
  }
  double variance = 0.0;
  std::size_t place = constants_ + states_;  // the upper triangle, row by row
  for (std::size_t i = 0; i < states_; ++i) {
    for (std::size_t j = i; j < states_; ++j) {
      variance += (i == j ? 1.0 : 2.0) * gradient_[i] * gradient_[j] * inputs[place++];
    }
  }
  return std::sqrt(variance);
}

}  // namespace veritrack::certificates

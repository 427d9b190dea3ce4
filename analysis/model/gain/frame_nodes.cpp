// The parts of the network that values add to a frame: docs/gain-proof.md, section 2.
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/model/gain/frame_rules.hpp"

namespace veritrack::model {

using rigor::Interval;

void FrameRules::require_no_turns(const FrameLine& line) {
  if (line.turns != 0 || line.is_modular) {
    throw NoFrame("a function of an angle other than sin and cos");
  }
}

FrameLine FrameRules::form_of(const FrameLine& line) {
  FrameLine form;
  form.states = line.states;
  form.inputs = line.inputs;
  return form;
}

void FrameRules::add_component(FrameLine& line, int component, const Interval& weight) {
  const auto [place, is_new] = line.inputs.try_emplace(component, weight);
  if (!is_new) {
    place->second += weight;
  }
}

Interval FrameRules::base_of(const FrameLine& line, const Interval& band) {
  return line.constant + line.per_frequency * band;
}

int FrameRules::add_form(Frame& frame, const FrameLine& line) {
  frame.forms_.push_back(form_of(line));
  return static_cast<int>(frame.forms_.size()) - 1;
}

int FrameRules::add_input(Frame& frame, FrameInput input) {
  input.first = frame.components_;
  frame.components_ += input.components;
  frame.inputs_.push_back(std::move(input));
  return frame.inputs_.back().first;
}

int FrameRules::add_angle_form(Frame& frame, const FrameLine& line) {
  frame.angle_forms_.push_back(add_form(frame, line));
  return frame.angle_forms_.back();
}

void FrameRules::add_remainder(Frame& frame, FrameLine& line, const char* what,
                               std::function<double(const std::vector<double>& bounds)> size) {
  FrameInput input;
  input.is_remainder = true;
  input.what = what;
  input.at_bounds = std::move(size);
  add_component(line, add_input(frame, std::move(input)), Interval(1.0));
}

void FrameRules::add_limit(Frame& frame, int form, const Interval& room) {
  if (!rigor::certainly_less(Interval(0.0), room)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  frame.limits_.push_back({form, room.lower()});
}

FrameLine Frame::line_of(const FrameValue& value) {
  if (value.kind() == FrameValue::Kind::line) {
    return value.line();
  }
  const auto key = std::tuple(static_cast<int>(FrameOperation::line), value.name(), -1);
  const auto found = made_.find(key);
  if (found != made_.end()) {
    return found->second;
  }
  if (value.kind() == FrameValue::Kind::tangent) {
    const auto& [monomial, kappa] = *value.waves().begin();
    const WavePattern pattern{monomial, kappa.real < 0.0 ? -1 : 1, static_cast<int>(kappa.imaginary)};
    const FrameLine angle = FrameRules::angle_line(*this, pattern, 2);
    return made_[key] = FrameRules::function_line(*this, FrameOperation::tangent, angle);
  }
  return made_[key] = FrameRules::line_of_waves(*this, value.waves());
}

}  // namespace veritrack::model

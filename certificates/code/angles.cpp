#include "certificates/code/angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "certificates/code/recursion.hpp"

namespace veritrack::certificates::code {

using model::code::kWrapSlack, model::code::Range;
using trackers::code::Instruction;
using trackers::code::Operation;

Angles::Angles(const trackers::code::Listing& listing, model::code::Turns& turns)
    : listing_(&listing), turns_(&turns) {
  find_ranges();
}

/// The ranges that the program keeps its angles in, for steps of up to half a turn.
void Angles::find_ranges() {
  for (const Steps direction : {Steps::either_way, Steps::forward, Steps::backward}) {
    direction_ = direction;
    if (keeps_ranges()) {
      return;
    }
  }
  const auto& states = listing_->states;
  const auto angle = std::find_if(states.begin(), states.end(),
                                  [&](const auto& state) { return is_angle_.at(state.input); });
  throw NoRecursion(
      fmt::format("the wraps do not keep {0} in a range, for steps of up to half a turn; allowed: "
                  "e.g. if ({0} > PI) {0} -= 2*PI; else if ({0} < -PI) {0} += 2*PI",
                  angle->name),
      at(angle->next).place);
}

/// From where they start on.
bool Angles::keeps_ranges() {
  ranges_.clear();
  bases_.clear();
  steps_.clear();
  rests_.clear();
  for (const trackers::code::State& state : listing_->states) {
    is_angle_[state.input] = turns_->is_wrapped(state.next);
    if (is_angle_[state.input]) {
      const double start = trackers::code::number_of(at(state.input).format, state.start_bits);
      ranges_[state.input] = {start, start};
    }
  }
  constexpr int kMostRounds = 8;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!widen_ranges()) {
      return true;
    }
  }
  return false;
}

/// One step further; true when a range has grown.
bool Angles::widen_ranges() {
  bool has_grown = false;
  for (const trackers::code::State& state : listing_->states) {
    if (!is_angle_.at(state.input)) {
      continue;
    }
    const std::optional<Range> next = range(state.next);
    if (!next) {
      throw NoRecursion(
          fmt::format("the new {} is not itself and a step, wrapped; allowed: e.g. theta += step; "
                      "if (theta > PI) theta -= 2*PI",
                      state.name),
          at(state.next).place);
    }
    Range& range = ranges_.at(state.input);
    const Range grown{std::min(range.low, next->low), std::max(range.high, next->high)};
    has_grown = has_grown || !(grown == range);
    range = grown;
  }
  return has_grown;
}

bool Angles::is_angular(int value) {
  const auto known = is_angle_.find(turns_->plain(value));
  return (known != is_angle_.end() && known->second) || turns_->is_wrapped(value);
}

std::optional<Angles::Rest> Angles::rest_of(int value) {
  value = turns_->plain(value);
  const auto known = rests_.find(value);
  return known != rests_.end() ? known->second : rests_[value] = rest_by_rules(value);
}

std::optional<Angles::Rest> Angles::rest_by_rules(int value) {
  if (is_angular(value)) {
    return Rest{value, -1, {}, 0};
  }
  const Instruction& sum = at(value);
  if (sum.operation == Operation::select) {
    return rest_of_choice(value);
  }
  if (sum.operation != Operation::fadd && sum.operation != Operation::fsub) {
    return std::nullopt;
  }
  const bool is_difference = sum.operation == Operation::fsub;
  if (std::optional<Rest> rest = rest_of(sum.operands[0])) {
    rest->terms.push_back({sum.operands[1], is_difference, false});
    return rest;
  }
  if (is_difference) {
    return rest_of_difference(sum);
  }
  std::optional<Rest> rest = rest_of(sum.operands[1]);
  if (rest) {
    rest->terms.push_back({sum.operands[0], false, false});
  }
  return rest;
}

/// Both branches are the same angle and more.
std::optional<Angles::Rest> Angles::rest_of_choice(int value) {
  const Instruction& choice = at(value);
  int condition = choice.operands[0];
  while (at(condition).operation == Operation::bit_xor &&
         at(at(condition).operands[1]).operation == Operation::constant) {
    condition = at(condition).operands[0];
  }
  const std::optional<Rest> yes = rest_of(choice.operands[1]);
  const std::optional<Rest> no = yes ? rest_of(choice.operands[2]) : std::nullopt;
  constexpr int kMostChoices = 8;  // their formulas have all branches of branches
  const bool is_one_angle = no && yes->angle == no->angle && yes->arc < 0 && no->arc < 0 &&
                            yes->choices + no->choices < kMostChoices;
  return is_one_angle && at(condition).operation == Operation::fcmp
             ? std::optional(Rest{yes->angle, -1, {{value, false, true}}, yes->choices + no->choices + 1})
             : std::nullopt;
}

/// The angle of a point, less an angle and more.
std::optional<Angles::Rest> Angles::rest_of_difference(const Instruction& difference) {
  const int arc = turns_->plain(difference.operands[0]);
  std::optional<Rest> rest =
      at(arc).operation == Operation::atan2 ? rest_of(difference.operands[1]) : std::nullopt;
  if (!rest || rest->arc >= 0) {
    return std::nullopt;
  }
  rest->arc = arc;
  for (Term& term : rest->terms) {
    term.is_subtracted = !term.is_subtracted;
  }
  return rest;
}

/// The range of a value that is made of angles and arc tangents alone.
std::optional<Range> Angles::range_of(int value) {
  value = turns_->plain(value);
  const Instruction& instruction = at(value);
  constexpr double kHalfTurn = std::numbers::pi + kWrapSlack;
  if (instruction.operation == Operation::atan2) {
    const double most = value == listing_->near_arc_tangent.value ? listing_->near_arc_tangent.largest : 0.0;
    return Range{-std::max(kHalfTurn, most), std::max(kHalfTurn, most)};
  }
  if (const auto known = ranges_.find(value); known != ranges_.end()) {
    return known->second;
  }
  if (turns_->is_wrapped(value)) {
    return range(value);
  }
  if (instruction.operation == Operation::fadd || instruction.operation == Operation::fsub) {
    const std::optional<Range> a = range_of(instruction.operands[0]);
    const std::optional<Range> b = range_of(instruction.operands[1]);
    if (a && b) {
      return instruction.operation == Operation::fadd ? Range{a->low + b->low, a->high + b->high}
                                                      : Range{a->low - b->high, a->high - b->low};
    }
  }
  return std::nullopt;
}

std::optional<Range> Angles::range(int value) {
  value = turns_->plain(value);
  if (const auto known = ranges_.find(value); known != ranges_.end()) {
    return known->second;
  }
  if (!turns_->is_wrapped(value)) {
    return std::nullopt;
  }
  const int base = turns_->without_turns(value);
  std::optional<Range> of_base = range_of(base);
  if (!of_base) {
    const std::optional<Rest> rest = rest_of(base);
    const std::optional<Range> before = rest ? range(rest->angle) : std::nullopt;
    if (!before) {
      return std::nullopt;
    }
    const bool is_step = rest->arc < 0;
    const double low = is_step && direction_ == Steps::forward ? kLeastStep : -std::numbers::pi;
    const double high = is_step && direction_ == Steps::backward ? -kLeastStep : std::numbers::pi;
    const std::optional<Range> of_arc = is_step ? Range{} : range_of(rest->arc);
    of_base = is_step ? Range{before->low + low, before->high + high}
                      : Range{of_arc->low - before->high + low, of_arc->high - before->low + high};
    of_base = Range{of_base->low - kWrapSlack, of_base->high + kWrapSlack};
    steps_.insert(base);
  }
  bases_[base] = *of_base;
  return turns_->range(value, base, *of_base);
}

/// Whether a state is part of a sum.
bool Angles::is_summand(int state, int sum) const {
  sum = turns_->plain(sum);
  const Instruction& instruction = at(sum);
  const bool is_sum = instruction.operation == Operation::fadd || instruction.operation == Operation::fsub;
  return sum == state || (is_sum && (is_summand(state, instruction.operands[0]) ||
                                     is_summand(state, instruction.operands[1])));
}

void Angles::require_wraps(int angle) {
  if (rest_of(angle)) {
    return;  // it is the sum of an angle and more
  }
  const auto grows = [&](const trackers::code::State& state) {
    return is_summand(state.input, angle) && is_summand(state.input, state.next) &&
           turns_->plain(state.next) != state.input;
  };
  const auto moves_by_another = [&](const trackers::code::State& state) {
    return grows(state) &&
           std::any_of(listing_->states.begin(), listing_->states.end(), [&](const auto& other) {
             return other.input != state.input && is_summand(other.input, state.next);
           });
  };
  const auto& states = listing_->states;
  auto found = std::find_if(states.begin(), states.end(), moves_by_another);
  found = found == states.end() ? std::find_if(states.begin(), states.end(), grows) : found;
  if (found != states.end()) {
    throw NoRecursion(
        fmt::format("the angle {0} grows for ever and is not wrapped, so that its steps are rounded "
                    "away in the end; allowed: e.g. if ({0} > PI) {0} -= 2*PI",
                    found->name),
        at(found->next).place);
  }
}

}  // namespace veritrack::certificates::code

#include "checker/sets/rounded_turn.hpp"

namespace veritrack::checker {

namespace {

/// A sine or a cosine, whose unit in the last place is at most 2^-52.
const RoundedValue& turn_factor() {
  static const RoundedValue value{one, Ball(0x1p-52)};
  return value;
}

}  // namespace

RoundedValue turned_component(const RoundedValue& x) {
  return sum(product(x, turn_factor()), product(x, turn_factor()));
}

std::pair<RoundedValue, RoundedValue> turned_block(const RoundedValue& diagonal, const RoundedValue& beside) {
  const RoundedValue& s = turn_factor();
  const RoundedValue sine_twice = product(sum(s, s), s).within(one);
  const RoundedValue cosine_twice = sum(held(one), sum(product(s, s), product(s, s))).within(one);
  const RoundedValue mean = product(held(half), sum(diagonal, diagonal)).within(diagonal.size);
  const RoundedValue half_difference =
      product(held(half), sum(diagonal, diagonal)).within(half * diagonal.size);
  const RoundedValue moved = sum(product(half_difference, cosine_twice), product(beside, sine_twice));
  return {sum(mean, moved), sum(product(half_difference, sine_twice), product(beside, cosine_twice))};
}

}  // namespace veritrack::checker

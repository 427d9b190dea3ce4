#include "checker/model/gain/gain_rounding.hpp"

#include <utility>

#include "checker/model/gain/frame_value.hpp"

namespace veritrack::checker {

std::vector<Ball> states_within(const std::vector<Ball>& room, const std::vector<SteadyState>& steady,
                                const std::vector<bool>& is_angle, const Ball& lowest, const Ball& highest) {
  std::vector<Ball> states;
  for (std::size_t i = 0; i < steady.size(); ++i) {
    const bool is_point = !is_angle[i] && steady[i].turns == 0 && !steady[i].imaginary;
    const Ball frequency = Ball::hull(lowest, highest);
    states.push_back(is_point
                         ? steady[i].constant + steady[i].per_frequency * frequency + Ball::within(room[i])
                         : Ball::everything());
  }
  return states;
}

void add_rounding(const GainRounding& rounding, const std::vector<bool>& is_angle, GainNetwork& network) {
  if (!network.ripples.empty() || network.has_vector) {
    throw NotCovered("rounding is for loops of two channels without vectors");
  }
  const std::size_t n = network.states();
  for (std::size_t i = 0; i < n; ++i) {
    GainInput input;
    input.column.assign(n, {zero, zero});
    input.column[i].first = one;
    input.size = [size = rounding.next[i]](const Ball& /*noise*/, const Ball& /*slew*/) { return size; };
    network.inputs.push_back(std::move(input));
    if (is_angle[i]) {
      continue;
    }
    GainForm state;
    state.row.assign(n, zero);
    state.row[i] = one;
    network.limits.push_back({network.forms.size(), zero, -rounding.room[i], rounding.room[i]});
    network.forms.push_back(std::move(state));
  }
  network.is_rounded = true;
  network.rounding_of_start = rounding.next;
  network.rounding_of_frequency = rounding.frequency;
}

}  // namespace veritrack::checker

#include "certificates/model/tie/draw_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "certificates/model/model_design.hpp"
#include "certificates/model/tie/evaluation.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Listing;

constexpr double kMostOfAnAngle = 1.25 * std::numbers::pi;
constexpr DrawRanges::Range kElsewhere{-4.0, 4.0};  // of states that the design says nothing of

/// The states that a register is computed from.
std::vector<std::size_t> states_behind(const Listing& listing, int value) {
  std::vector<bool> is_needed(listing.instructions.size());
  is_needed[static_cast<std::size_t>(value)] = true;
  for (std::size_t i = listing.instructions.size(); i-- > 0;) {
    for (const int operand : listing.instructions[i].operands) {
      if (is_needed[i] && operand >= 0) {
        is_needed[static_cast<std::size_t>(operand)] = true;
      }
    }
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < listing.states.size(); ++i) {
    if (is_needed[static_cast<std::size_t>(listing.states[i].input)]) {
      found.push_back(i);
    }
  }
  return found;
}

/// The frequency where this state is so much, all others at their start.
double frequency_at(const Listing& listing, std::size_t state, double number) {
  StepInput step;
  for (const auto& each : listing.states) {
    step.states.push_back(each.start_bits);
  }
  const auto format = [&](int value) { return listing.instructions[static_cast<std::size_t>(value)].format; };
  step.states[state] = trackers::code::bits_of(format(listing.states[state].input), number);
  step.samples.assign(listing.samples.size(), 0);
  const auto registers = registers_of(listing, {step}, own_library).front();
  return trackers::code::number_of(format(listing.frequency),
                                   registers[static_cast<std::size_t>(listing.frequency)]);
}

/// The band as a range of the only state that the frequency is read from, where it grows in proportion.
void set_band(const Listing& listing, double low, double high, DrawRanges& ranges) {
  const std::vector<std::size_t> states = states_behind(listing, listing.frequency);
  if (states.size() != 1) {
    return;
  }
  const std::size_t state = states.front();
  const auto input = static_cast<std::size_t>(listing.states[state].input);
  if (!listing.instructions[input].format.is_float) {
    return;
  }
  const double at_zero = frequency_at(listing, state, 0.0);
  const double slope = frequency_at(listing, state, 1.0) - at_zero;
  const double from = (low - at_zero) / slope;
  const double to = (high - at_zero) / slope;
  const double error = std::fabs(frequency_at(listing, state, to) - high);
  if (!std::isfinite(from) || !std::isfinite(to) || !(error < 1e-3 * high)) {
    return;
  }
  const double beyond = std::fabs(to - from) / 8.0;
  ranges.states[state] = {std::min(from, to) - beyond, std::max(from, to) + beyond};
}

}  // namespace

DrawRanges draw_ranges(const Design& design) {
  const ModelTables& tables = model_tables(design);
  const code::CompiledCode& compiled = tables.model.compiled.value();
  const Listing& listing = compiled.listing;
  DrawRanges ranges;
  ranges.states.assign(listing.states.size(), kElsewhere);
  ranges.amplitude = {tables.assume.amplitude[0].nearest, tables.assume.amplitude[1].nearest};
  ranges.noise = std::isfinite(tables.assume.noise.nearest) ? std::fabs(tables.assume.noise.nearest) : 0.0;
  const double unit = tables.assume.frequency_in_hertz  // of the band, in rad/sample
                          ? 2.0 * std::numbers::pi / tables.assume.sample_rate.value().nearest
                          : 1.0;
  set_band(listing, unit * tables.assume.frequency[0].nearest, unit * tables.assume.frequency[1].nearest,
           ranges);
  for (std::size_t i = 0; i < listing.states.size(); ++i) {
    const auto known = compiled.recursion.ranges.find(listing.states[i].input);
    if (known != compiled.recursion.ranges.end()) {
      // Wraps may allow more than a turn, where steps are never found.
      const double middle = std::midpoint(known->second.low, known->second.high);
      const double half = std::min((known->second.high - known->second.low) / 2.0, kMostOfAnAngle);
      ranges.states[i] = {middle - half, middle + half};
    }
  }
  return ranges;
}

}  // namespace veritrack::certificates::tie

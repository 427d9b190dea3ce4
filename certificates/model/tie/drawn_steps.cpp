#include "certificates/model/tie/drawn_steps.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>

#include "certificates/model/tie/branch_points.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Format;
using trackers::code::Listing;

constexpr int kMostTries = 20;  // for each step that is wanted

Format format_at(const Listing& listing, int value) {
  return listing.instructions[static_cast<std::size_t>(value)].format;
}

std::uint64_t drawn_state(Draws& draws, Format format, std::uint64_t start, DrawRanges::Range range) {
  if (!format.is_float) {
    const std::uint64_t bits = draws.below(3) == 0 ? draws.word() : start + draws.below(1001) - 500;
    return trackers::code::wrapped(format, bits);
  }
  constexpr std::array kSpecial{0.0, -0.0, 1.0, std::numbers::pi, -std::numbers::pi, 1e-30, 100.0};
  const double near = trackers::code::number_of(format, start);
  const auto bits = [&](double number) { return trackers::code::bits_of(format, number); };
  switch (draws.below(8)) {
    case 0:
      return bits(kSpecial.at(draws.below(kSpecial.size())));
    case 1:
    case 2:
    case 3:
    case 4:
      return bits(draws.uniform(range.low, range.high));
    case 5:
      return bits(near * draws.uniform(0.5, 1.5));
    default:
      return bits(near + draws.uniform(-0.5, 1.0));
  }
}

StepInput drawn_step(Draws& draws, const Listing& listing, const DrawRanges& ranges) {
  StepInput step;
  for (std::size_t i = 0; i < listing.states.size(); ++i) {
    const auto& state = listing.states[i];
    step.states.push_back(
        drawn_state(draws, format_at(listing, state.input), state.start_bits, ranges.states.at(i)));
  }
  const double amplitude = draws.uniform(ranges.amplitude.low, ranges.amplitude.high);
  const double phase = draws.uniform(-std::numbers::pi, std::numbers::pi);
  for (std::size_t i = 0; i < listing.samples.size(); ++i) {
    const Format format = format_at(listing, listing.samples[i]);
    const double tone = amplitude * (i == 0 ? std::cos(phase) : std::sin(phase));
    const double sample = tone + draws.uniform(-ranges.noise, ranges.noise);
    step.samples.push_back(
        format.is_float ? trackers::code::bits_of(format, sample)
                        : trackers::code::wrapped(format, static_cast<std::uint64_t>(std::llround(sample))));
  }
  return step;
}

/// Keeps the steps that obligations allow, and counts the others; which ones it has kept.
std::vector<std::size_t> keep(const Listing& listing, const std::vector<StepInput>& steps, std::size_t most,
                              DrawnSteps& into) {
  const auto registers = registers_of(listing, steps, own_library);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < steps.size() && into.steps.size() < most; ++i) {
    const int broken = broken_obligation(listing, registers[i]);
    if (broken < 0) {
      into.steps.push_back(steps[i]);
      kept.push_back(i);
    } else {
      ++into.left_out[broken];
    }
  }
  return kept;
}

}  // namespace

DrawnSteps drawn_steps(const Listing& listing, const DrawRanges& ranges, int count, std::uint64_t seed) {
  Draws draws(seed);
  DrawnSteps result;
  const auto draw = [&] { return drawn_step(draws, listing, ranges); };
  // Some of them will not keep an obligation.
  const BranchPoints points = steps_beside_branches(listing, draw, count / 5);
  std::set<std::size_t> changing;
  for (const std::size_t i : keep(listing, points.steps, static_cast<std::size_t>(count / 10), result)) {
    changing.insert(points.changing[i]);
  }
  result.beside_branches = static_cast<int>(result.steps.size());
  result.comparisons = points.comparisons;
  result.changed_comparisons = static_cast<int>(changing.size());
  const auto most = static_cast<std::size_t>(count);
  for (int round = 0; round < kMostTries && result.steps.size() < most; ++round) {
    std::vector<StepInput> steps;
    while (steps.size() < most - result.steps.size()) {
      steps.push_back(draw());
    }
    static_cast<void>(keep(listing, steps, most, result));
  }
  return result;
}

}  // namespace veritrack::certificates::tie

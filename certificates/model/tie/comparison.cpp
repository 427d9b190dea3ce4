#include "certificates/model/tie/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Format;
using trackers::code::Listing;
using Words = std::vector<std::uint64_t>;

Format format_of_register(const Listing& listing, int value) {
  return listing.instructions[static_cast<std::size_t>(value)].format;
}

/// The register of state number i after the step; that of the frequency behind the states.
int register_of(const Listing& listing, std::size_t i) {
  return i < listing.states.size() ? listing.states[i].next : listing.frequency;
}

Words without_unused_bits(const Listing& listing, Words values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Format format = format_of_register(listing, register_of(listing, i));
    values[i] = format.is_float ? values[i] : trackers::code::wrapped(format, values[i]);
  }
  return values;
}

/// What the program makes of the states, which it may not have as they are: a bool is 0 or 1.
void keep_what_program_keeps(const Listing& listing, const BuiltProgram& program,
                             std::vector<StepInput>& steps) {
  std::vector<Words> requests;
  requests.reserve(steps.size());
  for (const StepInput& step : steps) {
    requests.push_back(step.states);
  }
  const std::vector<Words> kept = program.ask(Question::keep, requests, listing.states.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Words states = without_unused_bits(listing, kept[k]);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Format format = format_of_register(listing, listing.states[i].input);
      if (format.is_float && !are_equal(format, states[i], steps[k].states[i])) {
        throw BuildError(
            fmt::format("the state {} does not keep the number that it is set to; allowed: --state "
                        "{}=EXPRESSION, in C, of a variable of the same type as in the listing",
                        listing.states[i].name, listing.states[i].name));
      }
    }
    steps[k].states = states;
  }
}

void compare(const Listing& listing, const Words& expected, const Words& found, const StepInput* before,
             BuildResult& result) {
  bool is_same = true;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Format format = format_of_register(listing, register_of(listing, i));
    if (are_equal(format, expected[i], found[i])) {
      continue;
    }
    is_same = false;
    if (!result.first) {
      result.first = {static_cast<int>(i), before == nullptr, found[i], expected[i],
                      before == nullptr ? StepInput{} : *before};
    }
    if (format.is_float && before != nullptr) {
      const double distance = std::fabs(trackers::code::number_of(format, expected[i]) -
                                        trackers::code::number_of(format, found[i]));
      result.largest[i] = std::isfinite(distance) ? std::max(result.largest[i], distance) : HUGE_VAL;
    }
  }
  if (before != nullptr) {
    ++result.compared;
    result.different += is_same ? 0 : 1;
  } else {
    result.differs_at_start = !is_same;
  }
}

}  // namespace

bool are_equal(Format format, std::uint64_t a, std::uint64_t b) {
  return a == b || (format.is_float && std::isnan(trackers::code::number_of(format, a)) &&
                    std::isnan(trackers::code::number_of(format, b)));
}

BuildResult compared(const Listing& listing, const BuiltProgram& program,
                     const std::vector<StepInput>& steps) {
  const std::size_t values = listing.states.size() + 1;
  BuildResult result;
  result.largest.assign(values, 0.0);
  if (listing.steps_before == 0) {
    Words start;
    for (const auto& state : listing.states) {
      start.push_back(state.start_bits);
    }
    Words found = program.ask(Question::start, {}, values).front();
    found.pop_back();  // the frequency of a state is compared in steps
    compare(listing, start, without_unused_bits(listing, found), nullptr, result);
  }
  std::vector<StepInput> kept = steps;
  keep_what_program_keeps(listing, program, kept);
  const auto library = [&](LibraryFunction function, const std::vector<LibraryArguments>& arguments) {
    return program.library(function, arguments);
  };
  const std::vector<Words> registers = registers_of(listing, kept, library);
  std::vector<Words> requests;
  std::vector<std::size_t> asked;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (const int broken = broken_obligation(listing, registers[k]); broken >= 0) {
      ++result.left_out[broken];
      continue;
    }
    Words request = kept[k].states;
    request.insert(request.end(), kept[k].samples.begin(), kept[k].samples.end());
    requests.push_back(std::move(request));
    asked.push_back(k);
  }
  const std::vector<Words> answers = program.ask(Question::step, requests, values);
  for (std::size_t n = 0; n < asked.size(); ++n) {
    Words expected;
    for (std::size_t i = 0; i < values; ++i) {
      expected.push_back(registers[asked[n]][static_cast<std::size_t>(register_of(listing, i))]);
    }
    compare(listing, expected, without_unused_bits(listing, answers[n]), &kept[asked[n]], result);
  }
  return result;
}

}  // namespace veritrack::certificates::tie

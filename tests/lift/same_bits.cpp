#include "tests/lift/same_bits.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

#include "tests/support/random.hpp"
#include "tests/support/scratch_folder.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::Format;
using trackers::code::Listing;

Format format_of(const Listing& listing, int value) {
  return listing.instructions.at(static_cast<std::size_t>(value)).format;
}

/// Whether the program only keeps 0 and 1 in a state: our sources call such a state so.
bool is_truth(const std::string& name) {
  return name.find("is_") != std::string::npos;
}

/// Bits of a state or a sample: near its start, in a range, or next to where branches are.
std::uint64_t drawn(test::Random& random, Format format, std::uint64_t start) {
  if (!format.is_float) {
    return trackers::code::wrapped(format, random.below(3) == 0 ? start + random.below(1000) : random.word());
  }
  constexpr std::array kSpecial{0.0, -0.0, 1.0, 3.1415927, -3.1415927, 1e-30, 100.0};
  const double near = trackers::code::number_of(format, start);
  switch (random.below(8)) {
    case 0:
      return trackers::code::bits_of(format, kSpecial.at(random.below(kSpecial.size())));
    case 1:
    case 2:
      return trackers::code::bits_of(format, random.uniform(-4.0, 4.0));
    case 3:
      return trackers::code::bits_of(format, near * random.uniform(0.5, 1.5));
    default:
      return trackers::code::bits_of(format, near + random.uniform(-0.5, 1.0));
  }
}

bool are_equal(Format format, std::uint64_t a, std::uint64_t b) {
  return a == b || (format.is_float && std::isnan(trackers::code::number_of(format, a)) &&
                    std::isnan(trackers::code::number_of(format, b)));
}

}  // namespace

Runs expected_steps(const Listing& listing) {
  test::Random random;
  Runs steps;
  for (int tries = 0; static_cast<int>(steps.before.size()) < kSteps && tries < 20 * kSteps; ++tries) {
    std::vector<std::uint64_t> states;
    for (const auto& state : listing.states) {
      const std::uint64_t bits = drawn(random, format_of(listing, state.input), state.start_bits);
      states.push_back(is_truth(state.name) ? bits & 1U : bits);
    }
    std::vector<std::uint64_t> samples;
    for (const int sample : listing.samples) {
      const bool is_number = random.below(200) != 0;
      const double number = is_number ? random.uniform(-1.5, 1.5) : std::nan("");
      samples.push_back(trackers::code::bits_of(format_of(listing, sample), number));
    }
    const std::vector<std::uint64_t> registers = trackers::code::run(listing, states, samples);
    bool is_defined = true;
    for (const auto& obligation : listing.obligations) {
      is_defined = is_defined && registers.at(static_cast<std::size_t>(obligation.must_be_zero)) == 0;
    }
    if (!is_defined) {
      continue;
    }
    std::vector<std::uint64_t> after;
    for (const auto& state : listing.states) {
      after.push_back(registers.at(static_cast<std::size_t>(state.next)));
    }
    after.push_back(registers.at(static_cast<std::size_t>(listing.frequency)));
    steps.after.push_back(after);
    states.insert(states.end(), samples.begin(), samples.end());
    steps.before.push_back(states);
  }
  return steps;
}

int differences(const Listing& listing, const Runs& expected, const Runs& compiled) {
  int count = 0;
  for (std::size_t k = 0; k < expected.after.size(); ++k) {
    bool is_equal = true;
    for (std::size_t i = 0; i < expected.after[k].size(); ++i) {
      const int value = i < listing.states.size() ? listing.states[i].next : listing.frequency;
      is_equal = is_equal && are_equal(format_of(listing, value), expected.after[k][i], compiled.after[k][i]);
    }
    count += is_equal ? 0 : 1;
  }
  return count;
}

Listing check_same_bits(const std::string& text, const std::string& name,
                        const std::map<std::string, std::string>& expressions) {
  const test::ScratchFolder folder;
  std::ofstream(folder / name) << text;
  const LiftResult result = lift_file(folder / name);
  CAPTURE(text);
  REQUIRE(result.error == "");
  const Listing& listing = result.listing;
  const Runs steps = expected_steps(listing);
  CHECK(steps.before.size() == kSteps);
  const std::string compiler = name.find(".cpp") != std::string::npos ? "g++" : "gcc";
  for (const char* flags : {" -O0", " -O2"}) {
    CAPTURE(flags);
    Runs compiled{steps.before, {}, {}};
    run_compiled(folder / name, compiler + flags, listing, expressions, compiled);
    CHECK(differences(listing, steps, compiled) == 0);
    for (std::size_t i = 0; listing.steps_before == 0 && i < listing.states.size(); ++i) {
      CHECK(compiled.start.at(i) == listing.states[i].start_bits);
    }
  }
  return listing;
}

}  // namespace veritrack::lift

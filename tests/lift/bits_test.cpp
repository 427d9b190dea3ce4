// The listing of each of our functions gives the same bits as the compiled function, however it is compiled.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "certificates/code/listing_text.hpp"
#include "tests/lift/lifting.hpp"
#include "tests/lift/same_bits.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::Listing;

struct Expected {
  const char* file;
  int operations;
  std::size_t states;
  std::size_t obligations;
  std::map<std::string, std::string> expressions;
};

std::filesystem::path path_of(const char* file) {
  return std::filesystem::path(VERITRACK_SOURCE_DIR) / "tests/lift/functions" / file;
}

int operations_of(const Listing& listing) {
  int count = 0;
  for (const auto& instruction : listing.instructions) {
    using trackers::code::Operation;
    count +=
        instruction.operation != Operation::constant && instruction.operation != Operation::input ? 1 : 0;
  }
  return count;
}

/// That of a design.
const char* const kGridLoop = "../../../designs/code/sogi-fll.c";

std::vector<Expected> functions() {
  std::map<std::string, std::string> ages;
  for (int age = 1; age <= 5; ++age) {
    ages[fmt::format("line.past_._M_elems_{}_ago", age)] =
        fmt::format("line.past_._M_elems[(line.at_ + 5 - {}) % 5]", age);
  }
  return {
      {"chosen_detector.cpp", 23, 3, 0, {{"memory_of_line_1065_12", "((Limited*)detector.get())->mean_"}}},
      {"constant_table.c", 87, 2, 13, {}},
      {"delay_line.cpp", 18, 8, 0, ages},
      {"double_literals.c", 34, 4, 0, {}},
      {"fast_arc_tangent.c", 36, 2, 0, {}},
      {"integer_oscillator.c", 23, 2, 2, {}},
      {"kalman_notch.c", 29, 4, 0, {}},
      {"lock_counter.c", 14, 2, 0, {}},
      {"motor_pll.c", 48, 2, 2, {}},
      {"optional_result.cpp", 49, 2, 2, {}},
      {"sine_table.c", 33, 2, 4, {}},
      {kGridLoop, 20, 3, 0, {}},
      {"template_loop.cpp", 19, 3, 0, {}},
  };
}

}  // namespace

TEST_CASE("Each function lifts, and its listing is read as it is written") {
  for (const Expected& expected : functions()) {
    CAPTURE(expected.file);
    const LiftResult result = lift_file(path_of(expected.file));
    REQUIRE(result.error == "");
    CHECK(operations_of(result.listing) == expected.operations);
    CHECK(result.listing.states.size() == expected.states);
    CHECK(result.listing.obligations.size() == expected.obligations);
    const std::string text = certificates::code::listing_text(result.listing);
    CHECK(certificates::code::listing_text(certificates::code::parse_listing(text)) == text);
  }
}

TEST_CASE("A listing gives the bits of the compiled function") {
  for (const Expected& expected : functions()) {
    const LiftResult result = lift_file(path_of(expected.file));
    REQUIRE(result.error == "");
    const Listing& listing = result.listing;
    const Runs steps = expected_steps(listing);
    CAPTURE(expected.file);
    CHECK(steps.before.size() == kSteps);
    const bool is_cpp = path_of(expected.file).extension() == ".cpp";
    for (const char* flags : {"gcc -O0", "gcc -O2", "gcc -O3", "clang -O2"}) {
      CAPTURE(flags);
      const std::string name = std::string(flags).substr(0, std::string(flags).find(' '));
      const std::string compiler =
          name == "gcc" ? (is_cpp ? "g++" : "gcc") : (is_cpp ? "clang++-14" : "clang-14");
      Runs compiled{steps.before, {}, {}};
      run_compiled(path_of(expected.file), compiler + (flags + name.size()), listing, expected.expressions,
                   compiled);
      CHECK(differences(listing, steps, compiled) == 0);
      for (std::size_t i = 0; listing.steps_before == 0 && i < listing.states.size(); ++i) {
        CHECK(compiled.start.at(i) == listing.states[i].start_bits);
      }
    }
  }
}

TEST_CASE("A changed listing is found") {
  // The comparison has to see a constant that is wrong in its last bit.
  LiftResult result = lift_file(path_of(kGridLoop));
  REQUIRE(result.error == "");
  const Listing listing = result.listing;
  Runs compiled{expected_steps(listing).before, {}, {}};
  run_compiled(path_of(kGridLoop), "gcc -O2", listing, {}, compiled);
  for (auto& instruction : result.listing.instructions) {
    if (instruction.operation == trackers::code::Operation::constant && instruction.format.is_float) {
      ++instruction.bits;
      break;
    }
  }
  CHECK(differences(listing, expected_steps(result.listing), compiled) > 100);
}

}  // namespace veritrack::lift

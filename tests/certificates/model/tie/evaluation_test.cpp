#include "certificates/model/tie/evaluation.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "certificates/code/listing_text.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::kSingle;
using trackers::code::Listing;

Listing with_two_calls() {
  return code::parse_listing(
      "veritrack listing 1\nfile 0 loop.c\nsample r0 f32 y\nstate r1 f32:0x1p-2 w\n"
      "r2 = sin.f32 r1\nr3 = atan2.f32 r0 r2\nr4 = sin.f32 r3\nr5 = fadd.f32 r4 r1\n"
      "r6 = fcmp.ogt.f32 r5 f32:0x1p+0\nnext r1 r5\nfrequency r1\nmust-be-zero r6 @0:3:4 it is small\n");
}

std::uint64_t bits(double number) {
  return trackers::code::bits_of(kSingle, number);
}

}  // namespace

TEST_CASE("with the library of this process, the registers are those of a run") {
  const Listing listing = with_two_calls();
  const std::vector<StepInput> steps{{{bits(0.3)}, {bits(-0.7)}}, {{bits(-2.5)}, {bits(0.1)}}};
  const auto registers = registers_of(listing, steps, own_library);
  REQUIRE(registers.size() == 2);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    CHECK(registers[i] == trackers::code::run(listing, steps[i].states, steps[i].samples));
  }
}

TEST_CASE(
    "another library is asked once for each operation, with all its arguments, in the listing's order") {
  const Listing listing = with_two_calls();
  std::vector<LibraryFunction> asked;
  const auto library = [&](LibraryFunction function, const std::vector<LibraryArguments>& arguments) {
    asked.push_back(function);
    REQUIRE(arguments.size() == 2);
    if (asked.size() == 2) {  // atan2(y, what the sine was)
      CHECK(arguments[1] == LibraryArguments{bits(0.1), bits(0.5)});
    }
    return std::vector<std::uint64_t>(2, bits(asked.size() == 2 ? 3.0 : 0.5));
  };
  const auto registers =
      registers_of(listing, {{{bits(0.25)}, {bits(0.7)}}, {{bits(0.75)}, {bits(0.1)}}}, library);
  const LibraryFunction sine{trackers::code::Operation::sin, kSingle};
  const LibraryFunction arc{trackers::code::Operation::atan2, kSingle};
  CHECK(asked == std::vector<LibraryFunction>{sine, arc, sine});
  CHECK(library_functions(listing) == std::vector<LibraryFunction>{sine, arc});
  CHECK(registers[0][static_cast<std::size_t>(listing.states[0].next)] == bits(0.75));
  CHECK(broken_obligation(listing, registers[0]) == -1);
  CHECK(broken_obligation(listing, registers[1]) == 0);
}

TEST_CASE("a library that gives too little, and inputs of another listing, are refused") {
  const Listing listing = with_two_calls();
  const auto none = [](LibraryFunction, const std::vector<LibraryArguments>&) {
    return std::vector<std::uint64_t>{};
  };
  CHECK_THROWS_AS((void)registers_of(listing, {{{bits(0.3)}, {bits(0.1)}}}, none), std::logic_error);
  CHECK_THROWS_AS((void)registers_of(listing, {{{}, {bits(0.1)}}}, own_library), std::invalid_argument);
}

}  // namespace veritrack::certificates::tie

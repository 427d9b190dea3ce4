#include "certificates/model/tie/branch_points.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

#include "certificates/code/listing_text.hpp"
#include "certificates/model/tie/drawn_steps.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::kSingle;
using trackers::code::Listing;

Listing listing_of_lines(const std::string& lines) {
  return code::parse_listing(
      "veritrack listing 1\nfile 0 loop.c\nsample r0 f32 y\nstate r1 f32:0x1p-2 w\nstate r2 "
      "i32:7 count\n" +
      lines + "next r1 r1\nnext r2 r2\nfrequency r1\n");
}

/// Numbers from -4 to 4, and a small count of either sign.
std::function<StepInput()> inputs(Draws& draws) {
  return [&draws] {
    StepInput step;
    step.states.push_back(trackers::code::bits_of(kSingle, draws.uniform(-4.0, 4.0)));
    step.states.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(draws.below(100)) - 50));
    step.samples.push_back(trackers::code::bits_of(kSingle, draws.uniform(-4.0, 4.0)));
    return step;
  };
}

}  // namespace

TEST_CASE("pairs are neighbours in one input, and the comparison is true for one of them") {
  const Listing listing = listing_of_lines(
      "r3 = fmul.f32 r0 r1\nr4 = fcmp.ogt.f32 r3 f32:0x1p-1\nr5 = fcmp.olt.f32 r1 f32:-0x1p+0\n"
      "r6 = icmp.sgt.i32 r2 i32:4294967291\n");
  Draws draws(3);
  const BranchPoints points = steps_beside_branches(listing, inputs(draws), 60);
  REQUIRE(points.steps.size() == 60);
  REQUIRE(points.changing.size() == 60);
  CHECK(points.comparisons == 3);
  CHECK(std::set<std::size_t>(points.changing.begin(), points.changing.end()).size() == 3);
  const auto registers = registers_of(listing, points.steps, own_library);
  for (std::size_t i = 0; i < 60; i += 2) {
    const std::size_t comparison = points.changing[i];
    CHECK(registers[i][comparison] != registers[i + 1][comparison]);
    const StepInput& a = points.steps[i];
    const StepInput& b = points.steps[i + 1];
    int different = 0;
    const auto differ = [&](double x, double y, double unit) {
      different += x != y ? 1 : 0;
      CHECK(std::fabs(x - y) <= unit);
    };
    const auto number = [](std::uint64_t word) { return trackers::code::number_of(kSingle, word); };
    const double ulp = std::ldexp(std::fabs(number(a.states[0])) + 1e-30, -22);
    differ(number(a.states[0]), number(b.states[0]), ulp);
    differ(static_cast<std::int32_t>(a.states[1]), static_cast<std::int32_t>(b.states[1]), 1.0);
    differ(number(a.samples[0]), number(b.samples[0]),
           std::ldexp(std::fabs(number(a.samples[0])) + 1e-30, -22));
    CHECK(different == 1);
  }
}

TEST_CASE("a comparison that is the same everywhere has no pairs, nor has one that asks for numbers") {
  const Listing listing = listing_of_lines("r3 = fcmp.uno.f32 r0 r1\nr4 = fcmp.ogt.f32 r1 f32:0x1p+10\n");
  Draws draws(3);
  const BranchPoints points = steps_beside_branches(listing, inputs(draws), 60);
  CHECK(points.steps.empty());
  CHECK(points.comparisons == 1);
}

TEST_CASE("a change at 0 is found from below and from above") {
  const Listing listing = listing_of_lines("r3 = fcmp.ogt.f32 r1 f32:0x0p+0\n");
  Draws draws(3);
  const BranchPoints points = steps_beside_branches(listing, inputs(draws), 20);
  REQUIRE(points.steps.size() == 20);
  for (const StepInput& step : points.steps) {
    CHECK(std::fabs(trackers::code::number_of(kSingle, step.states[0])) <= 0x1p-149);
  }
}

}  // namespace veritrack::certificates::tie

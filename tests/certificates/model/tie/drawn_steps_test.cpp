#include "certificates/model/tie/drawn_steps.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "certificates/code/listing_text.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::kSingle;
using trackers::code::Listing;

Listing limited(const std::string& limit) {
  return code::parse_listing(
      "veritrack listing 1\nfile 0 loop.c\nsample r0 f32 y\nsample r1 f32 z\nstate r2 f32:0x1.9p+6 w\n"
      "r3 = fcmp.ogt.f32 r2 " +
      limit +
      "\nr4 = fcmp.ogt.f32 r2 f32:0x1.9p+6\nr5 = select.f32 r4 r2 r0\n"
      "next r2 r5\nfrequency r2\nmust-be-zero r3 @0:3:4 w is small\n");
}

DrawRanges around(double low, double high) {
  DrawRanges ranges;
  ranges.states = {{low, high}};
  ranges.amplitude = {2.0, 3.0};
  ranges.noise = 0.25;
  return ranges;
}

double state_of(const StepInput& step) {
  return trackers::code::number_of(kSingle, step.states[0]);
}

}  // namespace

TEST_CASE("as many steps as wanted, the same for the same seed") {
  const Listing listing = limited("f32:0x1p+20");
  const DrawnSteps drawn = drawn_steps(listing, around(150.0, 160.0), 1000, 1);
  CHECK(drawn.steps.size() == 1000);
  CHECK(drawn.beside_branches == 100);
  CHECK(drawn.changed_comparisons == 1);
  CHECK(drawn.comparisons == 2);
  CHECK(drawn.left_out.empty());
  const auto same = drawn_steps(listing, around(150.0, 160.0), 1000, 1);
  const auto other = drawn_steps(listing, around(150.0, 160.0), 1000, 2);
  int equal = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    CHECK(same.steps[i].states == drawn.steps[i].states);
    CHECK(same.steps[i].samples == drawn.steps[i].samples);
    equal += other.steps[i].states == drawn.steps[i].states ? 1 : 0;
  }
  CHECK(equal < 300);
}

TEST_CASE("states are in the range and near the start; samples are a tone in phase and quadrature") {
  const DrawnSteps drawn = drawn_steps(limited("f32:0x1p+20"), around(150.5, 160.0), 1000, 1);
  const auto count = [&](double low, double high) {
    return std::count_if(drawn.steps.begin(), drawn.steps.end(), [&](const StepInput& step) {
      return state_of(step) >= low && state_of(step) <= high;
    });
  };
  CHECK(count(150.5, 160.0) > 300);
  CHECK(count(99.0, 101.5) > 150);
  CHECK(count(-3.2, 3.2) > 40);  // 0, -0, 1, pi
  for (const StepInput& step : drawn.steps) {
    const double y = trackers::code::number_of(kSingle, step.samples[0]);
    const double z = trackers::code::number_of(kSingle, step.samples[1]);
    CHECK(std::hypot(y, z) > 2.0 - 0.36);
    CHECK(std::hypot(y, z) < 3.0 + 0.36);
  }
}

TEST_CASE("steps that do not keep an obligation are left out and counted; there may be no others") {
  const DrawnSteps half = drawn_steps(limited("f32:0x1.3ap+7"), around(150.0, 160.0), 1000, 1);  // 157
  CHECK(half.steps.size() == 1000);
  REQUIRE(half.left_out.size() == 1);
  CHECK(half.left_out.at(0) > 50);
  for (const StepInput& step : half.steps) {
    CHECK(state_of(step) <= 157.0);
  }
  const DrawnSteps none = drawn_steps(limited("f32:-0x1p+20"), around(150.0, 160.0), 100, 1);
  CHECK(none.steps.empty());
  CHECK(none.left_out.at(0) > 1000);
}

}  // namespace veritrack::certificates::tie

// The line that makes most of a program's rounding.
#include "certificates/model/rounding_lines.hpp"

#include <doctest/doctest.h>

#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/code/listing_text.hpp"

namespace veritrack::certificates {
namespace {

using rigor::Interval;

code::CompiledCode compiled(const std::string& lines) {
  code::CompiledCode code;
  code.listing = code::parse_listing("veritrack listing 1\nfile 0 pll.c\nsample r0 f32 y\n" + lines);
  code.replaced = code.listing;
  return code;
}

/// w += 0.001 y in line 2, v += 0.001 y in line 3.
const std::string kTwoIntegrators =
    "state r1 f32:0x1p+10 w\n"
    "state r2 f32:0x1p+10 v\n"
    "r3 = fmul.f32 r0 f32:0x1.0624dep-10 @0:1:1\n"
    "r4 = fadd.f32 r1 r3 @0:2:1\n"
    "r5 = fadd.f32 r2 r3 @0:3:1\n"
    "next r1 r4\n"
    "next r2 r5\n"
    "frequency r1\n";

model::code::StepRanges ranges() {
  return {{Interval::from_bounds(1000.0, 1020.0), Interval::from_bounds(1000.0, 1020.0)},
          Interval::from_bounds(-2.0, 2.0),
          {}};
}

}  // namespace

TEST_CASE("most of the rounding is where a small number is added to a large one") {
  const rigor::UpwardRounding upward;
  const auto first = line_of_most_rounding(compiled(kTwoIntegrators), ranges(), {1.0, 0.1});
  REQUIRE(first.has_value());
  CHECK(first->place.line == 2);
  CHECK(first->integrator == 0);
  CHECK(first->all == doctest::Approx(1.1 * 1020.0 * 0x1p-24).epsilon(1e-3));
  CHECK(first->left == doctest::Approx(0.1 * 1020.0 * 0x1p-24).epsilon(1e-3));
  const auto second = line_of_most_rounding(compiled(kTwoIntegrators), ranges(), {0.1, 1.0});
  REQUIRE(second.has_value());
  CHECK(second->place.line == 3);
  CHECK(second->integrator == 1);
}

TEST_CASE("where no line makes half of the rounding there is none") {
  const rigor::UpwardRounding upward;
  CHECK_FALSE(line_of_most_rounding(compiled(kTwoIntegrators), ranges(), {1.0, 1.0}).has_value());
}

TEST_CASE("a line that makes most of it need be no integrator") {
  const rigor::UpwardRounding upward;
  const std::string lines =
      "state r1 f32:0x1p+10 w\n"
      "state r2 f32:0x1p+10 v\n"
      "r3 = fmul.f32 r1 r1 @0:1:1\n"
      "r4 = fmul.f32 r3 f32:0x1p-20 @0:2:1\n"
      "next r1 r4\n"
      "next r2 r2\n"
      "frequency r2\n";
  const auto most = line_of_most_rounding(compiled(lines), ranges(), {1.0, 0.0});
  REQUIRE(most.has_value());  // what is stored there is rounded most, if only as a start
  CHECK(most->place.line == 2);
  CHECK_FALSE(most->integrator.has_value());
}

}  // namespace veritrack::certificates

#include "analysis/single_channel/diagonal_start.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;

TEST_CASE("the level of a start is that of the corner of its box in the smallest covariance") {
  const rigor::UpwardRounding upward;
  const DiagonalStart start{"0.04", "0.01", "0.5", "2"};
  const Interval amplitude(2.0);
  const StartVariances highest = start.times("2", amplitude);
  CHECK(rigor::contains(highest.signal, 0.02));
  CHECK(rigor::contains(highest.frequency, 0.02));
  const auto level = level_of(start, {0.003, 0.004}, amplitude);
  REQUIRE(level.has_value());
  const double expected = std::sqrt(0.003 * 0.003 / 0.005 + 0.004 * 0.004 / 0.005);
  CHECK(*level == doctest::Approx(expected).epsilon(1e-12));
  CHECK(*level >= expected * (1.0 - 1e-15));
  CHECK(level_of(start, {0.0, 0.0}, amplitude).value() == doctest::Approx(0.0));
}

TEST_CASE("what is no covariance has no level") {
  const rigor::UpwardRounding upward;
  for (const DiagonalStart& start :
       {DiagonalStart{"0", "0.01", "0.5", "2"}, DiagonalStart{"0.04", "-1", "0.5", "2"},
        DiagonalStart{"0.04", "0.01", "0", "2"}}) {
    CHECK_FALSE(level_of(start, {0.003, 0.004}, Interval(1.0)).has_value());
  }
}

TEST_CASE("a start is proposed also where the errors are zero") {
  const rigor::UpwardRounding upward;
  const WindowRequest request{{0.005, 0.005, 0.01, 0.0}, 1.4, 1.5, 0.0};
  const auto claims = propose_windows(request);
  REQUIRE(!claims.empty());
  for (const StartBox& box :
       {StartBox{0.0, 0.0}, StartBox{0.001, 0.0}, StartBox{0.0, 0.001}, StartBox{0.001, 0.001}}) {
    const DiagonalStart start =
        diagonal_start(propose_start(request, claims.front(), shape_of(box)), box, 1.1, 1.0);
    const auto level = level_of(start, box, Interval(1.0));
    REQUIRE(level.has_value());
    CHECK(std::isfinite(*level));
    CHECK(certainly_positive(start.times(start.to, Interval(1.0)).signal));
  }
}

}  // namespace
}  // namespace veritrack::single_channel

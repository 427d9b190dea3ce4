// Directions and lengths of vectors, against the largest values on fine grids.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

/// The last remainder of a frame, at bounds of the relative deviations of a vector.
double last_remainder(const Frame& frame, double along, double across) {
  std::vector<double> bounds(frame.forms().size(), 0.0);
  bounds.end()[-2] = along;
  bounds.end()[-1] = across;
  return frame.inputs().back().at_bounds(bounds);
}

}  // namespace

TEST_CASE("the remainder of an arc tangent of two values is what is reached, and none is known at the cut") {
  const rigor::UpwardRounding upward;
  const auto remainder_of = [](const auto& formula, double along, double across) {
    Frame frame(Interval(1.25), Interval::from_bounds(0.2, 0.2000001), 1);
    const FrameValue w = frame.state(0, false, 0, 0.0, 2.0);
    (void)frame.line_of(formula(w, frame.constant(0, Interval(0.3)), frame.constant(1, Interval(0.7))));
    REQUIRE(frame.inputs().back().what == "atan2");
    return last_remainder(frame, along, across);
  };
  const auto forward = [](const auto& w, const auto& k, const auto& l) { return atan2(w - w + w * k, l); };
  const auto backward = [](const auto& w, const auto& k, const auto& /*l*/) { return atan2(w, -k); };
  for (const auto& [along, across] : {std::pair(0.3, 0.1), {0.3, 0.9}, {0.0, 2.0}, {0.7, 0.2}, {0.9, 5.0}}) {
    double reached = 0.0;
    for (int i = -200; i <= 200; ++i) {
      for (int j = 0; j <= 200; ++j) {
        const double v = across * j / 200.0;
        reached = std::max(reached, std::fabs(std::atan2(v, 1.0 + along * i / 200.0) - v));
      }
    }
    CHECK(remainder_of(forward, along, across) >= reached);
    CHECK(remainder_of(forward, along, across) <= 1.001 * reached);
  }
  CHECK(std::isinf(remainder_of(forward, 1.0, 0.1)));
  CHECK(std::isinf(remainder_of(forward, NAN, 0.1)));
  CHECK(std::isinf(remainder_of(forward, 0.1, NAN)));
  // The steady direction is 0.93 rad from the cut.
  CHECK(std::isfinite(remainder_of(backward, 0.3, 0.92)));
  CHECK(std::isinf(remainder_of(backward, 0.3, 0.94)));
}

TEST_CASE("the remainder of a length is what is reached, and a vector that may be turned back has none") {
  const rigor::UpwardRounding upward;
  constexpr double kX = 1.1, kY = 0.3;
  Frame frame(Interval(1.0), Interval(0.25), 2);
  const auto line = [&](int state, double constant) {
    return frame.line_of(frame.state(state, false, 0, constant, 0.0));
  };
  const FrameLine length = FrameRules::length_line(frame, line(1, kY), line(0, kX));
  const double exact = std::hypot(kX, kY);
  CHECK(length.constant.lower() <= exact);
  CHECK(length.constant.upper() >= exact);
  CHECK(rigor::midpoint(length.states.at(0)) == doctest::Approx(kX / exact));
  CHECK(rigor::midpoint(length.states.at(1)) == doctest::Approx(kY / exact));
  for (const auto& [along, across] : {std::pair(0.3, 0.1), {0.3, 0.9}, {0.0, 2.0}, {0.9, 0.2}}) {
    double reached = 0.0;
    for (int i = -200; i <= 200; ++i) {
      const double u = along * i / 200.0;
      reached = std::max(reached, exact * std::fabs(std::hypot(1.0 + u, across) - (1.0 + u)));
    }
    CHECK(last_remainder(frame, along, across) >= reached * (1.0 - 1e-12));
    CHECK(last_remainder(frame, along, across) <= 1.001 * reached);
  }
  CHECK_FALSE(last_remainder(frame, NAN, 0.1) < INFINITY);
  CHECK_FALSE(last_remainder(frame, 0.1, NAN) < INFINITY);
  CHECK_THROWS_AS((void)FrameRules::length_line(frame, line(1, kY), line(0, -kX)), NoFrame);
  CHECK_THROWS_AS((void)FrameRules::length_line(frame, line(1, 0.0), line(0, 0.0)), NoFrame);
}

}  // namespace veritrack::model

#include "analysis/single_channel/first_order_error.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using namespace veritrack;

TEST_CASE("the error to first order is that of the same filter as a recursion") {
  // designs of tracker = "model" print 0.001 rad/sample for this one, on the curve of its nine states.
  const trackers::ToneModel<double> design{0.005, 0.005, 0.01, 0.0};
  double worst = 0.0;
  for (const double frequency : {1.42, 1.46, 1.5, 1.54, 1.58}) {
    worst = std::fmax(worst, single_channel::first_order_error(design, frequency, 0.001, 0.0));
  }
  CHECK(worst == doctest::Approx(0.000999).epsilon(0.01));
}

TEST_CASE("it is linear in noise and slew, and both add up") {
  const trackers::ToneModel<double> design{0.005, 0.005, 0.01, 0.0};
  const auto error = [&](double noise, double slew) {
    return single_channel::first_order_error(design, 0.9, noise, slew);
  };
  CHECK(error(0.0, 0.0) == 0.0);
  CHECK(error(0.002, 0.0) == doctest::Approx(2.0 * error(0.001, 0.0)));
  CHECK(error(0.0, 1e-5) > 1e-5);
  CHECK(error(0.001, 1e-5) <= error(0.001, 0.0) + error(0.0, 1e-5) + 1e-15);
  CHECK(error(0.001, 1e-5) > error(0.001, 0.0));
}

}  // namespace

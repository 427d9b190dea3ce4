// What a bounded disturbance does to a combination of filters, against the integral of its kernel.
#include "checker/kkl_observer/moves.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using namespace veritrack::checker;

KklDesign design_with(double bound) {
  KklDesign design;
  for (const double rate : {1.0, 2.0, 3.0, 4.0}) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = Ball(2.0);
  design.frequency_high = Ball(4.0);
  design.amplitude_low = design.amplitude_high = one;
  design.bound = Ball(bound);
  return design;
}

}  // namespace

TEST_CASE("a kernel that changes its sign is integrated on both sides") {
  const Moves moves(design_with(1.0), one);
  for (const double c : {0.5, 1.25, 1.5, 3.0, 6.0}) {
    CAPTURE(c);
    for (const double sign : {1.0, -1.0}) {
      // exp(-t) - c exp(-2 t) is zero at log(c), if that is positive.
      const double at = std::fmax(0.0, std::log(c));
      const auto primitive = [&](double t) { return -std::exp(-t) + 0.5 * c * std::exp(-2.0 * t); };
      const double exact = std::fabs(primitive(at) - primitive(0.0)) + std::fabs(primitive(at));
      const double found = moves.size(Filters{Ball(sign), Ball(-sign * c), zero, zero}).driven.near();
      CHECK(found >= exact * (1.0 - 1e-12));
      CHECK(found <= exact * (1.0 + 1e-2));
    }
  }
}

TEST_CASE("without a disturbance nothing is driven") {
  CHECK(Moves(design_with(0.0), one).size(Filters{one, one, one, one}).driven.near() == 0.0);
}

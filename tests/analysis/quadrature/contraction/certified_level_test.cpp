#include "analysis/quadrature/contraction/certified_level.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// Under noise of 1 the level tends to 2 / sqrt(1 - 1/4).
CertifiedSet halving_set() {
  CertifiedSet set;
  set.metric = rigor::Matrix<3>::Identity();
  set.radius = 100.0;
  set.rate = 0.5;
  set.noise_gain = 2.0;
  return set;
}

TEST_CASE("a level falls by the recursion, and has settled within twice what noise leaves, not before") {
  const rigor::UpwardRounding upward;
  const double ultimate = 2.0 / std::sqrt(0.75);
  CertifiedLevel level(halving_set(), Interval(64.0), Interval(1.0), Interval(0.0));
  CHECK(level.ultimate_frequency_error() == doctest::Approx(ultimate));
  double expected = 64.0;
  while (expected > 2.0 * ultimate) {
    CHECK_FALSE(level.settled(2.0 * ultimate));
    CHECK(level.frequency_error() == doctest::Approx(expected));
    level.step();
    expected = std::sqrt(0.25 * expected * expected + 4.0);
  }
  CHECK(level.settled(2.0 * ultimate));
}

TEST_CASE("no level has settled below what it tends to, whatever it is now") {
  const rigor::UpwardRounding upward;
  const CertifiedLevel at_zero(halving_set(), Interval(0.0), Interval(1.0), Interval(0.0));
  CHECK_FALSE(at_zero.settled(0.999 * at_zero.ultimate_frequency_error()));
  CHECK(at_zero.settled(1.001 * at_zero.ultimate_frequency_error()));
}

TEST_CASE("one level is above another only when it certainly is") {
  const rigor::UpwardRounding upward;
  const auto at = [](const Interval& level) {
    return CertifiedLevel(halving_set(), level, Interval(1.0), Interval(0.0));
  };
  CHECK(at(Interval(3.0)).above(at(Interval(2.0))));
  CHECK_FALSE(at(Interval(2.0)).above(at(Interval(3.0))));
  CHECK_FALSE(at(Interval::from_bounds(1.0, 3.0)).above(at(Interval(2.0))));
}

}  // namespace
}  // namespace veritrack::quadrature

#include "analysis/sets/state_difference.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Rounded;

Rounded known(double value, double error) {
  return {Interval(value), error};
}

TEST_CASE("from factors to the matrix: errors of M, u and d in its blocks") {
  const rigor::UpwardRounding upward;
  const trackers::ToneEstimate<Rounded> state{known(1.0, 3e-3),
                                              known(2.0, 4e-3),
                                              known(0.5, 5e-3),
                                              {known(2.0, 2e-3), known(0.1, 1e-3), known(1.0, 1e-3),
                                               known(0.6, 3e-4), known(-0.8, 4e-4), known(0.5, 1e-2)}};
  const auto found = sets::difference_of(state);
  const double u = 1.0 + 5e-4;
  CHECK(found.z == doctest::Approx(5e-3));
  CHECK(found.frequency == doctest::Approx(5e-3));
  CHECK(found.p_33 == doctest::Approx(1e-2));
  CHECK(found.p_z3 == doctest::Approx(1e-2 * u + 0.5 * 5e-4));
  CHECK(found.p_zz == doctest::Approx(std::sqrt(7e-6) + 1e-2 * u * u + 0.5 * 5e-4 * (1.0 + u)));
}

TEST_CASE("the larger of two, and what is no number") {
  const sets::StateDifference a{1.0, 5.0, 2.0, 7.0, 3.0};
  const sets::StateDifference b{2.0, 4.0, 3.0, 6.0, 4.0};
  const auto both = sets::larger(a, b);
  CHECK(both.z == 2.0);
  CHECK(both.frequency == 5.0);
  CHECK(both.p_zz == 3.0);
  CHECK(both.p_z3 == 7.0);
  CHECK(both.p_33 == 4.0);
  CHECK(sets::is_finite(a));
  for (double sets::StateDifference::*member :
       {&sets::StateDifference::z, &sets::StateDifference::frequency, &sets::StateDifference::p_zz,
        &sets::StateDifference::p_z3, &sets::StateDifference::p_33}) {
    sets::StateDifference odd = a;
    odd.*member = std::numeric_limits<double>::infinity();
    CHECK_FALSE(sets::is_finite(odd));
  }
  CHECK(sets::upper_or_infinite(Interval(2.0)) == 2.0);
  CHECK(std::isinf(sets::upper_or_infinite(Interval::empty())));
  CHECK(std::isinf(sets::upper_or_infinite(Interval::entire())));
}

}  // namespace

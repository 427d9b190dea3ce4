#include "analysis/search/branch_and_bound.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace veritrack::search {
namespace {

using rigor::Interval;

TEST_CASE("an interior minimum: the root of a derivative") {
  // x^4 - 3 x has its minimum at (3/4)^(1/3).
  const auto function = [](const auto& x) {
    using Number = typename std::decay_t<decltype(x)>::Scalar;
    return square(Number(square(x(0)))) - x(0) * Interval(3.0);
  };
  rigor::IntervalVector<1> box;
  box << Interval::from_bounds(-5.0, 7.0);
  const auto minimum = minimize_globally<1>(function, box);
  const double at = std::cbrt(0.75);
  CHECK(minimum.converged);
  CHECK(rigor::contains(minimum.where(0), at));
  CHECK(minimum.where(0).upper() - minimum.where(0).lower() < 1e-3);
  CHECK(minimum.lower <= at * at * at * at - 3.0 * at + 1e-12);
  CHECK(minimum.upper >= at * at * at * at - 3.0 * at - 1e-12);
  CHECK(minimum.cells < 500);
}

TEST_CASE("no sample lies below the bound, in three variables and in parallel, whatever the batch") {
  test::Random random(11);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    CAPTURE(trial);
    const Eigen::Vector3d a(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    const auto function = [&](const auto& x) {
      return sin_cos(x(0)).first * x(1) * Interval(a(0)) + square(x(2)) * Interval(a(1)) +
             sin_cos(x(1)).second * x(2) * Interval(a(2));
    };
    const auto value = [&](const Eigen::Vector3d& x) {
      return std::sin(x(0)) * x(1) * a(0) + x(2) * x(2) * a(1) + std::cos(x(1)) * x(2) * a(2);
    };
    rigor::IntervalVector<3> box;
    box << Interval::from_bounds(-2.0, 3.0), Interval::from_bounds(-1.0, 2.0),
        Interval::from_bounds(-2.0, 2.0);
    for (const int batch : {1, 64}) {
      BranchAndBoundSettings<3> settings;
      settings.absolute_tolerance = 1e-3;
      settings.batch = batch;
      const auto minimum = minimize_globally<3>(function, box, settings);
      CHECK(minimum.converged);
      CHECK(minimum.upper - minimum.lower <= 1e-3);
      CHECK(minimum.upper == doctest::Approx(value(minimum.best)));
      for (int sample = 0; sample < 500; ++sample) {
        const Eigen::Vector3d x(random.uniform(-2.0, 3.0), random.uniform(-1.0, 2.0),
                                random.uniform(-2.0, 2.0));
        CHECK(value(x) >= minimum.lower - 1e-12);
      }
    }
  }
}

TEST_CASE("a function that is undefined somewhere has no bound, and a box that is not finite neither") {
  const auto reciprocal = [](const auto& x) {
    using Number = typename std::decay_t<decltype(x)>::Scalar;
    return Number(1.0) / x(0);
  };
  rigor::IntervalVector<1> box;
  box << Interval::from_bounds(-1.0, 1.5);
  BranchAndBoundSettings<1> settings;
  settings.cells = 500;
  const auto minimum = minimize_globally<1>(reciprocal, box, settings);
  CHECK_FALSE(minimum.converged);
  CHECK(minimum.lower == -std::numeric_limits<double>::infinity());
  CHECK(rigor::is_empty(minimum.value()));
  box << Interval::entire();
  CHECK(rigor::is_empty(minimize_globally<1>(reciprocal, box, settings).value()));
}

TEST_CASE("whatever the budget, the bound holds") {
  const auto function = [](const auto& x) { return square(x(0)) - x(0) * x(1); };
  rigor::IntervalVector<2> box;
  box << Interval::from_bounds(-1.0, 2.0), Interval::from_bounds(-3.0, 4.0);
  for (const std::int64_t cells : {1, 3, 10, 100, 10000}) {
    BranchAndBoundSettings<2> settings;
    settings.cells = cells;
    const auto minimum = minimize_globally<2>(function, box, settings);
    CHECK(minimum.lower <= -4.0);  // at (2, 4)
    CHECK(minimum.upper >= -4.0);
  }
}

TEST_CASE("the minimum of lower ends covers what the function hides") {
  const auto function = [](const auto& x) { return square(x(0)) + rigor::symmetric(0.25); };
  rigor::IntervalVector<1> box;
  box << Interval::from_bounds(-1.0, 2.0);
  BranchAndBoundSettings<1> settings;
  settings.of_lower_ends = true;
  settings.absolute_tolerance = 1e-6;
  const auto minimum = minimize_globally<1>(function, box, settings);
  CHECK(minimum.converged);
  CHECK(minimum.lower <= -0.25);
  CHECK(minimum.lower > -0.2501);
}

}  // namespace
}  // namespace veritrack::search

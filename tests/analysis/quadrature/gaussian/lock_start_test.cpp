#include "analysis/quadrature/gaussian/lock_start.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using Matrix = Eigen::Matrix3d;

Matrix whole_block(const LevelCovariance<double>& p) {
  Matrix m;
  m << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return m;
}

LockStarts starts_of(const LockSet& set, double amplitude, double phase, double frequency, double from,
                     double to) {
  return {Interval(amplitude),
          Interval(phase),
          Interval(frequency),
          {rigor::to_interval(whole_block(set.centre)), Interval::from_bounds(from, to), false}};
}

/// The level of one start, by eigenvalues.
double level_of(const LockSet& set, double amplitude, double phase, double frequency,
                const Matrix& covariance) {
  Matrix turn = Matrix::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(phase);
  turn(1, 0) = std::sin(phase);
  turn(0, 1) = -turn(1, 0);
  const Matrix p = turn * covariance * turn.transpose();
  const auto largest = [](const Matrix& x, const Matrix& y) { return oracle::relative_eigenvalues(x, y)[2]; };
  const double s =
      std::max({0.0, largest(p - whole_block(set.centre), whole_block(set.spread_above)),
                largest(p.inverse() - whole_block(set.centre).inverse(), whole_block(set.spread_below))});
  const double u1 = set.metric.amplitude * ((1.0 + amplitude) * std::cos(phase) - 1.0);
  const double u2 = set.metric.phase * (1.0 + amplitude) * std::sin(phase) + set.metric.coupling * frequency;
  const double u3 = set.metric.frequency * frequency;
  return 0.5 * (u1 * u1 + u2 * u2 + u3 * u3 + set.weight * s * s);
}

}  // namespace

TEST_CASE("no start has a higher level than the bound, and some nearly have it") {
  test::Random random(4360);
  const LockSet set = test_sets::lock_set(0, 20.0);
  struct Case {
    double amplitude, phase, frequency, from, to, share;
  };
  for (const Case& c : {Case{0.01, 0.02, 0.01, 1.0, 1.0, 0.9}, Case{0.1, 0.2, 0.05, 0.7, 1.5, 0.7},
                        Case{0.0, 0.3, 0.0, 0.999, 1.001, 0.9}, Case{0.2, 0.0, 0.1, 0.9, 1.1, 0.9}}) {
    Interval bound;
    {
      const rigor::UpwardRounding upward;
      bound = start_level(set, starts_of(set, c.amplitude, c.phase, c.frequency, c.from, c.to));
    }
    REQUIRE(rigor::is_finite(bound));
    double most = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const auto end = [&](double x) { return x * (random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0); };
      const bool at_ends = k % 2 == 0;
      const auto pick = [&](double x) { return at_ends ? end(x) : random.uniform(-x, x); };
      const double multiple = k % 4 < 2 ? c.from : c.to;
      most = std::max(most, level_of(set, pick(c.amplitude), pick(c.phase), pick(c.frequency),
                                     multiple * whole_block(set.centre)));
    }
    MESSAGE("bound " << bound.upper() << ", sampled " << most);
    CHECK(most <= bound.upper());
    CHECK(most >= c.share * bound.upper() - 1e-6);
  }
}

TEST_CASE("starts that may lie outside the set have no level") {
  const rigor::UpwardRounding upward;
  const LockSet set = test_sets::lock_set(0, 20.0);
  CHECK(rigor::is_empty(start_level(set, starts_of(set, 0.01, 0.02, 0.5, 1.0, 1.0))));
  CHECK(rigor::is_empty(start_level(set, starts_of(set, 0.01, 3.0, 0.01, 1.0, 1.0))));
  CHECK(rigor::is_empty(start_level(set, starts_of(set, 0.9, 0.02, 0.01, 1.0, 1.0))));
  CHECK(rigor::is_empty(start_level(set, starts_of(set, 0.01, 0.02, 0.01, 1e-6, 1.0))));
  CHECK(rigor::is_empty(start_level(set, starts_of(set, 0.01, 0.02, 0.01, 1.0, 1e3))));
  LockStarts none = starts_of(set, 0.01, 0.02, 0.01, 1.0, 1.0);
  none.phase_error = Interval();
  CHECK(rigor::is_empty(start_level(set, none)));
  none = starts_of(set, 0.01, 0.02, 0.01, 1.0, 1.0);
  none.frequency_error = Interval();
  CHECK(rigor::is_empty(start_level(set, none)));
}

}  // namespace veritrack::quadrature

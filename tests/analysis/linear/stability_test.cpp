#include "analysis/linear/stability.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::linear {
namespace {

using rigor::Interval;
using rigor::Verdict;

TEST_CASE("the characteristic polynomial of a companion matrix is the one it was made from") {
  const rigor::UpwardRounding upward;
  // z^3 - 2 z^2 + 0.5 z - 0.25
  const std::vector<Row> companion{{Interval(2.0), Interval(-0.5), Interval(0.25)},
                                   {Interval(1.0), Interval(0.0), Interval(0.0)},
                                   {Interval(0.0), Interval(1.0), Interval(0.0)}};
  const std::vector<Interval> p = characteristic_polynomial(companion);
  const std::vector<double> expected{-0.25, 0.5, -2.0, 1.0};
  REQUIRE(p.size() == expected.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    CHECK(p[i].lower() <= expected[i]);
    CHECK(p[i].upper() >= expected[i]);
    CHECK(rigor::width(p[i]) < 1e-13);
  }
}

TEST_CASE("random matrices: eigenvalues by Eigen") {
  test::Random random(37003);
  for (std::int64_t trial = 0; trial < test::effort(200); ++trial) {
    const auto n = static_cast<Eigen::Index>(1 + random.below(5));
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        matrix(i, j) = random.uniform(-1.0, 1.0);
      }
    }
    const double largest = oracle::spectral_radius(matrix);
    const rigor::UpwardRounding upward;
    std::vector<Row> a;
    for (Eigen::Index i = 0; i < n; ++i) {
      a.emplace_back();
      for (Eigen::Index j = 0; j < n; ++j) {
        a.back().emplace_back(matrix(i, j));
      }
    }
    CHECK(are_within(a, 1.01 * largest) == Verdict::proved);
    CHECK(are_within(a, 0.99 * largest) == Verdict::refuted);
    const auto bounds = spectral_radius_bounds(a);
    REQUIRE(bounds.has_value());
    CHECK(bounds->lower < largest * (1.0 + 1e-12));
    CHECK(bounds->upper > largest * (1.0 - 1e-12));
    CHECK(bounds->upper - bounds->lower < 1e-2 * largest);
  }
}

TEST_CASE("of intervals that reach the circle nothing is decided") {
  const rigor::UpwardRounding upward;
  CHECK(are_within({{Interval::from_bounds(0.9, 1.1)}}, 1.0) == Verdict::undecided);
  CHECK(are_within({{Interval(1.0)}}, 1.0) == Verdict::undecided);
  CHECK(are_within({{Interval::empty()}}, 1.0) == Verdict::undecided);
  CHECK(are_within({{Interval::entire()}}, 1.0) == Verdict::undecided);
  // A double eigenvalue, and one that is 0.
  const std::vector<Row> jordan{{Interval(0.75), Interval(1.0)}, {Interval(0.0), Interval(0.75)}};
  const auto bounds = spectral_radius_bounds(jordan);
  REQUIRE(bounds.has_value());
  CHECK(bounds->upper < 0.7501);
  CHECK(are_within({{Interval(0.0)}}, 0.5) == Verdict::proved);
}

TEST_CASE("bounds for a cruder program are looser, and stay on their side of 1") {
  const rigor::UpwardRounding upward;
  const RadiusBounds decay = with_room(RadiusBounds{0.98 - 1e-10, 0.98 + 1e-10});
  CHECK(decay.lower == 0.98 - 1e-10);
  CHECK(decay.upper > 0.98 + 9e-7);
  CHECK(decay.upper < 0.98 + 2e-6);
  const RadiusBounds slow = with_room(RadiusBounds{1.0 - 1.1e-5, 1.0 - 1e-5});
  CHECK(slow.upper > 1.0 - 1e-5);
  CHECK(slow.upper < 1.0);
  const RadiusBounds growth = with_room(RadiusBounds{1.02, 1.02 + 1e-7});
  CHECK(growth.lower < 1.02 - 9e-7);
  CHECK(growth.lower > 1.02 - 2e-6);
  CHECK(growth.upper == 1.02 + 1e-7);
  CHECK(with_room(RadiusBounds{0.9, 1.1}).lower == 0.9);
  CHECK(with_room(RadiusBounds{0.9, 1.1}).upper == 1.1);

  const std::vector<Row> rows{{Interval(2.0), Interval::from_bounds(1.0, 1.0 + 0x1p-20)}};
  const std::vector<Row> wider = with_room(rows);
  CHECK(rigor::width(wider[0][0]) == 0.0);
  CHECK(wider[0][1].lower() < 1.0 - 0x1p-16);
  CHECK(wider[0][1].upper() > 1.0 + 0x1p-16);
}

}  // namespace
}  // namespace veritrack::linear

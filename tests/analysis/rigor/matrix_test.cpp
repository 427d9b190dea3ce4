#include "analysis/rigor/matrix.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/matrices.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

TEST_CASE("products of interval matrices hold the products of their members, at every size and storage") {
  Random random(100);
  for (std::int64_t round = 0; round < effort(200); ++round) {
    const auto size = [&] { return static_cast<Eigen::Index>(1 + random.below(20)); };
    const Eigen::Index rows = size();
    const Eigen::Index inner = size();
    const Eigen::Index columns = size();
    const Eigen::MatrixXd a = random_integers(random, rows, inner, 99);
    const Eigen::MatrixXd b = random_integers(random, inner, columns, 99);
    const DynamicIntervalMatrix box_a = box_around(random, a, 0.5);
    const DynamicIntervalMatrix box_b = box_around(random, b, 0.5);
    Eigen::Matrix<long long, Eigen::Dynamic, Eigen::Dynamic> exact(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (Eigen::Index j = 0; j < columns; ++j) {
        exact(i, j) = 0;
        for (Eigen::Index k = 0; k < inner; ++k) {
          exact(i, j) += static_cast<long long>(a(i, k)) * static_cast<long long>(b(k, j));
        }
      }
    }
    const UpwardRounding upward;
    const DynamicIntervalMatrix points = to_interval(a) * to_interval(b);
    const DynamicIntervalMatrix product = box_a * box_b;
    const DynamicIntervalMatrix transposed = (box_b.transpose() * box_a.transpose()).transpose();
    CHECK(contains(points, exact.cast<double>()));
    CHECK(is_subset(points, to_interval(exact.cast<double>())));  // exact data, exact result
    CHECK(contains(product, exact.cast<double>()));
    CHECK(contains(transposed, exact.cast<double>()));
  }
}

TEST_CASE("a poisoned entry poisons its row of a product, and nothing else") {
  Random random(101);
  const UpwardRounding upward;
  for (const Eigen::Index size : {2, 3, 9, 17}) {
    for (const Interval& poison : {Interval::empty(), Interval::entire()}) {
      DynamicIntervalMatrix a = to_interval(random_integers(random, size, size, 9));
      const DynamicIntervalMatrix b = DynamicIntervalMatrix::Constant(size, size, Interval(3.0));
      a(1, 0) = poison;
      CHECK_FALSE(is_finite(a));
      const DynamicIntervalMatrix product = a * b;
      for (Eigen::Index j = 0; j < size; ++j) {
        CHECK_FALSE(is_finite(product(1, j)));
        CHECK(is_finite(product(0, j)));
      }
    }
  }
}

TEST_CASE("entrywise set operations and predicates") {
  const UpwardRounding upward;
  IntervalMatrix<2> a;
  a << Interval::from_bounds(0, 2), Interval::from_bounds(-1, 1), Interval::from_bounds(0, 4), Interval(5.0);
  const IntervalMatrix<2> symmetric = intersection(a, a.transpose());
  CHECK(identical(symmetric(0, 1), Interval::from_bounds(0, 1)));
  CHECK(identical(symmetric(1, 0), Interval::from_bounds(0, 1)));
  CHECK(identical(hull(a, a.transpose())(0, 1), Interval::from_bounds(-1, 4)));
  CHECK(is_subset(symmetric, a));
  CHECK_FALSE(is_interior(symmetric, a));
  CHECK_FALSE(is_subset(a, symmetric));
  IntervalMatrix<2> wider = a;
  for (Eigen::Index i = 0; i < 4; ++i) {
    wider(i) += veritrack::rigor::symmetric(0.25);
  }
  CHECK(is_interior(a, wider));
  Matrix<2> inside;
  inside << 1, 1, 4, 5;
  CHECK(contains(a, inside));
  inside(1, 1) = 5.000001;
  CHECK_FALSE(contains(a, inside));
  inside(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(contains(a, inside));
  CHECK_FALSE(contains(a, Eigen::MatrixXd::Zero(1, 2)));  // another shape
  CHECK_FALSE(is_subset(DynamicIntervalMatrix(0, 0), DynamicIntervalMatrix(0, 0)));
  CHECK_FALSE(is_finite(DynamicIntervalMatrix(0, 0)));
  CHECK_FALSE(is_subset(IntervalMatrix<2>(), a));  // default entries are empty
}

TEST_CASE("midpoint, radius and magnitude") {
  Random random(102);
  for (std::int64_t round = 0; round < effort(200); ++round) {
    const Eigen::MatrixXd center = random_integers(random, 3, 4, 1000) / 7.0;
    const DynamicIntervalMatrix box = box_around(random, center, random.uniform());
    const DynamicMatrix middle = midpoint(box);
    CHECK(contains(box, middle));
    const UpwardRounding upward;
    const DynamicMatrix around_middle = radius_around(box, middle);
    const DynamicMatrix around_center = radius_around(box, center);
    const DynamicMatrix size = magnitude(box);
    for (Eigen::Index i = 0; i < box.size(); ++i) {
      for (const double end : {box(i).lower(), box(i).upper()}) {
        const auto exact = [](double x, double y) { return std::fabs(static_cast<long double>(x) - y); };
        CHECK(exact(end, middle(i)) <= static_cast<long double>(around_middle(i)));
        CHECK(exact(end, center(i)) <= static_cast<long double>(around_center(i)));
        CHECK(std::fabs(end) <= size(i));
      }
      CHECK(around_middle(i) <= 0.5 * width(box(i)) * (1 + 1e-12) + 1e-12);
    }
  }
}

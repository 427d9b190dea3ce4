#include "analysis/rigor/mean_value_definiteness.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

/// A matrix of two variables, definite near zero.
template <typename Scalar>
LowerTriangle<3, Scalar> matrix_at(const Scalar& x, const Scalar& y) {
  const Scalar one(1.0);
  const Scalar none(0.0);
  return {{{one + x * x, none, none}, {x * y + x, one + y, none}, {y - x, x * x * y, one - x}}};
}

double determinant_at(double x, double y) {
  const auto lower = matrix_at(x, y);
  Eigen::Matrix3d a;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      a(i, j) = lower[static_cast<std::size_t>(std::max(i, j))][static_cast<std::size_t>(std::min(i, j))];
    }
  }
  return oracle::least_eigenvalue(a) > 0.0 ? a.determinant() : -1.0;
}

struct Cell {
  LowerTriangle<3> middle;
  LowerTriangle<3, Dual<Interval, 2>> over;
  std::array<double, 2> half_widths;
};
Cell cell_at(double x, double y, double half_width) {
  const auto variable = [&](double at, std::size_t index) {
    std::array<Interval, 2> unit{Interval(0.0), Interval(0.0)};
    unit[index] = Interval(1.0);
    return Dual<Interval, 2>(Interval::from_bounds(at - half_width, at + half_width), unit);
  };
  return {matrix_at(Interval(x), Interval(y)),
          matrix_at(variable(x, 0), variable(y, 1)),
          {half_width * 1.0000001, half_width * 1.0000001}};
}

}  // namespace

TEST_CASE("the least determinant of a cell is below that of all its points, and close to it in small ones") {
  test::Random random(4370);
  const UpwardRounding upward;
  int definite = 0;
  for (int k = 0; k < 400; ++k) {
    const double half_width = k % 2 == 0 ? 0.01 : 0.1;
    const double x = random.uniform(-0.8, 0.8);
    const double y = random.uniform(-0.8, 0.8);
    const Cell cell = cell_at(x, y, half_width);
    const Interval bound = least_determinant_over<3, 2>(cell.middle, cell.over, cell.half_widths);
    std::array<double, 2> influence{};
    CHECK(is_finite(bound) ==
          certainly_definite_over<3, 2>(cell.middle, cell.over, cell.half_widths, influence));
    double least = 1e9;
    for (int l = 0; l < 100; ++l) {
      least = std::min(least, determinant_at(x + random.uniform(-half_width, half_width),
                                             y + random.uniform(-half_width, half_width)));
    }
    least = std::min({least, determinant_at(x - half_width, y - half_width),
                      determinant_at(x - half_width, y + half_width),
                      determinant_at(x + half_width, y - half_width),
                      determinant_at(x + half_width, y + half_width)});
    if (!is_finite(bound)) {
      CHECK(is_empty(bound));
      // It is hardly more than what is definite that is missed.
      CHECK(least < 25.0 * half_width);
      continue;
    }
    ++definite;
    CHECK(bound.lower() <= least);
    CHECK(bound.lower() > 0.0);
    if (half_width < 0.05) {
      CHECK(bound.lower() >= least - 0.02);
    }
  }
  CHECK(definite > 100);
}

TEST_CASE("a cell in which one point is not definite has no least determinant") {
  const UpwardRounding upward;
  std::array<double, 2> influence{};
  for (const double half_width : {0.05, 0.2}) {
    const Cell cell = cell_at(1.0 - 0.5 * half_width, 0.0, half_width);
    CHECK(is_empty(least_determinant_over<3, 2>(cell.middle, cell.over, cell.half_widths)));
    CHECK_FALSE(certainly_definite_over<3, 2>(cell.middle, cell.over, cell.half_widths, influence));
  }
}

TEST_CASE("rows that their diagonal dominates for all ways make definite matrices, and only those count") {
  test::Random random(4371);
  const UpwardRounding upward;
  int dominant = 0;
  for (int k = 0; k < 2000; ++k) {
    LowerTriangle<3> sum;
    std::array<LowerTriangle<3>, 2> ways;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        sum[i][j] = Interval(i == j ? 1.0 : random.uniform(-0.3, 0.3)) + symmetric(0.02);
        for (LowerTriangle<3>& way : ways) {
          way[i][j] = Interval(random.uniform(-0.15, 0.15));
        }
      }
    }
    if (!detail::certainly_dominant<3>(sum, ways)) {
      continue;
    }
    ++dominant;
    for (int corner = 0; corner < 4; ++corner) {
      LowerTriangle<3> there = sum;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          there[i][j] += (corner % 2 == 0 ? ways[0][i][j] : -ways[0][i][j]);
          there[i][j] += (corner / 2 == 0 ? ways[1][i][j] : -ways[1][i][j]);
        }
      }
      CHECK(certainly_positive_definite<3>(there));
    }
    // An entry of which nothing is known.
    sum[static_cast<std::size_t>(k) % 3][0] = k % 2 == 0 ? Interval::empty() : Interval::entire();
    CHECK_FALSE(detail::certainly_dominant<3>(sum, ways));
  }
  CHECK(dominant > 100);
  CHECK(dominant < 1900);
}

}  // namespace veritrack::rigor

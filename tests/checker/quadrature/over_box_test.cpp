#include "checker/quadrature/over_box.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using namespace veritrack::checker;

TEST_CASE("matrices of chords lie between the corners, less the rest and plus the rest") {
  test::Random random(5350);
  for (std::int64_t k = 0; k < test::effort(200); ++k) {
    ChordMatrix<3> value;
    ChordMatrix<3> slope;
    std::array<Ball, kSides> half_widths;
    for (Ball& h : half_widths) {
      h = Ball(random.uniform(0.0, 1.0));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        for (ChordMatrix<3>* m : {&value, &slope}) {
          (*m)[i][j].centre = Ball(random.uniform(-1.0, 1.0));
          for (Ball& by : (*m)[i][j].by) {
            by = Ball(random.uniform(-1.0, 1.0)) + Ball::within(Ball(random.uniform(0.0, 0.5)));
          }
        }
      }
    }
    const double away = random.uniform(-1.0, 1.0);
    OverBox<3> less = over_box<3>(value, slope, Ball(away), half_widths);
    OverBox<3> more = less;
    const std::array<double, 3> weights{random.uniform(0.1, 2.0), random.uniform(0.1, 2.0),
                                        random.uniform(0.1, 2.0)};
    take_rest(less, weights);
    give_rest(more, weights);
    // At a corner, with chords anywhere in their balls.
    const auto corner = static_cast<std::size_t>(random.below(8));
    Eigen::Matrix3d there;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = value[i][j].centre.near() + away * slope[i][j].centre.near();
        for (std::size_t side = 0; side < kSides; ++side) {
          const double way =
              ((corner >> side) & 1U) != 0U ? half_widths[side].near() : -half_widths[side].near();
          const auto somewhere = [&](const Ball& by) {
            return by.near() + random.uniform(-1.0, 1.0) * by.radius().near();
          };
          sum += way * (somewhere(value[i][j].by[side]) + away * somewhere(slope[i][j].by[side]));
        }
        there(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = sum;
      }
    }
    const SquareMatrix<3> low = at_corner(less, corner);
    const SquareMatrix<3> high = at_corner(more, corner);
    Eigen::Matrix3d above;
    Eigen::Matrix3d below;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const auto row = static_cast<Eigen::Index>(i);
        const auto column = static_cast<Eigen::Index>(j);
        above(row, column) = high[i][j].near() - there(row, column);
        below(row, column) = there(row, column) - low[i][j].near();
      }
    }
    // The lower triangle is what counts.
    CHECK(oracle::least_eigenvalue(above) >= -1e-14);
    CHECK(oracle::least_eigenvalue(below) >= -1e-14);
  }
}

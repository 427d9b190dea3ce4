#include "analysis/dft_block/lock_matrices.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

rigor::IntervalMatrix<3> widened(const rigor::Matrix<3>& middle, double width) {
  rigor::IntervalMatrix<3> result = rigor::to_interval(middle);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result(i, j) += rigor::symmetric(width);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("an inverse holds those of all symmetric matrices, and there is none where one may be singular") {
  const rigor::UpwardRounding upward;
  test::Random random(4407);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    rigor::Matrix<3> half;
    for (double& each : half.reshaped()) {
      each = random.uniform(-1.0, 1.0);
    }
    const rigor::Matrix<3> middle = half + half.transpose();
    const double smallest = 1.0 / middle.inverse().norm();
    const double width = 0.1 * smallest;
    const auto inverse = dft_block::inverse_of(widened(middle, width));
    REQUIRE(inverse);
    rigor::Matrix<3> moved = middle;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        moved(i, j) = moved(j, i) = middle(i, j) + width * random.uniform(-1.0, 1.0);
      }
    }
    const rigor::Matrix<3> one = moved.inverse();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double room = 1e-9 * one.norm();
        CHECK((*inverse)(i, j).lower() <= one(i, j) + room);
        CHECK(one(i, j) - room <= (*inverse)(i, j).upper());
      }
    }
    // So wide that it holds 0.
    CHECK_FALSE(dft_block::inverse_of(widened(middle, middle.norm())));
  }
}

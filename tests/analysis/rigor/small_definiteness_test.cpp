#include "analysis/rigor/small_definiteness.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

using Symmetric4 = Eigen::Matrix4d;

LowerTriangle<4> around(const Symmetric4& a, double radius) {
  LowerTriangle<4> result;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j <= i; ++j) {
      result[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          Interval(a(i, j)) + symmetric(radius);
    }
  }
  return result;
}

/// With eigenvalues from `least` to 1.
Symmetric4 random_matrix(test::Random& random, double least) {
  Symmetric4 m;
  for (int i = 0; i < 16; ++i) {
    m(i / 4, i % 4) = random.uniform(-1.0, 1.0);
  }
  const Symmetric4 q = oracle::orthogonal_factor(m);
  const Eigen::Vector4d values(least, random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), 1.0);
  return q * values.asDiagonal() * q.transpose();
}

TEST_CASE("matrices whose least eigenvalue is positive are definite, others are not") {
  test::Random random(31);
  for (std::int64_t k = 0; k < test::effort(500); ++k) {
    CAPTURE(k);
    const double least = random.uniform(0.01, 0.1);
    const Symmetric4 positive = random_matrix(random, least);
    const Symmetric4 negative = random_matrix(random, -least);
    const UpwardRounding upward;
    CHECK(certainly_positive_definite<4>(around(positive, 0.0)));
    CHECK_FALSE(certainly_positive_definite<4>(around(negative, 0.0)));
    CHECK_FALSE(certainly_positive_definite<4>(around(negative, 1e-3)));
    // Boxes with a matrix in them that is not definite.
    CHECK_FALSE(certainly_positive_definite<4>(around(positive, 1.1 * least)));
  }
}

TEST_CASE("every pivot decides, the first and the last") {
  const UpwardRounding upward;
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    LowerTriangle<4> a = around(Symmetric4::Identity(), 0.0);
    CHECK(certainly_positive_definite<4>(a));
    for (const Interval& odd : {Interval(0.0), Interval(-1.0), Interval::from_bounds(-1e-300, 1.0),
                                Interval::empty(), Interval::entire()}) {
      a[i][i] = odd;
      CHECK_FALSE(certainly_positive_definite<4>(a));
    }
  }
}

}  // namespace
}  // namespace veritrack::rigor

#include "analysis/rigor/definiteness.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/support/matrices.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

__extension__ typedef __int128 Integer;

/// Sylvester's criterion for 3 x 3 symmetric matrices of integers below 2^38 in magnitude, exactly.
bool sylvester(const Eigen::MatrixXd& m) {
  const auto at = [&](int i, int j) { return static_cast<Integer>(m(i, j)); };
  const Integer minor = at(0, 0) * at(1, 1) - at(0, 1) * at(0, 1);
  const Integer determinant = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(1, 2)) -
                              at(0, 1) * (at(0, 1) * at(2, 2) - at(1, 2) * at(0, 2)) +
                              at(0, 2) * (at(0, 1) * at(1, 2) - at(1, 1) * at(0, 2));
  return at(0, 0) > 0 && minor > 0 && determinant > 0;
}

/// Like box_around, but symmetric and with integer ends.
DynamicIntervalMatrix integer_box(Random& random, const Eigen::MatrixXd& matrix, std::uint64_t reach) {
  DynamicIntervalMatrix box(matrix.rows(), matrix.cols());
  for (Eigen::Index row = 0; row < box.rows(); ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      const double below = static_cast<double>(random.below(reach + 1));
      const double above = static_cast<double>(random.below(reach + 1));
      box(row, column) = Interval::from_bounds(matrix(row, column) - below, matrix(row, column) + above);
      box(column, row) = box(row, column);
    }
  }
  return box;
}

}  // namespace

TEST_CASE("Gram matrices of integers plus the identity are proved") {
  Random random(300);
  for (std::int64_t round = 0; round < effort(300); ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(12));
    const Eigen::MatrixXd m = random_integers(random, size, size, 20);
    const Eigen::MatrixXd a = m * m.transpose() + Eigen::MatrixXd::Identity(size, size);
    CHECK(is_positive_definite(to_interval(a)) == Verdict::proved);
    CHECK_FALSE(find_non_positive_direction(to_interval(a)));
  }
}

TEST_CASE("matrices with a negative eigenvalue are refuted, singular ones never proved") {
  Random random(301);
  for (std::int64_t round = 0; round < effort(300); ++round) {
    const auto size = static_cast<Eigen::Index>(2 + random.below(8));
    const Eigen::MatrixXd m = random_unimodular(random, size, static_cast<int>(2 * size)).matrix;
    Eigen::VectorXd signature = Eigen::VectorXd::Ones(size);
    const auto place = static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(size)));
    signature[place] = -1.0;  // Sylvester's law of inertia
    CHECK(is_positive_definite(to_interval(Eigen::MatrixXd(m * signature.asDiagonal() * m.transpose()))) ==
          Verdict::refuted);
    signature[place] = 0.0;
    const Eigen::MatrixXd singular = m * signature.asDiagonal() * m.transpose();
    CHECK(is_positive_definite(to_interval(singular)) != Verdict::proved);
    const double reach = std::ldexp(1.0, -static_cast<int>(random.below(60)));
    CHECK(is_positive_definite(symmetric_box_around(random, singular, reach)) != Verdict::proved);
  }
}

TEST_CASE("verdicts agree with Sylvester's criterion in exact integers, also within a hair of singular") {
  Random random(302);
  std::int64_t decided = 0;
  std::int64_t positive = 0;
  const std::int64_t rounds = effort(20000);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const int bound = 1 << random.below(18);
    const Eigen::MatrixXd m =
        random_integers(random, 3, static_cast<Eigen::Index>(2 + random.below(2)), bound);
    Eigen::MatrixXd a = m * m.transpose();  // often singular
    const Eigen::MatrixXd nudge = random_integers(random, 3, 3, static_cast<int>(random.below(3)));
    a += nudge + nudge.transpose();
    const bool truth = sylvester(a);
    const Verdict verdict = is_positive_definite(to_interval(a));
    positive += truth ? 1 : 0;
    decided += verdict != Verdict::undecided ? 1 : 0;
    if (verdict == Verdict::proved) {
      CHECK(truth);
    }
    if (verdict == Verdict::refuted) {
      CHECK_FALSE(truth);
    }
  }
  CHECK(decided > rounds * 8 / 10);
  CHECK(positive > rounds / 10);
  CHECK(positive < rounds * 9 / 10);
}

TEST_CASE("a verdict on a box is the verdict on its vertices") {
  Random random(303);
  std::int64_t proved = 0;
  std::int64_t refuted = 0;
  for (std::int64_t round = 0; round < effort(2000); ++round) {
    const Eigen::MatrixXd m = random_integers(random, 3, 3, 30);
    const double shift = static_cast<double>(random.below(600)) - 300.0;
    const Eigen::MatrixXd center = m * m.transpose() + shift * Eigen::MatrixXd::Identity(3, 3);
    const DynamicIntervalMatrix box = integer_box(random, center, 1 + random.below(100));
    const Verdict verdict = is_positive_definite(box);
    proved += verdict == Verdict::proved ? 1 : 0;
    refuted += verdict == Verdict::refuted ? 1 : 0;
    for (int sample = 0; verdict != Verdict::undecided && sample < 16; ++sample) {
      CHECK(sylvester(random_vertex(random, box, true)) == (verdict == Verdict::proved));
    }
  }
  CHECK(proved > effort(100));
  CHECK(refuted > effort(100));
}

TEST_CASE("nearly singular 2 x 2 matrices on both sides") {
  const auto verdict = [](double corner) {
    IntervalMatrix<2> a;
    a << Interval(1.0), Interval(1.0), Interval(1.0), Interval(corner);
    return is_positive_definite(a);
  };
  CHECK(verdict(1.0 + 0x1p-40) == Verdict::proved);
  CHECK(verdict(1.0) == Verdict::refuted);  // the witness (1, -1) gives exactly zero
  CHECK(verdict(1.0 - 0x1p-52) == Verdict::refuted);
  CHECK(verdict(1.0 - 0x1p-40) == Verdict::refuted);
}

TEST_CASE("the witness is a direction in which the form is not positive") {
  IntervalMatrix<2> a;
  a << Interval::from_bounds(1, 2), Interval::from_bounds(4, 5), Interval::from_bounds(3, 5), Interval(3.0);
  const std::optional<Vector<2>> x = find_non_positive_direction(a);
  REQUIRE(x);
  for (const double corner : {1.0, 2.0}) {
    for (const double side : {4.0, 5.0}) {
      CHECK(corner * (*x)[0] * (*x)[0] + 2.0 * side * (*x)[0] * (*x)[1] + 3.0 * (*x)[1] * (*x)[1] < 0.0);
    }
  }
  CHECK(is_positive_definite(a) == Verdict::refuted);
}

TEST_CASE("widely scaled matrices are proved") {
  IntervalMatrix<3> a = IntervalMatrix<3>::Identity();
  a(0, 0) = Interval(1e200);
  a(2, 2) = Interval(1e-200);
  CHECK(is_positive_definite(a) == Verdict::proved);
  a(0, 1) = a(1, 0) = Interval(0.9e100);
  CHECK(is_positive_definite(a) == Verdict::proved);
  a(0, 1) = a(1, 0) = Interval(1.1e100);
  CHECK(is_positive_definite(a) != Verdict::proved);
}

TEST_CASE("nothing is decided on what is not finite, not symmetric or not there") {
  for (const Interval& poison : kPoison) {
    for (const Eigen::Index place : {0, 1, 4, 8}) {
      IntervalMatrix<3> a = IntervalMatrix<3>::Identity();
      a(place) = poison;
      a.transposeInPlace();
      a(place) = poison;
      CHECK(is_positive_definite(a) == Verdict::undecided);
      CHECK_FALSE(find_non_positive_direction(a));
    }
  }
  IntervalMatrix<2> asymmetric = IntervalMatrix<2>::Identity();
  asymmetric(0, 1) = Interval(0.25);
  CHECK(is_positive_definite(asymmetric) == Verdict::undecided);
  CHECK(is_positive_definite(DynamicIntervalMatrix(0, 0)) == Verdict::undecided);
  CHECK_THROWS_AS(static_cast<void>(is_positive_definite(DynamicIntervalMatrix(2, 3))),
                  std::invalid_argument);
  CHECK_FALSE(rounding_is_upward());
}

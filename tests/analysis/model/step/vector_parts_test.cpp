#include "analysis/model/step/vector_parts.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using Eigen::MatrixXd;
using rigor::BallModel;
using rigor::Interval;

/// A place: x and v in the unit ball of two and of three components, s and z in [-1, 1].
struct Place {
  std::array<double, 2> x{};
  std::array<double, 3> v{};
  double s = 0.0, z = 0.0;
};

Place random_place(test::Random& random) {
  Place place;
  const auto into_ball = [&](auto& vector) {
    double square = 2.0;
    while (square > 1.0) {
      square = 0.0;
      for (double& entry : vector) {
        entry = random.uniform(-1.0, 1.0);
        square += entry * entry;
      }
    }
  };
  into_ball(place.x);
  into_ball(place.v);
  place.s = random.uniform(-1.0, 1.0);
  place.z = random.uniform(-1.0, 1.0);
  return place;
}

// The vector (first, second) with
//   first  = (1 + s/4) x0 + z/2 x1 + v0/4 + v2/8 + x0 x1/2,
//   second = x1/2 - z/4 x0 + v1/2 + s v2/4 + 3 v0^2/16.
std::vector<BallModel> example_vector() {
  const BallModel x0 = BallModel::ball(0), x1 = BallModel::ball(1);
  const BallModel v0 = BallModel::disturbance(0), v1 = BallModel::disturbance(1),
                  v2 = BallModel::disturbance(2);
  const BallModel s = BallModel::s(), z = BallModel::z();
  const auto times = [](double factor, const BallModel& model) { return BallModel(factor) * model; };
  return {
      x0 + times(0.25, s * x0) + times(0.5, z * x1) + times(0.25, v0) + times(0.125, v2) +
          times(0.5, x0 * x1),
      times(0.5, x1) - times(0.25, z * x0) + times(0.5, v1) + times(0.25, s * v2) + times(0.1875, v0 * v0)};
}

MatrixXd linear_in_x(double s, double z) {
  return MatrixXd{{1.0 + 0.25 * s, 0.5 * z}, {-0.25 * z, 0.5}};
}

/// The sum over exponents of s^i z^j times the matrices.
MatrixXd gram_at(const Gram& gram, double s, double z) {
  MatrixXd sum = MatrixXd::Zero(2, 2);
  for (const auto& [exponents, matrix] : gram) {
    sum += std::pow(s, exponents.first) * std::pow(z, exponents.second) * matrix.middle;
  }
  return sum;
}

TEST_CASE("the parts of a vector are those of its formula") {
  const rigor::BallModelScope scope(2, 3);
  for (const bool last_alone : {false, true}) {
    const VectorParts parts(example_vector(), last_alone);
    test::Random random(63);
    for (int trial = 0; trial < 50; ++trial) {
      const auto [x, v, s, z] = random_place(random);
      const MatrixXd of_x = linear_in_x(s, z);
      CHECK((gram_at(parts.of_x, s, z) - of_x * of_x.transpose()).norm() < 1e-14);
      const MatrixXd first_two{{0.25, 0.0}, {0.0, 0.5}};
      const MatrixXd last{{0.125}, {0.25 * s}};
      const MatrixXd square_of_last = last * last.transpose();
      const MatrixXd together = first_two * first_two.transpose() + square_of_last;
      CHECK((gram_at(parts.of_v, s, z) - (last_alone ? together - square_of_last : together)).norm() < 1e-14);
      CHECK((gram_at(parts.of_w, s, z) - (last_alone ? square_of_last : MatrixXd::Zero(2, 2))).norm() <
            1e-14);
    }
    // x0 x1/2 has the length 1/4 at most, its norm as a tensor is |(1/2) sym(e0 e1)| = 1/(2 sqrt 2).
    CHECK(parts.norms[2][0].upper() >= 0.25);
    CHECK(parts.norms[2][0].upper() <= 0.5 / std::sqrt(2.0) * (1.0 + 1e-9));
    CHECK(parts.norms[0][2].upper() >= 0.1875);
    CHECK(parts.norms[0][2].upper() <= 0.1875 * (1.0 + 1e-9));
    CHECK(parts.norms[1][1].upper() == 0.0);
    CHECK(parts.error.upper() >= 0.0);
    CHECK(parts.error.upper() < 1e-13);
    CHECK(at_middle(parts.of_x) == MatrixXd{{1.0, 0.0}, {0.0, 0.25}});
  }
}

TEST_CASE("a joint bound is above the eigenvalues at every place, for sums with weights") {
  const rigor::BallModelScope scope(2, 3);
  const VectorParts parts(example_vector(), true);
  const double joint =
      joint_bound({{&parts.of_x, Interval(2.0)}, {&parts.of_v, Interval(1.0)}, {&parts.of_w, Interval(4.0)}});
  double largest = 0.0;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      const MatrixXd of_x = linear_in_x(0.125 * i, 0.125 * j);
      const MatrixXd last{{0.125}, {0.25 * 0.125 * i}};
      const MatrixXd first_two{{0.25, 0.0}, {0.0, 0.5}};
      const MatrixXd sum =
          2.0 * of_x * of_x.transpose() + first_two * first_two.transpose() + 4.0 * last * last.transpose();
      // Of a symmetric 2 x 2 matrix.
      const double mean = 0.5 * sum.trace();
      largest = std::max(largest, mean + std::hypot(0.5 * (sum(0, 0) - sum(1, 1)), sum(0, 1)));
    }
  }
  CHECK(joint >= largest);
  CHECK(joint <= 1.5 * largest);
  CHECK(std::isnan(joint_bound({{&parts.of_x, Interval(0.0)}})));
  CHECK(std::isnan(joint_bound({{&parts.of_x, Interval::from_bounds(-1.0, 1.0)}})));
  CHECK(joint_bound({}) == 0.0);
  CHECK(at_middle({}).rows() == 0);
}

TEST_CASE("errors of the components add up as lengths do; one that is unknown makes all unknown") {
  const rigor::BallModelScope scope(2, 3);
  std::vector<BallModel> vector = example_vector();
  vector[0] = vector[0].widened(0.375);
  vector[1] = vector[1].widened(0.5);
  const VectorParts parts(vector, false);
  CHECK(parts.error.lower() <= 0.625 + 1e-12);
  CHECK(parts.error.upper() >= 0.625);
  CHECK(parts.error.upper() <= 0.625 + 1e-12);
  vector[1] = BallModel(1.0) / BallModel::s();
  CHECK(rigor::is_empty(VectorParts(vector, false).error));
}

}  // namespace
}  // namespace veritrack::model

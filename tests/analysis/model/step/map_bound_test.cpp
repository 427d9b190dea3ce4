#include "analysis/model/step/map_bound.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::BallModel;

/// A vector of two components, over the disturbances v and zeta: linear with random coefficients that depend
/// on s and z, and a little of the second degree.
struct RandomMap {
  std::array<std::array<double, 8>, 2> c{};

  RandomMap(test::Random& random, double of_v, double of_w) {
    for (auto& row : c) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = random.uniform(-1.0, 1.0);
      }
      row[2] *= of_v;
      row[3] *= of_w;
      row[4] *= 0.1;
      row[5] *= 0.05;
      row[6] *= 0.03 * of_v;
      row[7] *= 0.03 * of_w;
    }
  }
  template <typename Scalar>
  [[nodiscard]] std::vector<Scalar> at(const std::array<Scalar, 2>& x, const Scalar& v, const Scalar& w,
                                       const Scalar& s, const Scalar& z) const {
    std::vector<Scalar> result;
    for (const auto& row : c) {
      const auto k = [&row](std::size_t i) { return Scalar(row[i]); };
      result.push_back(k(0) * x[0] + k(1) * x[1] + k(2) * v + k(3) * w + k(4) * s * x[0] +
                       k(5) * x[0] * x[1] + k(6) * z * v + k(7) * w * x[1]);
    }
    return result;
  }
  [[nodiscard]] std::vector<BallModel> model(int disturbances) const {
    const BallModel none(0.0);
    return at<BallModel>({BallModel::ball(0), BallModel::ball(1)},
                         disturbances > 0 ? BallModel::disturbance(0) : none,
                         disturbances > 1 ? BallModel::disturbance(1) : none, BallModel::s(), BallModel::z());
  }
};

/// The largest length at random places of the boundary, |v| and |w| at most `most`.
double sampled(const RandomMap& map, double scale, double most_of_v, double most_of_w) {
  test::Random random(8);
  double worst = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double angle = random.uniform(0.0, 2.0 * M_PI);
    const auto sign = [&random] { return random.below(2) == 0 ? 1.0 : -1.0; };
    const std::vector<double> value =
        map.at<double>({scale * std::cos(angle), scale * std::sin(angle)}, most_of_v * sign(),
                       most_of_w * sign(), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    worst = std::max(worst, std::hypot(value[0], value[1]));
  }
  return worst;
}

TEST_CASE("bounds of a step with two disturbances, together in a ball or one of them alone") {
  test::Random random(17);
  for (int trial = 0; trial < 20; ++trial) {
    const RandomMap map(random, std::pow(10.0, random.uniform(-4.0, 0.0)),
                        std::pow(10.0, random.uniform(-4.0, 0.0)));
    const rigor::BallModelScope scope(2, 2);
    const std::vector<BallModel> vector = map.model(2);
    for (const double scale : {1.0, 0.25}) {
      const double half = std::sqrt(0.5);
      const double alone = length_bounds(vector, {scale}, true).front();
      const double together = length_bounds(vector, {scale}, false).front();
      const double of_alone = sampled(map, scale, half, half);
      CHECK(alone >= of_alone);
      CHECK(together >= of_alone);  // both at their limits are in the ball, too
      CHECK(alone < 1.3 * of_alone + 0.2);
    }
  }
}

TEST_CASE("a last disturbance that does nothing, or is the only one that does") {
  test::Random random(19);
  const RandomMap map(random, 0.3, 0.0);
  const RandomMap other(random, 0.0, 0.3);
  const rigor::BallModelScope scope(2, 2);
  const double half = std::sqrt(0.5);
  CHECK(length_bounds(map.model(2), {1.0}, true).front() >= sampled(map, 1.0, half, half));
  CHECK(length_bounds(map.model(2), {1.0}, true).front() <=
        length_bounds(map.model(2), {1.0}, false).front());
  CHECK(length_bounds(other.model(2), {1.0}, true).front() >= sampled(other, 1.0, half, half));
  CHECK(length_bounds(other.model(2), {1.0}, true).front() <=
        length_bounds(other.model(2), {1.0}, false).front());
}

TEST_CASE("where nothing is known there is no bound") {
  const rigor::BallModelScope scope(2, 2);
  test::Random random(23);
  const RandomMap map(random, 0.1, 0.1);
  std::vector<BallModel> vector = map.model(2);
  vector[1] = vector[1].widened(std::numeric_limits<double>::quiet_NaN());
  CHECK_FALSE(std::isfinite(length_bounds(vector, {1.0}, true).front()));
  vector = map.model(2);
  vector[0] = BallModel(std::numeric_limits<double>::quiet_NaN()) * BallModel::disturbance(1);
  CHECK_FALSE(std::isfinite(length_bounds(vector, {1.0}, true).front()));
}

}  // namespace
}  // namespace veritrack::model

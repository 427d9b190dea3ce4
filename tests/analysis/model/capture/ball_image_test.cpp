#include "analysis/model/capture/ball_image.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

/// Entries a + b s + c x, s and x in [-1, 1].
struct RandomEntries {
  std::size_t rows, columns;
  std::vector<std::array<double, 3>> terms;

  RandomEntries(std::size_t row_count, std::size_t column_count, double variation, test::Random& random)
      : rows(row_count), columns(column_count) {
    terms.resize(rows * columns);
    for (auto& term : terms) {
      term = {random.uniform(-1.0, 1.0), variation * random.uniform(-1.0, 1.0),
              variation * random.uniform(-1.0, 1.0)};
    }
  }
  [[nodiscard]] SlopeMatrix models() const {
    SlopeMatrix matrix(rows, columns);
    const auto s = SlopeModel::variable(rigor::Interval::from_bounds(-1.0, 1.0), 0);
    const auto x = SlopeModel::variable(rigor::Interval::from_bounds(-1.0, 1.0), 1);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        const auto& term = terms[i * columns + j];
        matrix(i, j) = SlopeModel(term[0]) + SlopeModel(term[1]) * s + SlopeModel(term[2]) * x;
      }
    }
    return matrix;
  }
  [[nodiscard]] Eigen::MatrixXd at(double s, double x) const {
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
        const auto& term = terms[static_cast<std::size_t>(i) * columns + static_cast<std::size_t>(j)];
        matrix(i, j) = term[0] + term[1] * s + term[2] * x;
      }
    }
    return matrix;
  }
};

Eigen::VectorXd random_direction(Eigen::Index size, test::Random& random) {
  Eigen::VectorXd direction(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    direction[i] = random.uniform(-1.0, 1.0);
  }
  return direction.normalized();
}

TEST_CASE("no ball and no noise reach further than the bound, and the bound is not far off") {
  test::Random random(2100);
  double least_ratio = 1e9;
  for (std::int64_t round = 0; round < test::effort(300); ++round) {
    const std::size_t states = 1 + random.below(4);
    const std::size_t channels = 1 + random.below(2);
    const RandomEntries a(states, states, 0.01, random);
    const RandomEntries b(states, channels, 0.01, random);
    const double radius = std::pow(10.0, random.uniform(-8.0, 2.0));
    const double noise = round % 3 == 0 ? 0.0 : radius * std::pow(10.0, random.uniform(-2.0, 2.0));
    double bound = 0.0;
    {
      const rigor::UpwardRounding upward;
      bound = ball_image(a.models(), radius, b.models(), noise);
    }
    REQUIRE(std::isfinite(bound));
    double most = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double s = k < 4 ? 2.0 * (k % 2) - 1.0 : random.uniform(-1.0, 1.0);
      const double x = k < 4 ? 2.0 * (k / 2) - 1.0 : random.uniform(-1.0, 1.0);
      const Eigen::VectorXd image =
          radius * a.at(s, x) * random_direction(static_cast<Eigen::Index>(states), random) +
          noise * b.at(s, x) * random_direction(static_cast<Eigen::Index>(channels), random);
      most = std::max(most, image.norm());
    }
    CHECK(most <= bound);
    // The least that it could be: the norms of both.
    const double norm_of_a = oracle::singular_values(a.at(0.0, 0.0))[0] * radius;
    const double norm_of_b = oracle::singular_values(b.at(0.0, 0.0))[0] * noise;
    CHECK(bound <= 1.1 * (norm_of_a + norm_of_b) + 0.2 * (radius + noise));
    least_ratio = std::min(least_ratio, bound / (norm_of_a + norm_of_b));
  }
  CHECK(least_ratio < 1.1);
}

TEST_CASE("sizes that do not fit, and what is not known") {
  CHECK_THROWS_AS((void)SlopeMatrix(5, 1), std::invalid_argument);
  CHECK_THROWS_AS((void)(SlopeMatrix(2, 3) * SlopeMatrix(2, 2)), std::invalid_argument);
  const rigor::UpwardRounding upward;
  SlopeMatrix one(2, 2);
  one(0, 0) = one(1, 1) = SlopeModel(1.0);
  const SlopeMatrix none(2, 1);
  CHECK(ball_image(one, 0.0, none, 0.0) == 0.0);
  CHECK(ball_image(one, 1.0, none, 0.0) >= 1.0);
  CHECK(ball_image(one, 1.0, none, 0.0) < 1.0 + 1e-6);
  CHECK(std::isnan(ball_image(one, NAN, none, 0.0)));
  CHECK(std::isnan(ball_image(one, -1.0, none, 0.0)));
  CHECK(std::isnan(ball_image(one, INFINITY, none, 0.0)));
  one(0, 1) = SlopeModel();
  CHECK(std::isnan(ball_image(one, 1.0, none, 0.0)));
}

}  // namespace
}  // namespace veritrack::model

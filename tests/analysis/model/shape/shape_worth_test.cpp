// The worth of shapes: shape_worth.cpp, declared in shape_proposal.hpp.
#include <doctest/doctest.h>

#include <cmath>

#include "analysis/model/shape/shape_proposal.hpp"
#include "tests/analysis/model/shape/shape_examples.hpp"

namespace veritrack::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Two states that turn and shrink a little, with noise on the first one and a curve that moves.
CurveDynamics turning_dynamics() {
  const MatrixXd a{{0.8, -0.3}, {0.3, 0.7}};
  const MatrixXd b{{0.5}, {0.25}};
  CurveDynamics dynamics = test::constant_dynamics(a, b, {2, MatrixXd::Zero(3, 3)});
  dynamics.slew.row(0).setConstant(0.5);
  dynamics.slew.row(1).setConstant(-1.0);
  return dynamics;
}

ShapeParameters plain_parameters() {
  ShapeParameters parameters;
  parameters.lambda = 0.9;
  parameters.weights = {2.0, 0.5};
  parameters.source = MatrixXd{{0.5, 0.125}, {0.125, 0.25}};
  return parameters;
}

/// b B B' + c D D' + W, by its entries.
MatrixXd expected_source() {
  return MatrixXd{{2.0 * 0.25 + 0.5 * 0.25 + 0.5, 2.0 * 0.125 - 0.5 * 0.5 + 0.125},
                  {2.0 * 0.125 - 0.5 * 0.5 + 0.125, 2.0 * 0.0625 + 0.5 * 1.0 + 0.25}};
}

TEST_CASE("the source of the equation adds noise, slew and W") {
  const CurveDynamics dynamics = turning_dynamics();
  ShapeParameters parameters = plain_parameters();
  const MatrixXd source = lyapunov_source(dynamics, parameters);
  REQUIRE(source.cols() == 5);
  for (Index j = 0; j < source.cols(); ++j) {
    CHECK((source.col(j).reshaped(2, 2) - expected_source()).norm() < 1e-15);
  }
  parameters.weights.slew = 0.0;
  CHECK(std::fabs(lyapunov_source(dynamics, parameters)(3, 0) - (0.125 + 0.25)) < 1e-15);
}

TEST_CASE("the shape's square is the sum of what all earlier samples leave") {
  const CurveDynamics dynamics = turning_dynamics();
  const auto factors = cholesky_factors(dynamics, plain_parameters());
  REQUIRE(factors.has_value());
  // Pi = sum over k of (A/sqrt(lambda))^k S (A/sqrt(lambda))'^k, term by term.
  using Wide = Eigen::Matrix<long double, 2, 2>;
  const Wide a = dynamics.step.front().state.cast<long double>() / std::sqrt(0.9L);
  Wide term = expected_source().cast<long double>();
  Wide sum = Wide::Zero();
  for (int k = 0; k < 3000; ++k) {
    sum += term;
    term = a * term * a.transpose();
  }
  for (Index j = 0; j < factors->cols(); ++j) {
    const MatrixXd u = factors->col(j).reshaped(2, 2);
    CHECK(u(0, 1) == 0.0);
    CHECK(u(0, 0) > 0.0);
    CHECK((u * u.transpose() - sum.cast<double>()).norm() < 1e-10 * static_cast<double>(sum.norm()));
  }
  // Nothing depends on the phase: the shape is the same here and one sample later, with any harmonics.
  for (const int harmonics : {0, 2}) {
    const auto shape = shape_on_grid(dynamics, plain_parameters(), harmonics);
    REQUIRE(shape.has_value());
    CHECK((shape->here - *factors).norm() < 1e-12 * factors->norm());
    CHECK((shape->next - *factors).norm() < 1e-12 * factors->norm());
  }
}

TEST_CASE("a source that is not positive makes no shape") {
  ShapeParameters parameters = plain_parameters();
  parameters.source = -10.0 * MatrixXd::Identity(2, 2);
  CHECK_FALSE(cholesky_factors(turning_dynamics(), parameters).has_value());
  CHECK_FALSE(shape_on_grid(turning_dynamics(), parameters, 0).has_value());
}

TEST_CASE("a diagonal entry that is tiny for its row is not well conditioned") {
  ShapeOnGrid shape{MatrixXd::Zero(4, 2), MatrixXd::Zero(4, 2)};
  shape.here.col(0) << 1.0, 0.5, 0.0, 1.0;
  shape.here.col(1) << 1.0, 100.0, 0.0, 0.011;
  CHECK(is_well_conditioned(shape));
  shape.here(3, 1) = 0.009;
  CHECK_FALSE(is_well_conditioned(shape));
}

/// x' = a x + b v + bend x^2/2 in units of u: everything is known in closed form.
struct Scalar {
  double a = 0.75, b = 0.5, bend = 0.25, drift = 0.125, u = 2.0;

  /// `deviation`: of starts; 0 for none.
  [[nodiscard]] std::optional<ShapeWorth> worth(ShapeObjective objective, const DisturbanceWeights& weights,
                                                double deviation = 0.0) const {
    ShapeSettings settings;
    settings.objective = objective;
    if (deviation > 0.0) {
      settings.start.setConstant(1, deviation);
    }
    const CurveDynamics dynamics = test::scalar_dynamics(a, b, bend, drift);
    const ShapeOnGrid shape{MatrixXd::Constant(1, 5, u), MatrixXd::Constant(1, 5, u)};
    return worth_of(dynamics, shape, weights, settings);
  }
};

TEST_CASE("for starts: up to where the step no longer shrinks, as a multiple of the deviation") {
  const Scalar scalar;
  const auto worth = scalar.worth(ShapeObjective::largest_starts, {}, 0.5);
  REQUIRE(worth.has_value());
  // a + bend R u/2 = 1.
  const double level = 2.0 * (1.0 - scalar.a) / (scalar.bend * scalar.u);
  CHECK(worth->rate == doctest::Approx(scalar.a));
  CHECK(worth->level == doctest::Approx(level));
  CHECK(worth->reach == doctest::Approx(level * scalar.u));
  CHECK(worth->least_reach == doctest::Approx(level * scalar.u));
  CHECK(worth->start_share == doctest::Approx(level * scalar.u / 0.5));
  CHECK(worth->score == doctest::Approx(std::log(worth->start_share)));
}

TEST_CASE("of several deviations, the signs count that are worst") {
  ShapeSettings settings;
  settings.start = Eigen::Vector2d(0.25, 0.5);
  ShapeOnGrid shape{MatrixXd::Zero(4, 5), MatrixXd::Zero(4, 5)};
  shape.here.colwise() = Eigen::Vector4d(1.0, -0.5, 0.0, 1.0);
  shape.next = shape.here;
  CurveDynamics halving = test::constant_dynamics(0.5 * MatrixXd::Identity(2, 2), MatrixXd::Ones(2, 1),
                                                  {2, MatrixXd::Zero(3, 3)});
  halving.hessian.assign(5, 1e-3 * MatrixXd::Identity(2, 2));  // otherwise every level would do
  const auto worth = worth_of(halving, shape, {}, settings);
  REQUIRE(worth.has_value());
  // U^-1 (d1, d2) = (d1, d2 + d1/2): the longest of (0.25, 0.625) and (0.25, 0.375).
  CHECK(worth->start_share == doctest::Approx(worth->level / std::hypot(0.25, 0.625)));
}

TEST_CASE("for noise, slew and the long run: the closed forms of one state") {
  const Scalar s;
  constexpr double kMargin = 0.99;  // of the weights
  const double weight = 1.5;
  const auto rate_for = [&](double source) {
    return s.a / std::sqrt(1.0 - kMargin * weight * source / (s.u * s.u));
  };
  // sqrt((rate R)^2 + V^2/weight) = R - bend u R^2/2: the largest V over R.
  const auto largest = [&](double rate) {
    double best = 0.0;
    for (double level = 1e-4; level < 2.0; level += 1e-4) {
      const double left = level - 0.5 * s.bend * s.u * level * level;
      best = std::max(best, kMargin * weight * (left * left - rate * rate * level * level));
    }
    return std::sqrt(best);
  };
  const auto noise = s.worth(ShapeObjective::largest_noise, {weight, 0.0});
  REQUIRE(noise.has_value());
  CHECK(noise->noise == doctest::Approx(largest(rate_for(s.b * s.b))).epsilon(1e-3));
  CHECK(noise->score == doctest::Approx(std::log(noise->noise)));
  const auto slew = s.worth(ShapeObjective::largest_slew, {0.0, weight});
  REQUIRE(slew.has_value());
  CHECK(slew->slew == doctest::Approx(largest(rate_for(s.drift * s.drift))).epsilon(1e-3));
  const auto long_run = s.worth(ShapeObjective::least_long_run_error, {weight, 0.0});
  REQUIRE(long_run.has_value());
  const double rate = rate_for(s.b * s.b);
  CHECK(long_run->level == doctest::Approx(std::sqrt(1.0 / (kMargin * weight) / (1.0 - rate * rate))));
  CHECK(long_run->reach == doctest::Approx(long_run->level * s.u));
  CHECK(long_run->score == doctest::Approx(-std::log(long_run->reach)));
  const auto deviation = s.worth(ShapeObjective::largest_deviation, {weight, 0.0});
  REQUIRE(deviation.has_value());
  CHECK(deviation->noise == doctest::Approx(deviation->level * std::sqrt(kMargin * weight / 56.0)));
  // Errors that grow are worth nothing.
  Scalar growing = s;
  growing.a = 1.01;
  CHECK_FALSE(growing.worth(ShapeObjective::largest_starts, {}).has_value());
}

}  // namespace
}  // namespace veritrack::model

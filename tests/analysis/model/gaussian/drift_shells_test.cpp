#include "analysis/model/gaussian/drift_shells.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::BallModel;

/// F(x, u) = R (a x + bend x^2 + b u + mixed x u + square u^2) for |x| <= 1 and |u| <= 1, u = v/V.
struct ScalarStep {
  double a = 0.0, bend = 0.0, b = 0.0, mixed = 0.0, square = 0.0;

  /// Needs a scope of one ball and one disturbance.
  [[nodiscard]] VectorParts parts(double radius) const {
    const BallModel x = BallModel::ball(0);
    const BallModel u = BallModel::disturbance(0);
    const auto times = [&](double factor, const BallModel& model) {
      return BallModel(radius * factor) * model;
    };
    return {{times(a, x) + times(bend, x * x) + times(b, u) + times(mixed, x * u) + times(square, u * u)},
            false};
  }
  [[nodiscard]] long double at(long double x, long double u) const {
    return a * x + bend * x * x + b * u + mixed * x * u + square * u * u;
  }
};

/// The largest E[exp(L F^2/R^2); |v| <= V] - kappa exp(L x^2) over |x| <= 1, by Simpson's rule in long
/// double.
long double largest_excess(const ScalarStep& step, const DriftQuestion& question) {
  const long double share = static_cast<long double>(question.deviation) / question.most_noise;  // of u
  constexpr int kPlaces = 60;
  constexpr int kParts = 400;
  long double worst = -INFINITY;
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    const long double x = static_cast<long double>(i) / kPlaces;
    long double mean = 0.0L;
    for (int k = 0; k <= kParts; ++k) {
      const long double u = 2.0L * k / kParts - 1.0L;
      const long double weight = k == 0 || k == kParts ? 1.0L : k % 2 == 1 ? 4.0L : 2.0L;
      const long double next = step.at(x, u);
      mean += weight * std::exp(-0.5L * u * u / (share * share) + question.exponent * next * next);
    }
    mean *= 2.0L / kParts / 3.0L / (share * std::sqrt(2.0L * 3.14159265358979323846L));
    worst = std::max(worst, mean - question.factor * std::exp(question.exponent * x * x));
  }
  return worst;
}

DriftQuestion question_with(double constant) {
  DriftQuestion question;
  question.radius = 0.25;
  question.deviation = 0.125;
  question.most_noise = 0.75;  // six deviations
  question.exponent = 4.0;
  question.factor = 1.0;
  question.constant = constant;
  return question;
}

TEST_CASE("of a linear step, little more is needed than the Gaussian integral, and never less") {
  const rigor::BallModelScope scope(1, 1);
  ScalarStep step;
  step.a = 0.8;
  // In deviations: s = 0.15, of R.
  step.b = 0.9;
  const double s = step.b / 6.0;
  // E exp(L (a x + s g)^2) = exp(L a^2 x^2/(1 - 2 L s^2))/sqrt(1 - 2 L s^2).
  const double left = 1.0 - 2.0 * 4.0 * s * s;
  double least = 0.0;
  for (double x = 0.0; x <= 1.0; x += 1e-3) {
    least = std::max(
        least, std::exp(4.0 * step.a * step.a * x * x / left) / std::sqrt(left) - std::exp(4.0 * x * x));
  }
  CHECK(static_cast<double>(largest_excess(step, question_with(0.0))) ==
        doctest::Approx(least).epsilon(1e-6));
  CHECK_FALSE(drift_holds(step.parts(0.25), question_with(0.99 * least), 1));
  CHECK(drift_holds(step.parts(0.25), question_with(1.6 * least), 1));
}

TEST_CASE("no drift is said to hold that an integral over the noise exceeds") {
  const rigor::BallModelScope scope(1, 1);
  test::Random random(68);
  int holding = 0;
  int exceeded = 0;
  for (int trial = 0; trial < 60; ++trial) {
    ScalarStep step;
    step.a = random.uniform(0.5, 0.95);
    step.b = random.uniform(0.1, 0.9);
    step.bend = random.uniform(-0.05, 0.05);
    step.mixed = random.uniform(-0.1, 0.1);
    step.square = random.uniform(-0.05, 0.05);
    DriftQuestion question = question_with(random.uniform(0.0, 0.6));
    question.factor = random.uniform(0.95, 1.0);
    const bool holds = drift_holds(step.parts(question.radius), question, 1);
    const bool exceeds = largest_excess(step, question) > static_cast<long double>(question.constant);
    CHECK_FALSE((holds && exceeds));
    holding += holds ? 1 : 0;
    exceeded += exceeds ? 1 : 0;
  }
  CHECK(holding > 5);
  CHECK(exceeded > 5);
}

TEST_CASE("more room needs more, and where the step is unknown nothing holds") {
  const rigor::BallModelScope scope(1, 1);
  ScalarStep step;
  step.a = 0.8;
  step.b = 0.5;
  step.bend = 0.05;
  DriftQuestion question = question_with(0.2);
  REQUIRE(drift_holds(step.parts(0.25), question, 1));
  question.room = 100.0;
  CHECK_FALSE(drift_holds(step.parts(0.25), question, 1));
  question.room = 1.0;
  const VectorParts unknown({BallModel(1.0) / BallModel::ball(0)}, false);
  CHECK_FALSE(drift_holds(unknown, question, 1));
  question.deviation = INFINITY;
  CHECK_FALSE(drift_holds(step.parts(0.25), question, 1));
}

}  // namespace
}  // namespace veritrack::model

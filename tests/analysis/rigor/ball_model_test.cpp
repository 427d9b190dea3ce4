#include "analysis/rigor/ball_model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/rigor/taylor_coefficients.hpp"
#include "tests/analysis/rigor/ball_points.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::BallModel;
using rigor::BallModelScope;
using rigor::Interval;
using test::BallPoint;
using test::effort;
using test::polynomial_at;
using test::random_point;

namespace {

/// A value and the model that should contain it.
struct Pair {
  BallModel model;
  long double value;
};

/// Random formulas, computed in both ways.
Pair random_pair(test::Random& random, const BallPoint& point, int depth) {
  const auto part = [&] { return random_pair(random, point, depth - 1); };
  const auto small = [&](const Pair& pair) -> Pair {
    // About a constant, so that functions are defined.
    const BallModel model =
        BallModel(0.4) + BallModel(0.05) * (pair.model - BallModel(pair.model.constant()));
    const long double value = 0.4L + 0.05L * (pair.value - static_cast<long double>(pair.model.constant()));
    return {model, value};
  };
  switch (depth <= 0 ? random.below(5) : 5 + random.below(14)) {
    case 0:
      if (!point.x.empty()) {
        const auto i = random.below(point.x.size());
        return {BallModel::ball(static_cast<int>(i)), point.x[i]};
      }
      return {BallModel::z(), point.z};
    case 1:
      if (!point.v.empty()) {
        const auto i = random.below(point.v.size());
        return {BallModel::disturbance(static_cast<int>(i)), point.v[i]};
      }
      return {BallModel::s(), point.s};
    case 2:
      return {BallModel::s(), point.s};
    case 3:
      return {BallModel::z(), point.z};
    case 4: {
      const double constant = random.uniform(-2.0, 2.0);
      return {BallModel(constant), constant};
    }
    case 5:
    case 6: {
      const Pair a = part();
      const Pair b = part();
      return {a.model + b.model, a.value + b.value};
    }
    case 7: {
      const Pair a = part();
      const Pair b = part();
      return {a.model - b.model, a.value - b.value};
    }
    case 8:
    case 9: {
      const Pair a = part();
      const Pair b = part();
      return {a.model * b.model, a.value * b.value};
    }
    case 10: {
      const Pair a = part();
      const Pair b = small(part());
      return {a.model / b.model, a.value / b.value};
    }
    case 11: {
      const Pair a = small(part());
      return {sqrt(a.model), std::sqrt(a.value)};
    }
    case 12: {
      const Pair a = small(part());
      return {exp(a.model), std::exp(a.value)};
    }
    case 13: {
      const Pair a = small(part());
      return {log(a.model), std::log(a.value)};
    }
    case 14: {
      const Pair a = part();
      return {sin(a.model), std::sin(a.value)};
    }
    case 15: {
      const Pair a = part();
      return {cos(a.model), std::cos(a.value)};
    }
    case 16: {
      const Pair a = small(part());
      return {tan(a.model) + asin(a.model) * acos(a.model),
              std::tan(a.value) + std::asin(a.value) * std::acos(a.value)};
    }
    case 17: {
      const Pair a = part();
      return {atan(a.model), std::atan(a.value)};
    }
    default: {
      const Pair a = part();
      const Pair b = small(part());
      return {atan2(a.model, b.model), std::atan2(a.value, b.value)};
    }
  }
}

TEST_CASE("a ball model contains what it stands for") {
  test::Random random(61);
  int told = 0;
  for (std::int64_t round = effort(4000); round > 0; --round) {
    const int balls = static_cast<int>(random.below(5));  // 0: often the place alone
    const int disturbances = static_cast<int>(random.below(3));
    const BallModelScope scope(balls, disturbances);
    const BallPoint point = random_point(random, balls, disturbances);
    const auto fork = static_cast<std::uint64_t>(round);
    test::Random formula(1000 + fork);
    const int depth = 1 + static_cast<int>(random.below(3));
    const Pair pair = random_pair(formula, point, depth);
    if (!std::isfinite(pair.model.deviation())) {
      continue;
    }
    ++told;
    const long double distance = std::fabs(pair.value - polynomial_at(pair.model, point));
    const long double allowed = static_cast<long double>(pair.model.error()) * (1 + 1e-15L) + 1e-17L;
    CHECK(distance <= allowed);
    CHECK(contains(pair.model.range(), static_cast<double>(pair.value)));
  }
  CHECK(told > effort(4000) / 2);
}

TEST_CASE("angles of points, the cut excluded") {
  test::Random random(62);
  for (std::int64_t round = effort(300); round > 0; --round) {
    const BallModelScope scope(2, 0);
    const BallPoint point = random_point(random, 2, 0);
    const double angle = random.uniform(-3.0, 3.0);
    const double r = 0.05;
    const BallModel y = BallModel(std::sin(angle)) + BallModel(r) * BallModel::ball(0);
    const BallModel x = BallModel(std::cos(angle)) + BallModel(r) * BallModel::ball(1);
    const BallModel turned = atan2(y, x);
    REQUIRE(std::isfinite(turned.deviation()));
    const long double value =
        std::atan2(std::sin(angle) + 0.05L * point.x[0], std::cos(angle) + 0.05L * point.x[1]);
    CHECK(std::fabs(value - polynomial_at(turned, point)) <=
          static_cast<long double>(turned.error()) + 1e-15L);
    CHECK(turned.error() < 2e-5);
  }
  const BallModelScope scope(1, 0);
  const BallModel one(1.0);
  CHECK(std::isnan(atan2(BallModel(0.1) * BallModel::ball(0), -one).deviation()));
  CHECK(std::isnan(atan2(BallModel::ball(0), BallModel::s()).deviation()));
}

TEST_CASE("norms are those of Bombieri, and reached") {
  const BallModelScope scope(2, 0);
  const BallModel x = BallModel::ball(0);
  const BallModel y = BallModel::ball(1);
  const auto norm = [](const BallModel& model, int degree) {
    return model.norm(model.monomials().class_of(degree, 0, 0, 0));
  };
  CHECK(norm(BallModel(3.0) * x + BallModel(4.0) * y, 1) == doctest::Approx(5.0));
  CHECK(norm(x * y, 2) == doctest::Approx(std::sqrt(0.5)));
  CHECK(norm(x * x + y * y, 2) == doctest::Approx(std::sqrt(2.0)));
  CHECK(norm(x * x * y, 3) == doctest::Approx(std::sqrt(1.0 / 3.0)));
  // (x + y)^3 is at most sqrt(2)^3 on the ball, and its norm is just that.
  CHECK(norm((x + y) * (x + y) * (x + y), 3) == doctest::Approx(std::pow(2.0, 1.5)));
}

TEST_CASE("what is truncated is bounded, and what is kept is exact") {
  const BallModelScope scope(1, 0);
  const BallModel x = BallModel::ball(0);
  const BallModel cube = x * x * x;
  CHECK(cube.error() < 1e-14);
  CHECK((cube * x).error() == doctest::Approx(1.0));
  CHECK((cube * BallModel::s()).error() < 1e-13);
  CHECK((cube * BallModel::s() * BallModel::z()).error() == doctest::Approx(1.0));
  // Fifth order: 0.1^5/5! is what the sine leaves out; the fourth order of x alone is truncated, too.
  const BallModel angle = BallModel(0.1) * BallModel::s();
  CHECK(sin(angle).error() < 0.1 * 0.1 * 0.1 * 0.1 * 0.1 / 120.0 * 1.01);
}

TEST_CASE("nothing is known where a function is not smooth, and it stays so") {
  const BallModelScope scope(2, 1);
  const BallModel x = BallModel::ball(0);
  const BallModel one(1.0);
  const auto unknown = [](const BallModel& model) {
    return std::isnan(model.deviation()) && is_empty(model.range());
  };
  CHECK(unknown(one / x));
  CHECK(unknown(one / (x + one)));  // touches zero on the rim
  CHECK_FALSE(unknown(one / (x + BallModel(1.5))));
  CHECK(unknown(sqrt(x)));
  CHECK(unknown(log(x + one)));
  CHECK(unknown(asin(x)));
  CHECK(unknown(acos(x + x)));
  CHECK(unknown(tan(BallModel(2.0) * x)));
  CHECK(unknown(one / x + one));
  CHECK(unknown((one / x) * BallModel(0.0)));
  CHECK(unknown(sin(sqrt(x))));
  CHECK(unknown(BallModel(Interval::empty())));
  CHECK(unknown(BallModel(Interval::entire())));
  CHECK(unknown(stays_within(x, BallModel(-1.0), one)));
  CHECK(unknown(stays_within(x, BallModel(-2.0), one)));
  CHECK_FALSE(unknown(stays_within(x, BallModel(-1.1), BallModel(1.1))));
  CHECK(unknown(one.widened(-1.0)));
  CHECK(unknown(exp(BallModel(1e308) * x)));
}

TEST_CASE("Taylor coefficients of functions, by finite sums that share nothing with them") {
  const rigor::UpwardRounding upward;
  struct Case {
    const char* name;
    rigor::TaylorCoefficients (*coefficients)(const Interval&);
    long double (*function)(long double);
  };
  const std::vector<Case> cases{
      {"reciprocal", rigor::taylor_of_reciprocal, [](long double t) { return 1 / t; }},
      {"sqrt", rigor::taylor_of_sqrt, [](long double t) { return std::sqrt(t); }},
      {"exp", rigor::taylor_of_exp, [](long double t) { return std::exp(t); }},
      {"log", rigor::taylor_of_log, [](long double t) { return std::log(t); }},
      {"sin", rigor::taylor_of_sin, [](long double t) { return std::sin(t); }},
      {"cos", rigor::taylor_of_cos, [](long double t) { return std::cos(t); }},
      {"tan", rigor::taylor_of_tan, [](long double t) { return std::tan(t); }},
      {"asin", rigor::taylor_of_asin, [](long double t) { return std::asin(t); }},
      {"acos", rigor::taylor_of_acos, [](long double t) { return std::acos(t); }},
      {"atan", rigor::taylor_of_atan, [](long double t) { return std::atan(t); }},
  };
  for (const Case& each : cases) {
    for (const double t : {0.2, 0.45, 0.7}) {
      CAPTURE(each.name);
      CAPTURE(t);
      const auto coefficients = each.coefficients(Interval(t));
      const long double h = 0.01L;
      // Odd and even parts of f(t + h) agree to the order that is left out.
      long double sum = 0;
      long double power = 1;
      for (const Interval& coefficient : coefficients) {
        CHECK(coefficient.upper() - coefficient.lower() < 1e-10);
        sum += static_cast<long double>(midpoint(coefficient)) * power;
        power *= h;
      }
      const long double exact = each.function(static_cast<long double>(t) + h);
      CHECK(std::fabs(sum - exact) < 1e5L * power);
    }
  }
}

}  // namespace

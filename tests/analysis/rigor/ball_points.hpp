// Points at which ball models are evaluated, and their values there.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/rigor/ball_model.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// A point: x and v in their balls, s and z in [-1, 1].
struct BallPoint {
  std::vector<long double> x, v;
  long double s = 0, z = 0;
};

inline std::vector<long double> point_of_ball(Random& random, int dimension) {
  std::vector<long double> point(static_cast<std::size_t>(dimension));
  long double square = 0;
  for (long double& component : point) {
    component = random.uniform(-1.0, 1.0);
    square += component * component;
  }
  // Often on the rim, where norms are reached.
  const long double radius = random.below(2) == 0 ? 1.0L : static_cast<long double>(random.uniform());
  for (long double& component : point) {
    component *= square > 0 ? radius / std::sqrt(square) : 0;
  }
  return point;
}

inline BallPoint random_point(Random& random, int balls, int disturbances) {
  return {point_of_ball(random, balls), point_of_ball(random, disturbances), random.uniform(-1.0, 1.0),
          random.uniform(-1.0, 1.0)};
}

/// The polynomial at a point, monomial by monomial, in the order that the tables promise: classes by their
/// degrees, and in a class the exponents of x and v from the first variable down. Shares no code with the
/// tables.
inline long double polynomial_at(const rigor::BallModel& model, const BallPoint& point) {
  std::vector<long double> factors = point.x;
  factors.insert(factors.end(), point.v.begin(), point.v.end());
  const auto& classes = model.monomials().classes();
  long double sum = 0;
  for (const auto& here : classes) {
    // All products of here.ball components of x (with repetition) and here.disturbance of v.
    std::vector<long double> of_x{1};
    std::vector<std::vector<long double>> monomials;
    const auto list = [](const std::vector<long double>& vector, int degree) {
      std::vector<long double> values;
      const auto recurse = [&](const auto& self, std::size_t from, int left, long double value) -> void {
        if (left == 0 || from == vector.size()) {
          if (left == 0) {
            values.push_back(value);
          }
          return;
        }
        for (int power = left; power >= 0; --power) {
          self(self, from + 1, left - power, value * std::pow(vector[from], static_cast<long double>(power)));
        }
      };
      recurse(recurse, 0, degree, 1);
      return values;
    };
    std::size_t at = here.first;
    for (const long double a : list(point.x, here.ball)) {
      for (const long double b : list(point.v, here.disturbance)) {
        sum += static_cast<long double>(model.coefficients()[at++]) * a * b * std::pow(point.s, here.s) *
               std::pow(point.z, here.z);
      }
    }
    REQUIRE(at == here.last);
  }
  return sum;
}

}  // namespace veritrack::test

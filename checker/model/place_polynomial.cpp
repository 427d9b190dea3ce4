#include "checker/model/place_polynomial.hpp"

#include <cmath>

#include "checker/model/rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t place_of(int degree, int of_z) {
  return static_cast<std::size_t>(degree * (degree + 1) / 2 + of_z);
}

/// Taylor's polynomial of a function with these derivatives at the middle, where the fifth one is at most 1.
PlacePolynomial taylor(const std::array<double, BallPolynomial::kMostDegree + 1>& derivatives, double a,
                       double b, double error, double size) {
  constexpr std::array<double, 5> kFactorial{1.0, 1.0, 2.0, 6.0, 24.0};
  PlacePolynomial result;
  std::array<double, 5> powers_of_a{1.0};
  std::array<double, 5> powers_of_b{1.0};
  for (std::size_t k = 1; k < powers_of_a.size(); ++k) {
    powers_of_a[k] = powers_of_a[k - 1] * a;
    powers_of_b[k] = powers_of_b[k - 1] * b;
  }
  for (int degree = 0; degree <= BallPolynomial::kMostDegree; ++degree) {
    for (int of_z = 0; of_z <= degree; ++of_z) {
      const auto l = static_cast<std::size_t>(degree - of_z);
      const auto m = static_cast<std::size_t>(of_z);
      result.coefficients[place_of(degree, of_z)] = derivatives[static_cast<std::size_t>(degree)] *
                                                    powers_of_a[l] * powers_of_b[m] /
                                                    (kFactorial[l] * kFactorial[m]);
    }
  }
  // Ten operations for each coefficient but the first, which is multiplied by ones, and the remainder.
  const double fifth = size * size * size * size * size / 120.0;
  double others = 0.0;
  for (std::size_t k = 1; k < result.coefficients.size(); ++k) {
    others += std::abs(result.coefficients[k]);
  }
  result.error = bound_on(10.0 * kRounding * others + error + fifth);
  return result;
}

}  // namespace

double PlacePolynomial::norm() const {
  double sum = 0.0;
  for (const double coefficient : coefficients) {
    sum += std::abs(coefficient);
  }
  return bound_on(sum);
}

CosineSine::CosineSine(const Ball& constant, const Ball& by_phase, const Ball& by_frequency) {
  spend(4);
  Ball c;
  Ball s;
  arb_sin_cos(s.raw(), c.raw(), constant.raw(), precision());
  const double a = by_phase.near();
  const double b = by_frequency.near();
  const double near_c = c.near();
  const double near_s = s.near();
  const double size = bound_on(std::abs(a) + std::abs(b));
  // The slopes, in which the function is Lipschitz with constant 1; the derivatives, each with a factor of at
  // most size^k/k!, all of them together at most exp(size); and the constant itself.
  const Ball slopes = abs(by_phase - Ball(a)) + abs(by_frequency - Ball(b));
  const Ball derivatives = max(abs(c - Ball(near_c)), abs(s - Ball(near_s))) * exp(Ball(size));
  const double error = (slopes + derivatives).upper_double();
  cosine = taylor({near_c, -near_s, -near_c, near_s, near_c}, a, b, error, size);
  sine = taylor({near_s, near_c, -near_s, -near_c, near_s}, a, b, error, size);
}

std::vector<PlacePolynomial> powers_of_place(double middle, double half_width, double error,
                                             std::size_t count) {
  PlacePolynomial z;
  z.coefficients[place_of(0, 0)] = middle;
  z.coefficients[place_of(1, 1)] = half_width;
  z.error = error;
  std::vector<PlacePolynomial> powers(1);
  powers[0].coefficients[0] = 1.0;
  while (powers.size() < count) {
    powers.push_back(product_with_power(powers.back(), z));
  }
  return powers;
}

PlacePolynomial product_with_power(const PlacePolynomial& x, const PlacePolynomial& y) {
  spend();
  PlacePolynomial result;
  double cut_off = 0.0;
  for (int power = 0; power <= BallPolynomial::kMostDegree; ++power) {
    const double factor = y.coefficients[place_of(power, power)];
    if (factor == 0.0) {
      continue;
    }
    for (int degree = 0; degree <= BallPolynomial::kMostDegree; ++degree) {
      for (int of_z = 0; of_z <= degree; ++of_z) {
        const double coefficient = x.coefficients[place_of(degree, of_z)];
        if (degree + power <= BallPolynomial::kMostDegree) {
          result.coefficients[place_of(degree + power, of_z + power)] += factor * coefficient;
        } else {
          cut_off += std::abs(factor * coefficient);
        }
      }
    }
  }
  const double size_of_x = x.norm();
  const double size_of_y = y.norm();
  result.error = bound_on(x.error * size_of_y + y.error * (size_of_x + x.error) + cut_off +
                          8.0 * kRounding * size_of_x * size_of_y);
  return result;
}

BallPolynomial linear_combination(const std::vector<double>& factors,
                                  const std::vector<PlacePolynomial>& functions) {
  std::array<double, BallPolynomial::kPlaces> sum{};
  double error = 0.0;
  double size = 0.0;
  // Each term is multiplied once, and added up to as often as there are terms.
  std::size_t roundings = kRoundingsOfFactor + 4;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const double factor = factors[i];
    if (factor == 0.0) {
      continue;
    }
    double norm = 0.0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double term = factor * functions[i].coefficients[k];
      sum[k] += term;
      norm += std::abs(term);
    }
    error += std::abs(factor) * functions[i].error;
    size += norm;
    ++roundings;
  }
  spend(1 + static_cast<std::int64_t>(roundings / 8));
  return BallPolynomial::of_places(sum, bound_on(error + static_cast<double>(roundings) * kRounding * size));
}

}  // namespace veritrack::checker

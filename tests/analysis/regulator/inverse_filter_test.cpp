#include "analysis/regulator/inverse_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using regulator::InverseFilter;
using rigor::Interval;
using test::Random;

std::vector<Interval> intervals(const std::vector<double>& numbers) {
  std::vector<Interval> result;
  for (const double number : numbers) {
    result.emplace_back(number);
  }
  return result;
}

/// The polynomial with these poles: pairs r exp(+-j t).
std::vector<double> with_poles(const std::vector<std::complex<double>>& upper_poles) {
  std::vector<double> product{1.0};
  for (const auto& pole : upper_poles) {
    const std::vector<double> factor{1.0, -2.0 * pole.real(), std::norm(pole)};
    std::vector<double> next(product.size() + 2, 0.0);
    for (std::size_t i = 0; i < product.size(); ++i) {
      for (std::size_t j = 0; j < factor.size(); ++j) {
        next[i + j] += product[i] * factor[j];
      }
    }
    product = next;
  }
  return product;
}

}  // namespace

TEST_CASE("one pole: the sums are those of geometric series") {
  const rigor::UpwardRounding upward;
  for (const double pole : {0.0, 0.5, -0.75, 0.9375}) {
    CAPTURE(pole);
    const InverseFilter inverse(intervals({2.0, -2.0 * pole}));
    REQUIRE(inverse.is_stable());
    const double size = std::fabs(pole);
    CHECK(contains(inverse.norm() * Interval(2.0 * (1.0 - size)) / Interval(1.0 + 0x1p-30), 1.0));
    CHECK(inverse.norm().upper() >= 0.5 / (1.0 - size));
    CHECK(inverse.norm().upper() <= 0.5 / (1.0 - size) * (1.0 + 1e-8));
    CHECK(inverse.weighted_norm().upper() >= 0.5 / ((1.0 - size) * (1.0 - size)));
    CHECK(inverse.weighted_norm().upper() <= 0.5 / ((1.0 - size) * (1.0 - size)) * (1.0 + 1e-8));
    CHECK(inverse.peak().upper() >= 0.5);
    CHECK(inverse.peak().upper() <= 0.5 * (1.0 + 1e-8));
    CHECK(inverse.tail(3).upper() >= 0.5 * std::pow(size, 3) / (1.0 - size));
    CHECK(inverse.tail(3).upper() <= 0.5 * std::pow(size, 3) / (1.0 - size) + 1e-12);
  }
}

TEST_CASE("what is not certainly stable is not") {
  const rigor::UpwardRounding upward;
  for (const std::vector<double>& unstable : {std::vector{1.0, -1.0},
                                              {1.0, 1.0},
                                              {1.0, -1.0001},
                                              {1.0, 0.0, 1.0},
                                              {1.0, -2.0, 1.0},
                                              {0.0, 1.0},
                                              {1.0, -3.0, 2.0},
                                              {1.0, NAN}}) {
    const InverseFilter inverse(intervals(unstable));
    CHECK_FALSE(inverse.is_stable());
    CHECK(is_empty(inverse.norm()));
    CHECK(is_empty(inverse.weighted_norm()));
    CHECK(is_empty(inverse.tail(0)));
  }
  CHECK_FALSE(InverseFilter({Interval(1.0), Interval::from_bounds(-1.1, -0.2)}).is_stable());
}

TEST_CASE("random poles: never below the sums of the impulse response, and close to them") {
  const rigor::UpwardRounding upward;
  Random random(4401);
  for (int run = 0; run < 60; ++run) {
    std::vector<std::complex<double>> poles;
    const int pairs = 1 + run % 3;
    bool stable = true;
    for (int i = 0; i < pairs; ++i) {
      const double radius = random.uniform(0.0, run % 4 == 0 ? 1.3 : 0.97);
      stable = stable && radius < 1.0;
      poles.push_back(std::polar(radius, random.uniform(0.0, 3.1)));
    }
    const std::vector<double> a = with_poles(poles);
    const InverseFilter inverse(intervals(a));
    REQUIRE(inverse.is_stable() == stable);
    if (!stable) {
      continue;
    }
    std::vector<double> response;
    double norm = 0.0, weighted = 0.0, peak = 0.0, tail = 0.0;
    for (std::size_t k = 0; k < 4000; ++k) {
      double next = k == 0 ? 1.0 : 0.0;
      for (std::size_t i = 1; i < a.size() && i <= k; ++i) {
        next -= a[i] * response[k - i];
      }
      response.push_back(next);
      norm += std::fabs(next);
      weighted += static_cast<double>(k + 1) * std::fabs(next);
      peak = std::max(peak, std::fabs(next));
      tail += k >= 10 ? std::fabs(next) : 0.0;
    }
    const auto is_just_above = [](const Interval& bound, double value) {
      return bound.upper() >= value * (1.0 - 1e-9) && bound.upper() <= value * (1.0 + 1e-6) + 1e-9;
    };
    CHECK(is_just_above(inverse.norm(), norm));
    CHECK(is_just_above(inverse.weighted_norm(), weighted));
    CHECK(is_just_above(inverse.peak(), peak));
    CHECK(is_just_above(inverse.tail(10), tail));
  }
}

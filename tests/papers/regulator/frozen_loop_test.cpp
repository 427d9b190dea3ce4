#include "papers/regulator/frozen_loop.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using regulator::FrozenLoop;
using regulator::Polynomial;
using rigor::Interval;
using rigor::Verdict;

Polynomial polynomial_of(const std::vector<double>& numbers) {
  Polynomial result;
  for (const double number : numbers) {
    result.emplace_back(number);
  }
  return result;
}

/// The largest |z| at which p_0 z^n + ... + p_n vanishes, in double precision.
double largest_zero(const std::vector<double>& p) {
  const auto n = static_cast<Eigen::Index>(p.size()) - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    companion(0, i) = -p[static_cast<std::size_t>(i) + 1] / p[0];
  }
  companion.diagonal(-1).setOnes();
  return oracle::spectral_radius(companion);
}

std::complex<double> value(const std::vector<double>& p, double angle) {
  std::complex<double> sum = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    sum += p[k] * std::polar(1.0, -static_cast<double>(k) * angle);
  }
  return sum;
}

}  // namespace

TEST_CASE("zeros lie within a circle as the eigenvalues of the companion matrix say") {
  test::Random random(5'144);
  int within = 0;
  for (std::int64_t run = 0; run < test::effort(400); ++run) {
    CAPTURE(run);
    std::vector<double> p{random.uniform(0.5, 2.0)};
    const int order = 1 + static_cast<int>(run % 6);
    for (int k = 0; k < order; ++k) {
      p.push_back(random.uniform(-1.0, 1.0));
    }
    const double radius = random.uniform(0.5, 1.5);
    const double largest = largest_zero(p);
    if (std::fabs(largest - radius) < 1e-6) {
      continue;
    }
    within += largest < radius ? 1 : 0;
    const rigor::UpwardRounding upward;
    CHECK(regulator::has_zeros_within(polynomial_of(p), Interval(radius)) ==
          (largest < radius ? Verdict::proved : Verdict::refuted));
  }
  CHECK(within > test::effort(400) / 10);
  CHECK(within < 9 * test::effort(400) / 10);
}

TEST_CASE("what is not known about a polynomial is not decided") {
  const rigor::UpwardRounding upward;
  CHECK(regulator::has_zeros_within({}, Interval(1.0)) == Verdict::undecided);
  CHECK(regulator::has_zeros_within(polynomial_of({1.0, 0.5}), Interval(0.0)) == Verdict::undecided);
  CHECK(regulator::has_zeros_within({Interval::from_bounds(-1.0, 1.0), Interval(0.5)}, Interval(1.0)) ==
        Verdict::undecided);
  CHECK(regulator::has_zeros_within({Interval(1.0), Interval::from_bounds(0.5, 1.5)}, Interval(1.0)) ==
        Verdict::undecided);
  CHECK(regulator::has_zeros_within({Interval(1.0), Interval::empty()}, Interval(1.0)) == Verdict::undecided);
  CHECK(regulator::has_zeros_within({Interval(1.0), Interval(0.0), Interval::from_bounds(-0.5, 0.5)},
                                    Interval(1.0)) == Verdict::proved);
}

TEST_CASE("a loop that is known by hand: the plant 1/(z - 1/2) with gain") {
  // A1 + g k/z = 1 + (g k - 1/2)/z: stable for -1/2 < g k < 3/2, S = (1 - 1/(2z))/that.
  const FrozenLoop loop{polynomial_of({1.0, -0.5}), polynomial_of({1.0}), polynomial_of({0.25}),
                        polynomial_of({1.0})};
  const rigor::UpwardRounding upward;
  CHECK(loop.has_poles_within(Interval(0.3), Interval(1.0)) == Verdict::proved);
  CHECK(loop.has_poles_within(Interval(0.2), Interval(1.0)) == Verdict::refuted);
  CHECK(loop.is_stable_for_gains(Interval::from_bounds(-1.9, 5.9)) == Verdict::proved);
  CHECK(loop.is_stable_for_gains(Interval::from_bounds(-2.1, 5.9)) == Verdict::refuted);
  CHECK(loop.is_stable_for_gains(Interval::from_bounds(-1.9, 6.1)) == Verdict::refuted);
  CHECK(loop.is_stable_for_gains(Interval::entire()) == Verdict::undecided);
  // |S| is largest at pi: (3/2)/(5/4).
  const Interval peak = loop.peak_sensitivity();
  CHECK(peak.lower() <= 1.2);
  CHECK(peak.upper() >= 1.2);
  CHECK(width(peak) < 1e-6);
}

TEST_CASE("sensitivities of random loops are those of double precision, and none is above the peak") {
  test::Random random(5'145);
  for (std::int64_t run = 0; run < test::effort(20); ++run) {
    CAPTURE(run);
    const std::vector<double> a{1.0, random.uniform(-0.9, 0.9)};
    const std::vector<double> b{random.uniform(0.5, 2.0)};
    const std::vector<double> n{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)};
    const std::vector<double> d{1.0, random.uniform(-0.5, 0.5), random.uniform(-0.2, 0.2)};
    const FrozenLoop loop{polynomial_of(a), polynomial_of(b), polynomial_of(n), polynomial_of(d)};
    double largest = 0.0;
    std::vector<double> sizes;
    for (int i = 0; i <= 1000; ++i) {
      const double angle = std::numbers::pi * i / 1000.0;
      const std::complex<double> open = value(a, angle) * value(d, angle);
      const std::complex<double> forward = std::polar(1.0, -angle) * value(b, angle) * value(n, angle);
      sizes.push_back(std::abs(open / (open + forward)));
      largest = std::max(largest, sizes.back());
    }
    const rigor::UpwardRounding upward;
    const Interval peak = loop.peak_sensitivity();
    CHECK(peak.upper() >= largest * (1.0 - 1e-9));
    CHECK(peak.upper() <= largest * 1.01);
    const Interval middle = loop.sensitivity(Interval(std::numbers::pi * 300 / 1000.0));
    CHECK(std::fabs(midpoint(middle) - sizes[300]) < 1e-9 * sizes[300]);
  }
}

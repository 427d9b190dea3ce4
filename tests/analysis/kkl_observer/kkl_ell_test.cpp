#include "analysis/kkl_observer/kkl_ell.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "analysis/kkl_observer/kkl_excitation_ratio.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;
using rigor::Verdict;

KklRange range(const Eigen::Vector4d& lambda, double low, double high) {
  return {rigor::to_interval(lambda), Interval::from_bounds(low, high)};
}

/// The oracle: the plain ratio of (10), sampled over the phase of the signal.
double sampled_ratio(const Eigen::Vector4d& lambda, double frequency, int phases) {
  double smallest = 1e300;
  for (int k = 0; k < phases; ++k) {
    const double phase = std::numbers::pi * k / phases;
    const auto x = trackers::oscillator_state(1.0, phase, frequency);
    const Eigen::Vector4d transformed = trackers::kkl_transform<double, 4>(x, lambda);
    Eigen::Matrix<double, 4, 3> l;
    l << lambda, Eigen::Vector4d::Ones(), -transformed;
    smallest = std::min(smallest, (l.transpose() * l).determinant() / transformed.squaredNorm());
  }
  return smallest;
}

TEST_CASE("the reduced problem has the values of the original one") {
  test::Random random(1);
  for (std::int64_t trial = 0; trial < test::effort(200); ++trial) {
    CAPTURE(trial);
    Eigen::Vector4d lambda;
    for (int i = 0; i < 4; ++i) {
      lambda(i) = 0.5 + i + random.uniform(0.0, 0.8);
    }
    const double frequency = random.uniform(0.3, 5.0);
    const double reduced = ExcitationRatio<double>(lambda).at(frequency);
    const double sampled = sampled_ratio(lambda, frequency, 4000);
    CHECK(reduced <= sampled * (1.0 + 1e-7));
    CHECK(reduced >= sampled * (1.0 - 1e-3));
  }
}

TEST_CASE("the paper's filters over [1, 5] rad/s: the minimum is at the end, to a relative 1e-9") {
  const auto minimum = enclose_ell(range({1.0, 2.0, 3.0, 4.0}, 1.0, 5.0));
  CHECK(minimum.converged);
  CHECK(minimum.upper - minimum.lower <= 1e-9 * minimum.lower);
  CHECK(minimum.upper == doctest::Approx(3.50368265e-4).epsilon(1e-7));
  CHECK(rigor::identical(minimum.where(0), Interval(5.0)));
  CHECK(minimum.cells < 200);
}

TEST_CASE("the minimum is enclosed, and no sample lies below, for random filters and ranges") {
  test::Random random(2);
  for (std::int64_t trial = 0; trial < test::effort(40); ++trial) {
    CAPTURE(trial);
    Eigen::Vector4d lambda;
    double rate = 0.0;
    for (int i = 0; i < 4; ++i) {
      rate += std::exp(random.uniform(-2.0, 1.5));
      lambda(i) = rate;
    }
    const double low = std::exp(random.uniform(-4.0, 0.0));
    const double high = low * std::exp(random.uniform(0.1, 6.0));
    const auto minimum = enclose_ell(range(lambda, low, high));
    REQUIRE(minimum.converged);
    double smallest = 1e300;
    constexpr int kSamples = 60;
    for (int k = 0; k <= kSamples; ++k) {
      const double frequency = std::min(high, low * std::pow(high / low, static_cast<double>(k) / kSamples));
      smallest = std::min(smallest, sampled_ratio(lambda, frequency, 400));
    }
    // The oracle loses digits where the determinant is small.
    CHECK(smallest >= minimum.lower * (1.0 - 1e-3) - 1e-13);
    CHECK(minimum.lower >= 0.5 * smallest - 1e-13);
  }
}

TEST_CASE("the three values agree; what a solver found is told, and decides nothing") {
  const auto over = range({1.0, 2.0, 3.0, 4.0}, 1.0, 5.0);
  const auto derivation = derive_kkl_ell(over, enclose_ell(over));
  CHECK(derivation.verdict == Verdict::proved);
  const Interval ell = theorems::find_quantity(derivation, "ell").value;
  for (const char* name : {"ell_ipopt", "ell_nlopt", "ell_nlopt_global"}) {
    CAPTURE(name);
    const auto& quantity = theorems::find_quantity(derivation, name);
    CHECK_FALSE(quantity.is_proved());
    CHECK(rigor::midpoint(quantity.value) == doctest::Approx(rigor::midpoint(ell)).epsilon(1e-6));
  }
  REQUIRE(derivation.conditions.size() == 2);
  for (const auto& condition : derivation.conditions) {
    CAPTURE(condition.id);
    CHECK(condition.verdict == Verdict::proved);
  }
  const auto said_of = [&](const std::string& solver) {
    return std::any_of(derivation.notes.begin(), derivation.notes.end(),
                       [&](const std::string& note) { return note.starts_with(solver + "'s value"); });
  };
  CHECK((said_of("Ipopt") && said_of("NLopt") && said_of("DIRECT")));
}

TEST_CASE("a solver's value outside the enclosure is told by how much, and refutes nothing") {
  // Over these ranges Ipopt stops a relative 1e-9 or more off the minimum.
  test::Random random(3);
  for (std::int64_t trial = 0; trial < test::effort(10); ++trial) {
    CAPTURE(trial);
    Eigen::Vector4d lambda;
    for (int i = 0; i < 4; ++i) {
      lambda(i) = 0.5 + i + random.uniform(0.0, 0.8);
    }
    const auto over = range(lambda, random.uniform(0.1, 1.0), random.uniform(2.0, 8.0));
    const auto derivation = derive_kkl_ell(over, enclose_ell(over));
    CHECK(derivation.verdict == Verdict::proved);
    for (const auto& condition : derivation.conditions) {
      CHECK(condition.verdict == Verdict::proved);
    }
    const double least = theorems::find_quantity(derivation, "ell").value.upper();
    const double ipopt = rigor::midpoint(theorems::find_quantity(derivation, "ell_ipopt").value);
    if (ipopt > least) {
      CHECK(std::any_of(derivation.notes.begin(), derivation.notes.end(), [](const std::string& note) {
        return note.starts_with("Ipopt's value differs from the verified minimum by a relative");
      }));
    }
  }
}

TEST_CASE("an enclosure that is none decides nothing") {
  const auto over = range({1.0, 2.0, 3.0, 4.0}, 1.0, 5.0);
  auto minimum = enclose_ell(over);
  const auto verdict_of = [&](const std::string& id) {
    const auto derivation = derive_kkl_ell(over, minimum);
    for (const auto& condition : derivation.conditions) {
      if (condition.id == id) {
        return condition.verdict;
      }
    }
    FAIL("no condition " << id);
    return Verdict::undecided;
  };
  SUBCASE("below zero: its width, relative to itself, is negative") {
    minimum.lower = -2.0;
    minimum.upper = -1.0;
    CHECK(verdict_of("enclosed") == Verdict::undecided);
    CHECK(verdict_of("positive") == Verdict::refuted);
  }
  SUBCASE("around zero") {
    minimum.lower = -1e-12;
    minimum.upper = 1e-3;
    CHECK(verdict_of("enclosed") == Verdict::undecided);
    CHECK(verdict_of("positive") == Verdict::undecided);
  }
}

/// Rates for M filters, 1/s.
template <int M>
Eigen::Matrix<double, M, 1> random_rates(test::Random& random) {
  Eigen::Matrix<double, M, 1> lambda;
  for (int i = 0; i < M; ++i) {
    lambda(i) = 0.5 + i + random.uniform(0.0, 0.8);
  }
  return lambda;
}

/// The oracle for any number of filters: the filters' responses as complex numbers, and det(L'L) by the
/// singular values of L = (lambda, 1, T), over a grid of directions.
template <int M>
double ratio_on_a_grid(const Eigen::Matrix<double, M, 1>& lambda, double frequency, int directions) {
  double smallest = 1e300;
  for (int k = 0; k < directions; ++k) {
    const std::complex<double> direction = std::polar(1.0, std::numbers::pi * k / directions);
    Eigen::Matrix<double, M, 3> l;
    for (int i = 0; i < M; ++i) {
      l.row(i) << lambda(i), 1.0, (direction / std::complex<double>(lambda(i), frequency)).imag();
    }
    const double root = oracle::singular_values(l).prod();
    smallest = std::min(smallest, root * root / l.col(2).squaredNorm());
  }
  return smallest;
}

TEST_CASE_TEMPLATE("with more filters the minimum is enclosed, against a grid of frequencies and directions",
                   Filters, std::integral_constant<int, 5>, std::integral_constant<int, 6>,
                   std::integral_constant<int, 8>) {
  constexpr int kFilters = Filters::value;
  test::Random random(500 + kFilters);
  for (std::int64_t trial = 0; trial < test::effort(6); ++trial) {
    CAPTURE(trial);
    const auto lambda = random_rates<kFilters>(random);
    const double low = random.uniform(0.3, 2.0);
    const double high = low * random.uniform(1.0, 4.0);
    const ExcitationRatio<double, kFilters> ratio(lambda);
    double smallest = 1e300;
    constexpr int kSteps = 20;
    for (int k = 0; k <= kSteps; ++k) {
      const double frequency = k == kSteps ? high : low + (high - low) * k / kSteps;
      const double here = ratio_on_a_grid<kFilters>(lambda, frequency, 600);
      CHECK(ratio.at(frequency) <= here * (1.0 + 1e-7));
      CHECK(ratio.at(frequency) >= here * (1.0 - 1e-2));
      smallest = std::min(smallest, here);
    }
    const KklRangeOf<kFilters> over{rigor::to_interval(lambda), Interval::from_bounds(low, high)};
    const auto minimum = enclose_ell(over);
    CHECK(minimum.converged);
    CHECK(minimum.lower <= smallest * (1.0 + 1e-7));
    // The ends of the range, where the ratio is least in every case tried, are on the grid.
    CHECK(minimum.upper >= smallest * (1.0 - 1e-2));
    CHECK(derive_kkl_ell(over, minimum).verdict == Verdict::proved);
  }
}

TEST_CASE("ranges over many decades are enclosed, or left undecided") {
  for (const double high : {1e3, 1e6, 1e12, 1e60, 1e150}) {
    CAPTURE(high);
    const auto minimum = enclose_ell(range({1.0, 2.0, 3.0, 4.0}, 1.0 / high, high));
    const double at_end = ExcitationRatio<double>(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0)).at(high);
    CHECK(!(minimum.lower > at_end * (1.0 + 1e-9)));
  }
}

}  // namespace
}  // namespace veritrack::kkl_observer

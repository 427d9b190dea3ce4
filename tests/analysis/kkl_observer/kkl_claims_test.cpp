#include "analysis/kkl_observer/kkl_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "analysis/kkl_observer/kkl_identities.hpp"
#include "analysis/kkl_observer/number_of_filters.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;
using rigor::Verdict;

KklClaimsQuestion question(const std::vector<double>& rates, double ell) {
  KklClaimsQuestion q;
  for (const double rate : rates) {
    q.lambda.emplace_back(rate);
  }
  q.frequency = Interval::from_bounds(1.0, 5.0);
  q.amplitude = Interval::from_bounds(1.0, 2.0);
  q.ell = Interval(ell);
  if (rates.size() >= 4) {
    with_number_of_filters(rates.size(), [&](auto filters) {
      KklRangeOf<decltype(filters)::value> range;
      for (std::size_t i = 0; i < rates.size(); ++i) {
        range.lambda(static_cast<Eigen::Index>(i)) = q.lambda[i];
      }
      range.frequency = q.frequency;
      q.infimum = enclose_ell(range).value();
    });
  }
  return q;
}

Verdict verdict_of(const theorems::Derivation& derivation, const std::string& id) {
  for (const auto& condition : derivation.conditions) {
    if (condition.id == id) {
      return condition.verdict;
    }
  }
  throw std::out_of_range(id);
}

TEST_CASE("the identities are proved on their grids, and a false one is refuted") {
  CHECK(transform_is_invariant() == Verdict::proved);
  CHECK(transform_is_invariant_with_other_sign() == Verdict::refuted);
  CHECK(determinant_is_excitation() == Verdict::proved);
  CHECK(null_space_holds_lambda_and_one() == Verdict::proved);
  // x (x - 1) (x - 2) vanishes on {0, 1, 2}: the degree matters.
  const auto cubic = [](const std::array<std::int64_t, 1>& x) { return x[0] * (x[0] - 1) * (x[0] - 2); };
  CHECK(is_zero_polynomial<1>(cubic, 3) == Verdict::refuted);
}

TEST_CASE("claims about the inverse follow the ell in use") {
  for (const auto& [ell, expected] : {std::pair{5.0, Verdict::refuted},
                                      {7.1e-4, Verdict::refuted},
                                      {7.0e-4, Verdict::proved},
                                      {1e-6, Verdict::proved}}) {
    CAPTURE(ell);
    const auto claims = derive_kkl_claims(question({1.0, 2.0, 3.0, 4.0}, ell));
    CHECK(verdict_of(claims, "mu-vanishes") == expected);
    CHECK(verdict_of(claims, "left-inverse") == expected);
    CHECK(verdict_of(claims, "positive-definite") == Verdict::proved);
    CHECK(verdict_of(claims, "continuity") == Verdict::proved);
    CHECK(verdict_of(claims, "injectivity") == Verdict::proved);
    CHECK(verdict_of(claims, "section-v-ell") == Verdict::refuted);
  }
}

TEST_CASE("against an ell below twice the infimum there is no witness") {
  const rigor::UpwardRounding upward;
  KklRange range{rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0)), rigor::Interval(3.0)};
  // The infimum at 3 rad/s is 0.00146.
  CHECK(find_inverse_witness(range, rigor::Interval(0.0035)).has_value());
  CHECK_FALSE(find_inverse_witness(range, rigor::Interval(0.0028)).has_value());
  CHECK_FALSE(find_inverse_witness(range, rigor::Interval(1e-9)).has_value());
}

TEST_CASE("a witness against the inverse is one in double, too") {
  const rigor::UpwardRounding upward;
  const Eigen::Vector4d lambda(1.0, 2.0, 3.0, 4.0);
  const auto witness =
      find_inverse_witness<4>({rigor::to_interval(lambda), Interval::from_bounds(1.0, 5.0)}, Interval(0.01));
  REQUIRE(witness);
  const rigor::NearestRounding nearest;
  const Eigen::Vector3d x(witness->x1, witness->x2, witness->frequency * witness->frequency);
  const Eigen::Vector4d xi = trackers::kkl_transform<double, 4>(x, lambda);
  CHECK(trackers::kkl_regularization<double, 4>(xi, {lambda, 0.01}) > 0.0);
  CHECK((trackers::kkl_inverse<double, 4>(xi, {lambda, 0.01}) - x).norm() > 1e-3);
}

TEST_CASE("the injectivity inequality holds for random pairs of states and random filters") {
  test::Random random(51);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    std::vector<double> rates;
    double rate = 0.0;
    const std::uint64_t filters = 4 + random.below(3);
    for (std::uint64_t i = 0; i < filters; ++i) {
      rate += random.uniform(0.3, 1.5);
      rates.push_back(rate);
    }
    const double d = theorems::find_quantity(derive_kkl_claims(question(rates, 1e-6)), "injectivity_constant")
                         .value.upper();
    for (int pair = 0; pair < 200; ++pair) {
      const auto state = [&] {
        return trackers::oscillator_state(random.uniform(1.0, 2.0), random.uniform(0.0, 6.3),
                                          random.uniform(1.0, 5.0));
      };
      const Eigen::Vector3d a = state();
      const Eigen::Vector3d b =
          pair % 2 == 0
              ? state()
              : Eigen::Vector3d(a + 1e-3 * Eigen::Vector3d(random.uniform(), random.uniform(), 0.0));
      double squared = 0.0;
      for (const double l : rates) {
        const double difference = (l * a(0) + a(1)) / (l * l + a(2)) - (l * b(0) + b(1)) / (l * l + b(2));
        squared += difference * difference;
      }
      const double c = 0.5 * (std::fabs(a(0)) + std::fabs(a(1)) + std::fabs(b(0)) + std::fabs(b(1)));
      const double left = std::fabs(a(0) - b(0)) + std::fabs(a(1) - b(1)) + c * std::fabs(a(2) - b(2));
      CHECK(left <= d * std::sqrt(squared) * (1.0 + 1e-9));
    }
  }
}

TEST_CASE(
    "the paper's injectivity constant, without the factor, fails at the witness of docs/kkl-observer.md") {
  const std::vector<double> rates{0.1, 0.2, 0.3, 1.0};
  const Eigen::Vector3d a(99.5743, -139.3188, 100.0);
  const Eigen::Vector3d b(98.5743, -137.9253, 99.0);
  double squared = 0.0;
  for (const double l : rates) {
    const double difference = (l * a(0) + a(1)) / (l * l + a(2)) - (l * b(0) + b(1)) / (l * l + b(2));
    squared += difference * difference;
  }
  const double mean = 0.5 * (a(2) + b(2));
  const double c = 0.5 * (std::fabs(a(0)) + std::fabs(a(1)) + std::fabs(b(0)) + std::fabs(b(1)));
  const double left = std::fabs(a(0) - b(0)) + std::fabs(a(1) - b(1)) + c * std::fabs(a(2) - b(2));
  Eigen::Matrix4d vandermonde;
  for (int i = 0; i < 4; ++i) {
    const double l = rates[static_cast<std::size_t>(i)];
    vandermonde.row(i) << l * l * l, l * l, l, 1.0;
  }
  const double smallest = oracle::singular_values(vandermonde)(3);
  const double printed = (1.0 + mean) * (1.0 + mean) * (1.0 + mean) / smallest;  // the largest rate is 1
  const double factor = std::sqrt(2.0 * (1.0 + mean) * (1.0 + mean) + 2.0) / (1.0 + mean);
  CHECK(left > 1.2 * printed * std::sqrt(squared));
  CHECK(left <= factor * printed * std::sqrt(squared));
}

TEST_CASE("the modulus of continuity bounds differences of gamma") {
  test::Random random(52);
  const Eigen::Vector4d lambda(1.0, 2.0, 3.0, 4.0);
  const double ell = 0.5;
  double modulus = 0.0;
  {
    const rigor::UpwardRounding upward;
    modulus = continuity_modulus<4>(rigor::to_interval(lambda), Interval(ell), Interval(0.5), Interval(1.0))
                  .upper();
  }
  REQUIRE(std::isfinite(modulus));
  for (std::int64_t trial = 0; trial < test::effort(500); ++trial) {
    const auto point = [&] {
      const Eigen::Vector4d direction =
          Eigen::Vector4d::NullaryExpr([&] { return random.uniform(-1.0, 1.0); });
      return Eigen::Vector4d(direction.normalized() * random.uniform(0.5, 1.0));
    };
    const Eigen::Vector4d a = point();
    const Eigen::Vector4d b = point();
    const double change = (trackers::kkl_inverse<double, 4>(a, {lambda, ell}) -
                           trackers::kkl_inverse<double, 4>(b, {lambda, ell}))
                              .norm();
    CHECK(change <= 0.5 * std::numbers::pi * modulus * (a - b).norm());
  }
}

TEST_CASE("fewer than four filters are refused, and more than eight") {
  CHECK_THROWS_AS((void)derive_kkl_claims(question({1.0, 2.0, 3.0}, 1.0)), std::invalid_argument);
  KklClaimsQuestion nine = question({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}, 1e-6);
  nine.lambda.emplace_back(9.0);
  CHECK_THROWS_AS((void)derive_kkl_claims(nine), std::invalid_argument);
}

/// The largest |(x3_hat - x3) / x3| of the observer with M filters over a grid of frequencies and directions
/// of signals, without the tracker's code: (15) by Eigen's least squares, regularized by the square root of
/// mu.
template <int M>
double worst_on_a_grid(const Eigen::Matrix<double, M, 1>& lambda, double ell, double low, double high) {
  double worst = 0.0;
  constexpr int kSteps = 20;
  constexpr int kDirections = 200;
  for (int step = 0; step <= kSteps; ++step) {
    const double frequency = low + (high - low) * step / kSteps;
    for (int k = 0; k < kDirections; ++k) {
      const std::complex<double> direction = std::polar(1.0, std::numbers::pi * k / kDirections);
      Eigen::Matrix<double, M, 1> xi;
      for (int i = 0; i < M; ++i) {
        xi(i) = (direction / std::complex<double>(lambda(i), frequency)).imag();
      }
      Eigen::Matrix<double, M, 3> l;
      l << lambda, Eigen::Matrix<double, M, 1>::Ones(), -xi;
      const double excitation = (l.transpose() * l).determinant();
      const double mu = std::max(0.0, ell * xi.squaredNorm() - 2.0 * excitation);
      Eigen::Matrix<double, M + 3, 3> regularized;
      regularized << l, std::sqrt(mu) * Eigen::Matrix3d::Identity();
      Eigen::Matrix<double, M + 3, 1> right = Eigen::Matrix<double, M + 3, 1>::Zero();
      right.template head<M>() = lambda.cwiseAbs2().cwiseProduct(xi);
      const Eigen::Vector3d x = oracle::least_squares(regularized, right);
      const double s = frequency * frequency;
      worst = std::max(worst, std::fabs(x(2) - s) / s);
    }
  }
  return worst;
}

TEST_CASE_TEMPLATE("with more filters gamma inverts T exactly where it is said to", Filters,
                   std::integral_constant<int, 5>, std::integral_constant<int, 6>) {
  constexpr int kFilters = Filters::value;
  test::Random random(600 + kFilters);
  for (std::int64_t trial = 0; trial < test::effort(4); ++trial) {
    CAPTURE(trial);
    Eigen::Matrix<double, kFilters, 1> lambda;
    for (int i = 0; i < kFilters; ++i) {
      lambda(i) = 0.5 + i + random.uniform(0.0, 0.8);
    }
    const std::vector<double> rates(lambda.begin(), lambda.end());
    const double largest = 2.0 * question(rates, 1.0).infimum.lower();
    for (const auto& [share, expected] :
         {std::pair{0.999, Verdict::proved}, std::pair{1.1, Verdict::refuted}}) {
      CAPTURE(share);
      const auto claims = derive_kkl_claims(question(rates, share * largest));
      CHECK(verdict_of(claims, "mu-vanishes") == expected);
      CHECK(verdict_of(claims, "left-inverse") == expected);
      CHECK(verdict_of(claims, "positive-definite") == Verdict::proved);
      CHECK(verdict_of(claims, "continuity") == Verdict::proved);
      const double worst = worst_on_a_grid<kFilters>(lambda, share * largest, 1.0, 5.0);
      if (expected == Verdict::proved) {
        CHECK(worst < 1e-6);
      } else {
        CHECK(worst > 1e-4);
      }
    }
  }
}

TEST_CASE("the modulus of continuity bounds differences of gamma of six filters") {
  test::Random random(53);
  using Six = Eigen::Matrix<double, 6, 1>;
  const Six lambda(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
  const double ell = 0.5;
  double modulus = 0.0;
  {
    const rigor::UpwardRounding upward;
    modulus = continuity_modulus<6>(rigor::to_interval(lambda), Interval(ell), Interval(0.5), Interval(1.0))
                  .upper();
  }
  REQUIRE(std::isfinite(modulus));
  for (std::int64_t trial = 0; trial < test::effort(500); ++trial) {
    const auto point = [&] {
      const Six direction = Six::NullaryExpr([&] { return random.uniform(-1.0, 1.0); });
      return Six(direction.normalized() * random.uniform(0.5, 1.0));
    };
    const Six a = point();
    const Six b = point();
    const double change = (trackers::kkl_inverse<double, 6>(a, {lambda, ell}) -
                           trackers::kkl_inverse<double, 6>(b, {lambda, ell}))
                              .norm();
    CHECK(change <= 0.5 * std::numbers::pi * modulus * (a - b).norm());
  }
}

TEST_CASE("the least excited signal of a frequency is excited as little as the branch and bound says") {
  test::Random random(49);
  for (std::int64_t i = 0; i < test::effort(100); ++i) {
    CAPTURE(i);
    const Eigen::Vector4d lambda(random.uniform(0.5, 1.2), random.uniform(1.5, 2.2), random.uniform(2.5, 3.2),
                                 random.uniform(3.5, 4.2));
    const double frequency = random.uniform(0.5, 5.0);
    const SignalWitness signal = propose_least_excited(lambda, frequency);
    const rigor::UpwardRounding upward;
    const KklRange range{rigor::to_interval(lambda), Interval(frequency)};
    const rigor::IntervalVector<4> xi = trackers::kkl_transform<Interval, 4>(signal.state(), range.lambda);
    Interval squares(0.0);
    for (const Interval& filter : xi) {
      squares += square(filter);
    }
    const Interval ratio = trackers::kkl_excitation<Interval, 4>(xi, range.lambda) / squares;
    CHECK(ratio.upper() <= enclose_ell(range).upper * (1.0 + 1e-10));
    CHECK(ratio.upper() >= enclose_ell(range).lower);
  }
}

}  // namespace
}  // namespace veritrack::kkl_observer

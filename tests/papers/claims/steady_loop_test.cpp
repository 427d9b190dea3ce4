#include "papers/claims/steady_loop.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

trackers::ToneModel<Interval> design(double q, double r, double epsilon) {
  return {Interval(q), Interval(q), Interval(r), Interval(epsilon)};
}

/// The tracker itself, in lock with a tone of amplitude 1 whose frequency rises by `slew` from -1500 slew to
/// 1500 slew: the frequency's error, true minus estimated, at the end.
double simulated_error(double q, double r, double epsilon, double slew) {
  double frequency = -1500.0 * slew;
  trackers::QuadratureEkf<double> tracker(
      {q, q, r, epsilon},
      {1.0, 0.0, frequency,
       trackers::FactoredCovariance<double>::from_matrix(r * Eigen::Matrix3d::Identity())});
  double phase = 0.0;
  for (int k = 0; k < 3000; ++k) {
    phase += frequency;
    frequency += slew;
    tracker.step(std::cos(phase), std::sin(phase));
  }
  return frequency - tracker.filtered().frequency;
}

}  // namespace

TEST_CASE("the steady loop of the tracker is enclosed, and its gains are those of a long run") {
  test::Random random(40);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(20); ++i) {
    const double q = std::pow(10.0, random.uniform(-4.0, -1.0));
    const double r = std::pow(10.0, random.uniform(-3.0, 0.0));
    const double epsilon = i % 2 == 0 ? 0.0 : random.uniform(0.0, 0.1);
    CAPTURE(q);
    CAPTURE(r);
    const auto loop = theorems::steady_loop(design(q, r, epsilon));
    REQUIRE(loop);
    // Matrices of the textbook, filtered covariance first.
    Eigen::Matrix2d p = r * Eigen::Matrix2d::Identity();
    Eigen::Matrix2d f;
    f << 1.0, 1.0, 0.0, 1.0 - epsilon;
    Eigen::Vector2d gain;
    for (int k = 0; k < 5000; ++k) {
      const Eigen::Matrix2d predicted = f * p * f.transpose() + q * Eigen::Matrix2d::Identity();
      gain = predicted.col(0) / (predicted(0, 0) + r);
      p = predicted - gain * predicted.row(0);
    }
    CHECK(rigor::midpoint(loop->phase_gain()) == doctest::Approx(gain(0)).epsilon(1e-9));
    CHECK(rigor::midpoint(loop->frequency_gain()) == doctest::Approx(gain(1)).epsilon(1e-9));
    CHECK(rigor::width(loop->phase_gain()) < 1e-9);
    Eigen::Matrix2d kept = Eigen::Matrix2d::Identity();
    kept.col(0) -= gain;
    const Eigen::Matrix2d closed = kept * f;
    const Eigen::Vector2cd factors = oracle::eigenvalues(closed);
    CHECK(rigor::midpoint(loop->squared_factor()) ==
          doctest::Approx(std::abs(factors(0) * factors(1))).epsilon(1e-9));
    CHECK((!loop->oscillates() || std::fabs(factors(0).imag()) > 0.0));
    // Noise: sum of the squared impulse response.
    Eigen::Vector2d response = gain;
    double variance = 0.0;
    for (int k = 0; k < 5000; ++k) {
      variance += response(1) * response(1);
      response = closed * response;
    }
    CHECK(rigor::midpoint(loop->noise_variance(Interval(0.25))) ==
          doctest::Approx(0.25 * variance).epsilon(1e-8));
  }
}

TEST_CASE("a frequency that rises slowly is followed as far behind as the linear loop says") {
  const rigor::UpwardRounding upward;
  constexpr double kSlew = 1e-6;
  for (const double epsilon : {0.0, 0.01, 0.05}) {
    CAPTURE(epsilon);
    const auto loop = theorems::steady_loop(design(0.0023, 0.05, epsilon));
    REQUIRE(loop);
    const double error = rigor::midpoint(loop->error_in_ramp(Interval(1500.0 * kSlew), Interval(kSlew)));
    CHECK(simulated_error(0.0023, 0.05, epsilon, kSlew) == doctest::Approx(error).epsilon(1e-3));
    // At a constant drift, which is a rise of the frequency without leak, and its share with one.
    if (epsilon == 0.0) {
      CHECK(rigor::midpoint(loop->lag(Interval(kSlew))) == doctest::Approx(error).epsilon(1e-9));
    } else {
      CHECK(
          rigor::midpoint(loop->lag(Interval(epsilon))) ==
          doctest::Approx(rigor::midpoint(loop->error_in_ramp(Interval(1.0), Interval(0.0)))).epsilon(1e-9));
    }
  }
}

TEST_CASE("without a steady state nothing is enclosed") {
  const rigor::UpwardRounding upward;
  CHECK_FALSE(theorems::steady_loop({Interval(0.1), Interval(0.1), Interval::empty(), Interval(0.0)}));
  CHECK_FALSE(theorems::steady_loop({Interval(0.0), Interval(0.0), Interval(1.0), Interval(0.0)}));
  const theorems::SteadyLoop nothing;
  CHECK_FALSE(nothing.oscillates());
  CHECK(rigor::is_empty(nothing.noise_variance(Interval(1.0))));
}

#include "trackers/single_channel/single_channel_ekf.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/textbook_single_channel_ekf.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using test::random_covariance;
using test::random_estimate;
using test::random_power;
using test::TextbookSingleChannelEkf;
using Design = SingleChannelEkfDesign<double>;

/// Both readings of Q, diagonal ones and full ones; a quarter without leak, a quarter with r = 0.
Design random_single_channel_design(Random& random) {
  const double q = random_power(random, -4.0, 0.0);
  FactoredCovariance<double> process_noise{};
  switch (random.below(4)) {
    case 0:
      process_noise = frequency_only_process_noise(q);
      break;
    case 1:
      process_noise = identity_process_noise(q);
      break;
    case 2:
      process_noise = diagonal_process_noise(q, random_power(random, -4.0, 0.0));
      break;
    default:
      process_noise = FactoredCovariance<double>::from_matrix(random_covariance(random));
  }
  return {process_noise, random.below(4) == 0 ? 0.0 : random_power(random, -3.0, 1.0),
          random.below(4) == 0 ? 0.0 : random.uniform(0.0, 0.2)};
}

template <typename Real>
TextbookSingleChannelEkf<Real> textbook_of(const Design& design, const SingleChannelEstimate<double>& start) {
  return {design.process_noise.matrix().cast<Real>(), Real(design.r), Real(design.epsilon),
          start.state().cast<Real>(), start.covariance.matrix().cast<Real>()};
}

/// Largest entry of |P - textbook P|, each relative to sqrt(unit_ii unit_jj).
template <typename Real>
double covariance_gap(const Eigen::Matrix3d& p, const Eigen::Matrix<Real, 3, 3>& textbook,
                      const Eigen::Matrix3d& unit) {
  double gap = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Real difference = Real(p(i, j)) - textbook(i, j);
      gap = std::max(gap, static_cast<double>(std::abs(difference)) / std::sqrt(unit(i, i) * unit(j, j)));
    }
  }
  return gap;
}

TEST_CASE("one step is the paper's step, from random estimates, for any Q and r >= 0") {
  Random random(61);
  const std::int64_t count = test::effort(40000);
  for (std::int64_t k = 0; k < count; ++k) {
    const Design design = random_single_channel_design(random);
    const auto start = random_estimate(random);
    const double y = random.uniform(-2.0, 2.0);
    auto textbook = textbook_of<long double>(design, start);
    SingleChannelEkf<double> tracker(design, start);
    tracker.time_update();
    textbook.time_update();
    const Eigen::Matrix3d unit = textbook.P.cast<double>();
    const Eigen::Vector3d predicted = textbook.x.cast<double>();
    CHECK((tracker.predicted().state() - predicted).norm() <= 1e-14);
    CHECK(covariance_gap<long double>(tracker.predicted().covariance.matrix(), textbook.P, unit) <= 1e-11);
    tracker.measurement_update(y);
    textbook.measurement_update(y);
    // In the units of the prediction; the innovation is weighed by P11 / S <= 1 where r is small.
    const double innovation = 1.0 + std::fabs(y - predicted(0)) / std::sqrt(unit(0, 0));
    const Eigen::Vector3d moved = tracker.filtered().state() - textbook.x.cast<double>();
    CHECK((moved.array().abs() / unit.diagonal().array().sqrt()).maxCoeff() <= 1e-11 * innovation);
    CHECK(covariance_gap<long double>(tracker.filtered().covariance.matrix(), textbook.P, unit) <= 1e-11);
  }
}

TEST_CASE("a run follows the textbook in extended precision") {
  Random random(62);
  for (int run = 0; run < 60; ++run) {
    Design design = random_single_channel_design(random);
    design.r = random_power(random, -3.0, 0.0);
    const double frequency = random.uniform(0.3, 2.8);
    const SingleChannelEstimate<double> start{
        1.0, 0.0, frequency, FactoredCovariance<double>::from_matrix(1e-2 * random_covariance(random))};
    SingleChannelEkf<double> tracker(design, start);
    auto textbook = textbook_of<long double>(design, start);
    for (int k = 1; k <= 60; ++k) {
      const double y = std::cos(frequency * k) + random.uniform(-0.01, 0.01);
      tracker.step(y);
      textbook.step(static_cast<long double>(y));
      REQUIRE((tracker.filtered().state() - textbook.x.cast<double>()).norm() <= 1e-7);
    }
    const Eigen::Matrix3d p = tracker.filtered().covariance.matrix();
    CHECK(covariance_gap<long double>(p, textbook.P, p) <= 1e-6);
  }
}

TEST_CASE("the readings of Q by name are the matrices of the paper") {
  CHECK(frequency_only_process_noise(0.5).matrix() ==
        Eigen::Vector3d(0.0, 0.0, 0.5).asDiagonal().toDenseMatrix());
  CHECK(identity_process_noise(0.5).matrix() == Eigen::Matrix3d(0.5 * Eigen::Matrix3d::Identity()));
  const Design design = single_channel_design_of_ratio(identity_process_noise(1.0), 10.0);
  CHECK(design.r == 10.0);
  CHECK(design.epsilon == 0.0);
}

TEST_CASE("the sum of two covariances in factors is their sum") {
  Random random(63);
  for (int k = 0; k < 3000; ++k) {
    const Eigen::Matrix3d a = random_covariance(random);
    const Eigen::Matrix3d b = random_covariance(random);
    const auto of = [](const Eigen::Matrix3d& p) { return FactoredCovariance<double>::from_matrix(p); };
    CHECK(covariance_gap<double>(sum(of(a), of(b)).matrix(), a + b, a + b) <= 1e-13);
    CHECK(covariance_gap<double>(sum(of(Eigen::Matrix3d::Zero()), of(b)).matrix(), b, b) <= 1e-13);
  }
  const auto none = FactoredCovariance<double>::from_matrix(Eigen::Matrix3d::Zero());
  CHECK(sum(none, none).matrix() == Eigen::Matrix3d::Zero());
}

TEST_CASE("an innovation variance of exactly zero has a message of its own") {
  const auto zero = FactoredCovariance<double>::from_matrix(Eigen::Matrix3d::Zero());
  SingleChannelEkf<double> tracker(single_channel_design_of_ratio(frequency_only_process_noise(1.0), 0.0),
                                   {1.0, 0.0, 0.5, zero});
  CHECK_THROWS_WITH_AS(tracker.step(1.0), doctest::Contains("innovation variance P11(k|k-1) + r is exactly"),
                       ZeroInnovationVariance);
  // With any variance of the quadrature part it does not arise.
  SingleChannelEkf<double> other(single_channel_design_of_ratio(identity_process_noise(1.0), 0.0),
                                 {1.0, 0.0, 0.5, zero});
  CHECK_NOTHROW(other.step(1.0));
}

TEST_CASE("with r = 0 the estimate passes through every measurement") {
  Random random(64);
  for (const auto& process_noise : {identity_process_noise(0.01), frequency_only_process_noise(0.01)}) {
    SingleChannelEkf<double> tracker({process_noise, 0.0, 0.0},
                                     {0.3, 1.0, 0.5, identity_process_noise(0.01)});
    for (int k = 0; k < 200; ++k) {
      const double y = std::cos(0.5 * k) + random.uniform(-0.1, 0.1);
      tracker.step(y);
      CHECK(std::fabs(tracker.filtered().in_phase - y) <= 1e-12);
      CHECK(tracker.filtered().covariance.matrix()(0, 0) <= 1e-30);
    }
  }
}

TEST_CASE("without noise and leak the truth stays the truth; a small error dies out") {
  const double frequency = std::numbers::pi / 6.0;
  SingleChannelEkf<double> tracker({identity_process_noise(0.005), 0.01, 0.0},
                                   {0.9, 0.1, frequency + 0.05, identity_process_noise(0.005)});
  for (int k = 1; k <= 3000; ++k) {
    tracker.step(std::cos(frequency * k));
  }
  CHECK(std::fabs(tracker.filtered().frequency - frequency) <= 1e-12);
  CHECK(std::fabs(tracker.filtered().quadrature - std::sin(frequency * 3000)) <= 1e-9);
}

TEST_CASE("P stays symmetric and positive definite over a million steps") {
  struct Run {
    Design design;
    double initial_variance;
  };
  const std::array<Run, 5> runs{{
      {{identity_process_noise(0.005), 0.01, 0.05}, 1.0},
      {{identity_process_noise(1.0), 10.0, 0.0}, 1e18},
      {{diagonal_process_noise(1e-12, 1e-9), 1.0, 0.0}, 1e12},
      {{identity_process_noise(1e-3), 1e-9, 0.01}, 1e-20},
      {{frequency_only_process_noise(0.005), 0.01, 0.05}, 1.0},
  }};
  for (const Run& run : runs) {
    Random random(65);
    SingleChannelEkf<double> tracker(run.design,
                                     {1.0, 0.0, 0.7, identity_process_noise(run.initial_variance)});
    bool factors_positive = true;
    bool symmetric = true;
    double phase = 0.0;
    for (std::int64_t k = 0; k < 1000000; ++k) {
      phase = std::remainder(phase + 0.7, 2.0 * std::numbers::pi);
      tracker.step(std::cos(phase) + random.uniform(-0.1, 0.1));
      const FactoredCovariance<double>& p = tracker.filtered().covariance;
      factors_positive = factors_positive && p.frequency_variance > 0.0 && p.conditional_11 > 0.0 &&
                         p.conditional_11 * p.conditional_22 > p.conditional_12 * p.conditional_12;
      if (k % 1000 == 0) {
        symmetric = symmetric && p.matrix() == p.matrix().transpose();
      }
    }
    CAPTURE(run.design.r);
    CAPTURE(run.initial_variance);
    CHECK(factors_positive);
    CHECK(symmetric);
    CHECK(tracker.filtered().state().allFinite());
  }
}

TEST_CASE("the tracker over intervals encloses the textbook filter in extended precision") {
  using rigor::Interval;
  Random random(66);
  const std::int64_t runs = test::effort(300);
  for (std::int64_t run = 0; run < runs; ++run) {
    const Design design = random_single_channel_design(random);
    const auto start = random_estimate(random);
    auto textbook = textbook_of<long double>(design, start);
    const rigor::UpwardRounding upward;
    const auto interval_of = [](const FactoredCovariance<double>& p) {
      return FactoredCovariance<Interval>{Interval(p.conditional_11), Interval(p.conditional_12),
                                          Interval(p.conditional_22), Interval(p.regression_1),
                                          Interval(p.regression_2),   Interval(p.frequency_variance)};
    };
    SingleChannelEkf<Interval> tracker(
        {interval_of(design.process_noise), Interval(design.r), Interval(design.epsilon)},
        {Interval(start.in_phase), Interval(start.quadrature), Interval(start.frequency),
         interval_of(start.covariance)});
    for (int k = 0; k < 2; ++k) {
      const double y = random.uniform(-1.0, 1.0);
      tracker.step(Interval(y));
      textbook.step(static_cast<long double>(y));
    }
    const auto state = tracker.filtered().state();
    for (int i = 0; i < 3; ++i) {
      REQUIRE(rigor::is_finite(state(i)));
      const long double slack = 1e-12L * (1.0L + std::abs(textbook.x(i))) * (1.0L + 1.0L / textbook.S);
      CHECK(static_cast<long double>(state(i).lower()) - slack <= textbook.x(i));
      CHECK(textbook.x(i) <= static_cast<long double>(state(i).upper()) + slack);
    }
  }
}

}  // namespace
}  // namespace veritrack::trackers

#include "papers/limits/posterior_bound.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstddef>

#include "papers/limits/tone_bounds.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::limits {
namespace {

TrackingModel model_of(Channels channels, double noise_variance, double walk_variance, DrawnAtStart drawn) {
  TrackingModel model;
  model.channels = channels;
  model.noise_variance = noise_variance;
  model.walk_variance = walk_variance;
  model.drawn = drawn;
  return model;
}

TEST_CASE("a constant frequency and a start that tells nothing give the Cramer-Rao bounds") {
  for (const Channels channels : {Channels::quadrature, Channels::single}) {
    TrackingModel model = model_of(channels, 0.02, 0.0, DrawnAtStart::start);
    model.amplitude_deviation = 1e4;
    model.phase_deviation = 1e4;
    model.frequency_deviation = 1e2;
    const std::vector<double> bounds = posterior_frequency_bounds(model, 300);
    for (const std::size_t samples : {10U, 50U, 300U}) {
      const int n = static_cast<int>(samples);
      const double expected = channels == Channels::quadrature
                                  ? complex_tone_bound(0.02, n)
                                  : real_tone_bound(0.02, kMeanFrequency, kMeanPhase, n);
      CHECK(bounds[samples - 1] == doctest::Approx(expected).epsilon(1e-5));
    }
  }
}

TEST_CASE("the recursion is the printed one of Tichavsky, Muravchik and Nehorai") {
  // With a little process noise everywhere, so that Q^-1 exists; quadrature measurements.
  const TrackingModel model = model_of(Channels::quadrature, 0.05, 1e-3, DrawnAtStart::truth);
  Eigen::Matrix3d dynamics = Eigen::Matrix3d::Identity();
  dynamics(1, 2) = 1.0;
  const Eigen::Matrix3d inverse_noise = Eigen::Vector3d(1e12, 1e12, 1e3).asDiagonal();
  const Eigen::Matrix3d d11 = dynamics.transpose() * inverse_noise * dynamics;
  const Eigen::Matrix3d d12 = -dynamics.transpose() * inverse_noise;
  const Eigen::Matrix3d measured = Eigen::Vector3d(20.0, 20.0 * 1.01, 0.0).asDiagonal();
  const Eigen::Matrix3d d22 = inverse_noise + measured;
  Eigen::Matrix3d information = Eigen::Vector3d(100.0, 100.0, 400.0).asDiagonal();
  const std::vector<double> bounds = posterior_frequency_bounds(model, 60);
  for (const double bound : bounds) {
    information =
        (d22 - d12.transpose() * oracle::solution(information + d11, d12)).selfadjointView<Eigen::Lower>();
    CHECK(bound == doctest::Approx(information.inverse()(2, 2)).epsilon(2e-3));
  }
}

TEST_CASE("the steady state in closed form is where the recursion settles") {
  test::Random random;
  for (std::int64_t i = 0; i < test::effort(20); ++i) {
    TrackingModel model = model_of(Channels::quadrature, std::pow(10.0, random.uniform(-4.0, 0.0)),
                                   std::pow(10.0, random.uniform(-6.0, -1.0)), DrawnAtStart::start);
    const double settled = posterior_frequency_bounds(model, 2000).back();
    CHECK(settled ==
          doctest::Approx(steady_frequency_bound(model.noise_variance, model.walk_variance)).epsilon(1e-6));
  }
}

TEST_CASE("for one channel: about the bound of twice the noise, and never below that of both channels") {
  const TrackingModel both = model_of(Channels::quadrature, 0.05, 1e-6, DrawnAtStart::truth);
  const TrackingModel one = model_of(Channels::single, 0.05, 1e-6, DrawnAtStart::truth);
  const std::vector<double> bounds_of_both = posterior_frequency_bounds(both, 500);
  const std::vector<double> bounds_of_one = posterior_frequency_bounds(one, 500);
  for (std::size_t k = 0; k < bounds_of_one.size(); ++k) {
    CHECK(bounds_of_one[k] >= bounds_of_both[k]);
  }
  CHECK(bounds_of_one.back() == doctest::Approx(steady_frequency_bound(0.1, 1e-6)).epsilon(0.01));
}

TEST_CASE("the expectation over the phase of the single channel is that of samples") {
  // One measurement after the start: phi(1) = phi(0) + omega(0), both normal.
  TrackingModel model = model_of(Channels::single, 0.05, 1e-4, DrawnAtStart::truth);
  model.phase_deviation = 0.3;
  model.frequency_deviation = 0.4;
  test::Random random;
  const auto normal = [&] {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += random.uniform();
    }
    return sum;
  };
  Eigen::Matrix3d measured = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const double amplitude = kMeanAmplitude + 0.1 * normal();
    const double phase = kMeanPhase + kMeanFrequency + 0.3 * normal() + 0.4 * normal();
    const Eigen::Vector3d gradient(std::cos(phase), -amplitude * std::sin(phase), 0.0);
    measured += gradient * gradient.transpose() / (0.05 * kDraws);
  }
  Eigen::Matrix3d dynamics = Eigen::Matrix3d::Identity();
  dynamics(1, 2) = 1.0;
  const Eigen::Matrix3d start = Eigen::Vector3d(0.01, 0.09, 0.16).asDiagonal();
  Eigen::Matrix3d predicted = dynamics * start * dynamics.transpose();
  predicted(2, 2) += 1e-4;
  const Eigen::Matrix3d expected = (predicted.inverse() + measured).inverse();
  CHECK(posterior_frequency_bounds(model, 1).front() == doctest::Approx(expected(2, 2)).epsilon(0.01));
}

}  // namespace
}  // namespace veritrack::limits

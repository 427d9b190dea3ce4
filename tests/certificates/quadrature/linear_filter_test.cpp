#include "certificates/quadrature/linear_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "certificates/quadrature/quadrature_simulation.hpp"
#include "tests/certificates/test_design.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace {

using namespace veritrack;

/// The share of a small step of the frequency that the tracker itself has followed, by sample; the amplitude
/// is 2.
std::vector<double> followed_by_tracker(const certificates::Design& design, double omega,
                                        std::size_t samples) {
  constexpr double kStep = 1e-6;
  using Tracker = trackers::QuadratureEkf<double>;
  const Eigen::Matrix3d covariance = certificates::find_steady_state(design, omega).covariance;
  Tracker tracker({.q1 = 0.0023, .q2 = 0.0023, .r = 0.05, .epsilon = 0.0},
                  {2.0, 0.0, omega, trackers::FactoredCovariance<double>::from_matrix(covariance)});
  std::vector<double> share;
  for (std::size_t k = 0; k < samples; ++k) {
    share.push_back((tracker.filtered().frequency - omega) / kStep);
    const double phase = (omega + kStep) * static_cast<double>(k + 1);
    tracker.step(2.0 * std::cos(phase), 2.0 * std::sin(phase));
  }
  return share;
}

TEST_CASE("the linear filter follows a small step as the tracker does") {
  const auto design = test::design({{"amplitude = 1.0", "amplitude = 2.0"}});
  const auto filter = certificates::linear_filter(design);
  REQUIRE(filter.has_value());
  const std::vector<double> tracked = followed_by_tracker(design, 1.0, 40);
  const std::vector<double> linear = linear::followed_share(filter->loop, 40);
  for (std::size_t k = 0; k < tracked.size(); ++k) {
    CHECK(std::fabs(tracked[k] - linear[k]) < 1e-4);
  }
  CHECK(linear.back() == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE(
    "what passes of white noise is the textbook's: the noise of the measurement in P33, without the process "
    "noise") {
  // P = (I - K H)(F P F' + Q)(I - K H)' + r K K'; the share of r K K' alone, by summing it up.
  const auto design = test::design();
  const auto filter = certificates::linear_filter(design);
  REQUIRE(filter.has_value());
  const double r = 0.05;
  Eigen::Matrix3d of_noise = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 2000; ++k) {
    of_noise = filter->loop.a * of_noise * filter->loop.a.transpose() +
               r * filter->loop.noise * filter->loop.noise.transpose();
  }
  CHECK(std::sqrt(r) * linear::noise_deviation(filter->loop, 2000) ==
        doctest::Approx(std::sqrt(of_noise(2, 2))));
  CHECK(of_noise(2, 2) < certificates::find_steady_state(design, 1.0).covariance(2, 2));
}

TEST_CASE("a leak biases the steady state: nothing is said") {
  CHECK_FALSE(certificates::linear_filter(test::design({{"epsilon = 0.0", "epsilon = 0.01"}})).has_value());
}

TEST_CASE("the section has modes, noise and margins") {
  const std::string text = certificates::linear_filter_section(test::certificate());
  for (const char* words :
       {"## The linear filter", "pair of modes at", "damping 0.75", "white noise", "phase margin"}) {
    CHECK(text.find(words) != std::string::npos);
  }
}

}  // namespace

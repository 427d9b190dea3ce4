#include "analysis/quadrature/falsifier/lock_loss.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {
namespace {

/// The program itself, at 1 rad/sample.
double rate_of_program(const trackers::ToneModel<double>& design, double decibels, int samples) {
  const BlockCovariance<double> p = *steady_covariance(design);
  Eigen::Matrix3d steady;
  steady << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  const double deviation = std::sqrt(0.5 * std::pow(10.0, -decibels / 10.0));
  trackers::RandomStream noise(77);
  int losses = 0;
  int done = 0;
  while (done < samples) {
    trackers::QuadratureEkf<double> ekf(
        design, {1.0, 0.0, 1.0, trackers::FactoredCovariance<double>::from_matrix(steady)});
    double turned = 0.0;
    for (double phase = 1.0; done < samples; phase += 1.0) {
      ++done;
      ekf.time_update();
      ekf.measurement_update(std::cos(phase) + deviation * noise.normal(),
                             std::sin(phase) + deviation * noise.normal());
      const Eigen::Vector3d x = ekf.filtered().state();
      turned += std::remainder(std::atan2(x[1], x[0]) - phase - turned, 2.0 * std::numbers::pi);
      if (std::fabs(x[2] - 1.0) > 0.5 * std::numbers::pi || std::fabs(turned) > 2.0 * std::numbers::pi) {
        ++losses;
        break;
      }
    }
  }
  return static_cast<double>(losses) / samples;
}

}  // namespace

TEST_CASE("the simulated rate of losing lock is that of the program, falls with the noise and has a law") {
  const trackers::ToneModel<double> design{0.0065, 0.0065, 0.01, 0.0};
  const LockLoss found = simulate_lock_loss(design, 0.0);
  REQUIRE(found.rates.size() > 4);
  for (std::size_t k = 1; k < found.rates.size(); ++k) {
    CHECK(found.rates[k].rate() < 1.1 * found.rates[k - 1].rate());
    CHECK(found.rates[k].decibels > found.rates[k - 1].decibels);
  }
  for (const LossRate& rate : found.rates) {
    if (rate.decibels == 0.0) {
      constexpr int kSamples = 200'000;
      const double program = rate_of_program(design, 0.0, kSamples);
      MESSAGE("at 0 dB: " << rate.rate() << ", the program " << program);
      CHECK(program == doctest::Approx(rate.rate()).epsilon(5.0 / std::sqrt(program * kSamples)));
    }
  }
  REQUIRE(found.law.has_value());
  CHECK(found.law->slope < 0.0);
  MESSAGE("a rate of 1e-12 at " << found.law->decibels_of(1e-12) << " dB");
  CHECK(found.law->decibels_of(1e-12) > 7.5);
  CHECK(found.law->decibels_of(1e-12) < 10.0);
  CHECK(found.law->rate_at(found.law->decibels_of(1e-9)) == doctest::Approx(1e-9));
  // The last rate that was counted is the law's.
  const LossRate& counted = found.rates[found.rates.size() - 2];
  CHECK(found.law->rate_at(counted.decibels) == doctest::Approx(counted.rate()).epsilon(0.5));
}

TEST_CASE("without a steady state nothing is simulated") {
  CHECK(simulate_lock_loss({0.0, 0.001, 0.01, 0.0}, 0.0).rates.empty());
}

}  // namespace veritrack::quadrature

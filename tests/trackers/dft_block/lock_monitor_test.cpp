#include "trackers/dft_block/lock_monitor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "trackers/signals/random.hpp"

namespace {

using namespace veritrack::trackers;
using Bins = std::vector<DftBin<double>>;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// (4.9) with complex numbers, and noise of that deviation in each part; no integer offset.
Bins bins_of(double amplitude, double phase, double offset, double noise, RandomStream& random) {
  Bins bins;
  for (int m = -2; m <= 2; ++m) {
    const std::complex<double> value = amplitude / (2.0 * kTurn) * std::polar(1.0, phase) *
                                       (std::polar(1.0, kTurn * offset) - 1.0) /
                                       (std::complex<double>(0.0, 1.0) * (offset - m));
    const double real = noise * random.normal();
    bins.push_back({value.real() + real, value.imag() + noise * random.normal()});
  }
  return bins;
}

/// Set 1 of the thesis on a tone 0.3 bins off, started so many bins off it, after 200 blocks.
struct Seen {
  BlockLockMonitor<double> monitor{2};
  double error = 0.0;
};
Seen follow(double amplitude, double start_error, double start_phase, double noise) {
  const DftBlockDesign<double> design{5e-5, 1e-3, 2.5e-3, 12.5 / 4096.0, 0.0, 0.0};
  RandomStream random(77);
  DftBlockEkf<double> tracker(design, {std::sqrt(1.0 / (2.0 * kTurn)), start_phase, 0.3 + start_error,
                                       Eigen::Vector3d(0.005, 0.7, 0.01).asDiagonal()});
  Seen seen;
  double phase = 0.0;
  for (int k = 0; k < 200; ++k) {
    const Bins bins = bins_of(amplitude, phase, 0.3, noise, random);
    tracker.measurement_update(std::span<const DftBin<double>>(bins));
    seen.monitor.push(bins, tracker.filtered());
    if (k == 18) {
      CHECK(seen.monitor.state() == BlockLockState::settling);
    }
    tracker.time_update();
    phase += kTurn * 0.3;
  }
  seen.error = tracker.filtered().offset - 0.3;
  return seen;
}

}  // namespace

TEST_CASE("in lock the estimate explains the power, and what is left is the noise") {
  for (const double noise : {0.0, 0.002, 0.02}) {
    CAPTURE(noise);
    const Seen seen = follow(1.0, 0.01, 0.0, noise);
    REQUIRE(std::fabs(seen.error) < 0.2);
    CHECK(seen.monitor.state() == BlockLockState::lock);
    // A tone of amplitude 1 has about 1/4 in the bins, the noise 10 noise^2.
    const double share = 10.0 * noise * noise / (0.24 + 10.0 * noise * noise);
    CHECK(seen.monitor.unexplained_share() <= 1.5 * share + 1e-9);
    CHECK(seen.monitor.unexplained_share() >= 0.3 * share);
    CHECK(std::fabs(seen.monitor.best_offset() - 0.3) < 0.07);
  }
}

TEST_CASE("in a false lock it explains next to nothing, and another offset does") {
  for (const double side : {-1.0, 1.0}) {
    for (const double noise : {0.0, 0.002, 0.01}) {
      CAPTURE(side);
      CAPTURE(noise);
      const Seen seen = follow(1.0, side * 0.95, 0.7, noise);
      REQUIRE(std::fabs(seen.error) > 0.8);
      CHECK(seen.monitor.state() == BlockLockState::false_lock);
      CHECK(seen.monitor.unexplained_share() > 0.9);
      CHECK(std::fabs(seen.monitor.best_offset() - 0.3) < 0.07);
    }
  }
}

TEST_CASE("where there is only noise, no lock is called false") {
  const Seen seen = follow(0.0, 0.01, 0.0, 0.01);
  CHECK(seen.monitor.state() == BlockLockState::no_tone);
  CHECK(seen.monitor.best_share() < seen.monitor.tone_threshold());
}

TEST_CASE("what no monitor can be made of") {
  CHECK_THROWS_AS(BlockLockMonitor<double>(0), std::invalid_argument);
  CHECK_THROWS_AS(BlockLockMonitor<double>(2, 0), std::invalid_argument);
  BlockLockMonitor<double> monitor(2);
  CHECK(monitor.unexplained_share() == 1.0);
  CHECK(monitor.state() == BlockLockState::settling);
  const Bins three(3, DftBin<double>{1.0, 0.0});
  CHECK_THROWS_AS(monitor.push(three, DftBlockEstimate<double>{}), std::invalid_argument);
}

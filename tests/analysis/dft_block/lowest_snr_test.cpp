#include "analysis/dft_block/lowest_snr.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "tests/analysis/dft_block/loss_question.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"
#include "trackers/signals/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

using test::kVarianceOfBins;
using test::number_of;
constexpr double kBlocks = 1000.0;
constexpr double kProbability = 1e-3;
constexpr double kStart = 1e-3;
/// Of a part of a bin at 0 dB, for amplitude 1 and 2048 samples.
const double kUnit = 1.0 / std::sqrt(2.0 * 2.0 * 2048.0);

dft_block::LowestSnrQuestion lowest_question(double slew) {
  dft_block::LowestSnrQuestion result;
  result.loss = test::loss_question(kUnit * std::pow(10.0, -20.0 / 20.0), slew, kBlocks);
  result.loss.amplitude_error = result.loss.phase_error = result.loss.offset_error = Interval(kStart);
  result.unit_deviation = Interval(kUnit);
  result.probability = Interval(kProbability);
  return result;
}

double most(const theorems::Derivation& found, const char* name) {
  return theorems::find_quantity(found, name).value.upper();
}

/// The bound of docs/block-tracker.md, section 7, without slew, in doubles.
double probability_at(const theorems::Derivation& found, double decibels) {
  const double deviation = kUnit * std::pow(10.0, -decibels / 20.0);
  const double theta = number_of(found, "tilt") * kVarianceOfBins / (deviation * deviation);
  const double growth = number_of(found, "growth");
  const double radius = number_of(found, "radius");
  const Eigen::Matrix3d inverse = Eigen::Matrix3d(found.evidence.front().matrices[0].second).inverse();
  const double factor =
      1.0 / std::sqrt(Eigen::Matrix3d(found.evidence.front().matrices[1].second).determinant());
  double start = 0.0;
  for (int signs = 0; signs < 8; ++signs) {
    const Eigen::Vector3d corner((signs & 1) != 0 ? kStart : -kStart, (signs & 2) != 0 ? kStart : -kStart,
                                 (signs & 4) != 0 ? kStart : -kStart);
    start = std::max(start, (inverse * corner).squaredNorm());
  }
  const double constant = std::pow(growth * factor, 1.0 / (1.0 - growth)) * (1.0 / growth - 1.0);
  return std::exp(-0.5 * theta * radius * radius) * (std::exp(0.5 * theta * start) + kBlocks * constant);
}

/// Root mean square of the filter's offset errors on bins (4.9) with noise, after it has settled.
double simulated_rms(double decibels) {
  const double deviation = kUnit * std::pow(10.0, -decibels / 20.0);
  const double root = std::sqrt(1.0 / (4.0 * std::numbers::pi));
  trackers::RandomStream noise(4601);
  double sum = 0.0;
  int count = 0;
  double phase = 0.4;
  const double offset = 0.3;
  trackers::DftBlockEkf<double> tracker(
      {5e-5, 1e-3, 2.5e-3, kVarianceOfBins, 0.0, 0.0},
      {root, phase, offset, Eigen::Vector3d(1e-4, 1e-3, 1e-3).asDiagonal()});
  for (int k = 0; k < 4000; ++k) {
    const auto bins = test::noisy_bins(phase, offset, deviation, noise);
    tracker.measurement_update(std::span<const trackers::DftBin<double>>(bins));
    tracker.time_update();
    phase += 2.0 * std::numbers::pi * offset;
    if (k >= 50) {
      sum += std::pow(tracker.predicted().offset - offset, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE("the lowest ratio is that of its set, to a hundredth of a dB, and no other set has a lower one") {
  const dft_block::LowestSnrQuestion asked = lowest_question(0.0);
  const theorems::Derivation found = dft_block::derive_lowest_snr(asked);
  REQUIRE(found.verdict == rigor::Verdict::proved);
  REQUIRE(found.evidence.front().decimals.size() == 1);
  CHECK(found.evidence.front().decimals.front().first == "snr_db");
  const double decibels = std::stod(found.evidence.front().decimals.front().second);
  CHECK(most(found, "lowest_snr") == doctest::Approx(decibels).epsilon(1e-12));
  CHECK(most(found, "probability_of_losing_lock") <= kProbability);
  CHECK(most(found, "probability_of_losing_lock") ==
        doctest::Approx(probability_at(found, decibels)).epsilon(1e-6));
  CHECK(probability_at(found, decibels - 0.011) > kProbability);
  // The best set for the noise itself is as good, and for a dB more noise not good enough.
  const auto best_at = [&](double ratio) {
    dft_block::LossQuestion at = asked.loss;
    at.deviation = Interval(kUnit * std::pow(10.0, -ratio / 20.0));
    const theorems::Derivation loss = dft_block::derive_loss(at);
    return loss.verdict == rigor::Verdict::proved ? most(loss, "probability_of_losing_lock") : 1.0;
  };
  CHECK(best_at(decibels) <= kProbability);
  CHECK(best_at(decibels - 1.0) > kProbability);
}

TEST_CASE("the mean square in lock is above what the filter does") {
  const theorems::Derivation found = dft_block::derive_lowest_snr(lowest_question(0.0));
  REQUIRE(found.verdict == rigor::Verdict::proved);
  const double bound = most(found, "rms_offset_error");
  const double seen = simulated_rms(std::stod(found.evidence.front().decimals.front().second));
  CHECK(seen <= bound);
  CHECK(seen > 0.05 * bound);  // the set is the best one for the probability
  CHECK(bound < most(found, "offset_error_bound"));
}

TEST_CASE("a slew needs a higher ratio, and starts that no set holds have none" *
          doctest::test_suite("nightly")) {
  const double without = most(dft_block::derive_lowest_snr(lowest_question(0.0)), "lowest_snr");
  const theorems::Derivation moving = dft_block::derive_lowest_snr(lowest_question(1e-3));
  REQUIRE(moving.verdict == rigor::Verdict::proved);
  CHECK(most(moving, "lowest_snr") > without);
  // An estimate is the next prediction before the slew.
  const Eigen::Matrix3d frame = moving.evidence.front().matrices[0].second;
  CHECK(most(moving, "offset_error_bound") ==
        doctest::Approx(number_of(moving, "radius") * frame.row(2).norm() + 1e-3).epsilon(1e-9));
  dft_block::LowestSnrQuestion far = lowest_question(0.0);
  far.loss.offset_error = Interval(0.5);
  const theorems::Derivation none = dft_block::derive_lowest_snr(far);
  CHECK(none.verdict == rigor::Verdict::undecided);
  CHECK(none.evidence.empty());
  CHECK(none.quantities.empty());
}

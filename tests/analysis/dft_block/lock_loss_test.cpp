#include "analysis/dft_block/lock_loss.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <span>
#include <vector>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/dft_block/loss_question.hpp"
#include "tests/support/random.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"
#include "trackers/signals/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

constexpr double kCircle = 3.141592653589793;
using test::kVarianceOfBins;
using test::number_of;

/// The tracker's own block, from z and its covariance to the next z.
Eigen::Vector3d next_error(const Eigen::Vector3d& z, const Eigen::Matrix3d& covariance, double offset,
                           double deviation, trackers::RandomStream& random) {
  const double root = std::sqrt(1.0 / (4.0 * kCircle));
  Eigen::Matrix3d to_start = Eigen::Vector3d(root, 1.0, 1.0).asDiagonal();
  to_start(1, 2) = -kCircle;
  const trackers::DftBlockDesign<double> design{5e-5, 1e-3, 2.5e-3, kVarianceOfBins, 0.0, 0.0};
  const double phase = 6.0 * random.uniform();
  trackers::DftBlockEkf<double> tracker(design,
                                        {root * (1.0 + z(0)), phase + z(1) - kCircle * z(2), offset + z(2),
                                         to_start * covariance * to_start.transpose()});
  const auto bins = test::noisy_bins(phase, offset, deviation, random);
  tracker.measurement_update(std::span<const trackers::DftBin<double>>(bins));
  tracker.time_update();
  const auto& next = tracker.predicted();
  const double error = next.offset - offset;
  return {next.root_amplitude / root - 1.0, next.phase - phase - 2.0 * kCircle * offset + kCircle * error,
          error};
}

}  // namespace

TEST_CASE(
    "W grows on average by no more than is said, from anywhere in the set, as the tracker itself has it") {
  const double deviation = std::sqrt(kVarianceOfBins / 60.0);
  const theorems::Derivation found = dft_block::derive_loss(test::loss_question(deviation, 0.0, 1000.0));
  REQUIRE(found.verdict == rigor::Verdict::proved);
  const double radius = number_of(found, "radius");
  const double theta = number_of(found, "tilt") * kVarianceOfBins / (deviation * deviation);
  const double growth = number_of(found, "growth");
  const Eigen::Matrix3d frame = found.evidence.front().matrices[0].second;
  const Eigen::Matrix3d floor = found.evidence.front().matrices[1].second;
  test::Random random(4405);
  trackers::RandomStream noise(4406);
  double closest = 0.0;
  for (std::int64_t run = 0; run < test::effort(40); ++run) {
    Eigen::Vector3d e(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    e *= radius * random.uniform(0.0, 1.0) / e.norm();
    // A covariance between the bounds: multiples of I at its ends, and turned between.
    const Eigen::Vector3d axis =
        Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
            .normalized();
    const double above = number_of(found, "above");
    const double below = 1.0 / number_of(found, "below");
    const Eigen::Matrix3d s = below * Eigen::Matrix3d::Identity() + (above - below) * axis * axis.transpose();
    const double offset = random.uniform(0.29, 0.31);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kDraws = 4000;
    for (int k = 0; k < kDraws; ++k) {
      const Eigen::Vector3d next =
          frame.inverse() * next_error(frame * e, frame * s * frame.transpose(), offset, deviation, noise);
      // In units of the bound, which is exp(theta growth |e|^2 / 2) / sqrt(det floor).
      const double w = std::exp(0.5 * theta * (next.squaredNorm() - growth * e.squaredNorm())) *
                       std::sqrt(floor.determinant());
      sum += w;
      squares += w * w;
    }
    const double mean = sum / kDraws;
    const double error = std::sqrt(squares / kDraws / kDraws);
    CHECK(mean - 5.0 * error <= 1.0);
    closest = std::max(closest, mean);
  }
  CHECK(closest > 0.2);  // and not by far less
}

TEST_CASE("less noise and fewer blocks are less probable to lose lock, and slew is more") {
  const auto probability = [](double deviation, double slew, double blocks) {
    const theorems::Derivation found = dft_block::derive_loss(test::loss_question(deviation, slew, blocks));
    REQUIRE(found.verdict == rigor::Verdict::proved);
    return theorems::find_quantity(found, "probability_of_losing_lock").value.upper();
  };
  const double deviation = std::sqrt(kVarianceOfBins / 60.0);
  const double usual = probability(deviation, 0.0, 1000.0);
  CHECK(usual < 1.0);
  CHECK(probability(0.9 * deviation, 0.0, 1000.0) < usual);
  CHECK(probability(deviation, 0.0, 10.0) < usual);
  CHECK(probability(deviation, 1e-3, 1000.0) > usual);
}

TEST_CASE("what is no drift is not verified") {
  const auto asked = test::loss_question(std::sqrt(kVarianceOfBins / 60.0), 0.0, 1000.0);
  const theorems::Derivation found = dft_block::derive_loss(asked);
  REQUIRE(found.verdict == rigor::Verdict::proved);
  const auto& evidence = found.evidence.front();
  const dft_block::LockBounds set{evidence.matrices[0].second, number_of(found, "above"),
                                  number_of(found, "below"), 0.0};
  dft_block::LockDrift drift;
  drift.radius = 0.5 * number_of(found, "radius");
  drift.tilt = number_of(found, "tilt");
  drift.growth = number_of(found, "growth");
  drift.weight = number_of(found, "weight");
  drift.floor_weight = number_of(found, "floor_weight");
  drift.floor = evidence.matrices[1].second;
  const rigor::UpwardRounding upward;
  const auto frame = dft_block::LockFrame::make(asked.problem, set);
  REQUIRE(frame);
  const auto refused = [&](auto change) {
    dft_block::LockDrift other = drift;
    change(other);
    return !frame->verify(other, 20'000);
  };
  REQUIRE_FALSE(refused([](auto&) {}));
  CHECK(refused([](auto& one) { one.growth *= 0.3; }));
  CHECK(refused([](auto& one) { one.growth = 1.0; }));
  CHECK(refused([](auto& one) { one.growth = NAN; }));
  CHECK(refused([](auto& one) { one.tilt *= 4.0; }));
  CHECK(refused([](auto& one) { one.tilt = 0.0; }));
  CHECK(refused([](auto& one) { one.weight = -one.weight; }));
  CHECK(refused([](auto& one) { one.floor_weight = 0.0; }));
  CHECK(refused([](auto& one) { one.floor(0, 0) = 1.0; }));
  CHECK(refused([](auto& one) { one.floor(0, 1) += 0.01; }));
  CHECK(refused([](auto& one) { one.floor = -one.floor; }));
  CHECK(refused([](auto& one) { one.floor(2, 2) = NAN; }));
  CHECK(refused([](auto& one) { one.radius = INFINITY; }));
  // A start outside has no bound.
  auto far = asked;
  far.offset_error = Interval(0.5);
  CHECK_FALSE(dft_block::loss_bound(far, *frame, drift, 0.1));
  // Nor one that is a little outside, where all numbers are finite.
  rigor::IntervalVector<3> starts;
  starts << asked.amplitude_error, asked.phase_error, asked.offset_error;
  dft_block::LockDrift tight = drift;
  tight.radius = 1.1 * frame->length_of(starts).upper();
  CHECK(dft_block::loss_bound(asked, *frame, tight, 0.1));
  tight.radius = 0.9 * frame->length_of(starts).lower();
  CHECK_FALSE(dft_block::loss_bound(asked, *frame, tight, 0.1));
  auto silent = asked;
  silent.deviation = Interval(0.0);
  CHECK_FALSE(dft_block::loss_bound(silent, *frame, drift, 0.1));
}

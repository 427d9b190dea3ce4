#include "analysis/dft_block/late_errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "analysis/dft_block/late_proposal.hpp"
#include "analysis/dft_block/lock_certificate.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/dft_block/tones.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

using test::kPi;
using test::lock_problem;

constexpr int kHalfWidth = 2;
constexpr int kBins = 2 * kHalfWidth + 1;
constexpr double kNoise = 0.003;
constexpr double kSlew = 0.001;

using Noise = std::array<double, 2 * kBins>;

/// The offset error of the prediction after these blocks of noise and slew, of a tracker that begins in lock.
double final_error(const trackers::DftBlockEstimate<double>& start, const std::vector<Noise>& noises,
                   const std::vector<double>& slews) {
  const trackers::DftBlockDesign<double> design{5e-5, 1e-3, 2.5e-3, 12.5 / 4096.0, 0.0, 0.0};
  trackers::DftBlockEkf<double> tracker(design, start);
  double phase = start.phase;
  double offset = start.offset;
  for (std::size_t block = 0; block < noises.size(); ++block) {
    auto bins = test::tone_bins(1.0, phase, offset, kHalfWidth);
    for (std::size_t i = 0; i < bins.size(); ++i) {
      bins[i].real += noises[block][2 * i];
      bins[i].imaginary += noises[block][2 * i + 1];
    }
    tracker.measurement_update(std::span<const trackers::DftBin<double>>(bins));
    tracker.time_update();
    phase += 2.0 * kPi * offset;
    offset += slews[block];
  }
  return tracker.predicted().offset - offset;
}

/// What noise of that length and slew make of the offset error at worst, near enough: each along its effect.
double worst_error(const trackers::DftBlockEstimate<double>& start, std::size_t blocks) {
  constexpr double kStep = 1e-6;
  const std::vector<Noise> silence(blocks, Noise{});
  const std::vector<double> still(blocks, 0.0);
  std::vector<Noise> noises = silence;
  std::vector<double> slews = still;
  for (std::size_t block = 0; block < blocks; ++block) {
    Noise effect{};
    double square = 0.0;
    for (std::size_t i = 0; i < effect.size(); ++i) {
      std::vector<Noise> one = silence;
      one[block][i] = kStep;
      effect[i] = final_error(start, one, still) / kStep;
      square += effect[i] * effect[i];
    }
    for (std::size_t i = 0; i < effect.size(); ++i) {
      noises[block][i] = kNoise * effect[i] / std::sqrt(square);
    }
    std::vector<double> moved = still;
    moved[block] = kStep;
    slews[block] = std::copysign(kSlew, final_error(start, silence, moved));
  }
  return std::fabs(final_error(start, noises, slews));
}

/// The tracker in exact lock with its steady covariance.
trackers::DftBlockEstimate<double> in_lock(const dft_block::LockSearch& search) {
  rigor::Matrix<3> to_start = rigor::Matrix<3>::Identity();
  to_start(0, 0) = std::sqrt(1.0 / (4.0 * kPi));
  to_start(1, 2) = -kPi;
  trackers::DftBlockEstimate<double> start;
  start.root_amplitude = to_start(0, 0);
  start.phase = 0.4;
  start.offset = 0.02;
  start.covariance = to_start * search.steady() * to_start.transpose();
  return start;
}

TEST_CASE("an attack reaches two thirds of the bound of the long run, and no more than it") {
  const dft_block::LockProblem problem = lock_problem(-0.1, 0.1, kNoise, kSlew);
  const dft_block::LockQuestion question{problem,        Interval(0.005), Interval(0.05),
                                         Interval(0.01), std::nullopt,    std::nullopt};
  const theorems::Derivation found = dft_block::derive_lock(question);
  REQUIRE(found.verdict == rigor::Verdict::proved);
  const double bound = theorems::find_quantity(found, "ultimate_offset_error").value.upper();
  const double reached = worst_error(in_lock(dft_block::LockSearch(problem)), 24);
  MESSAGE("attack " << reached << " bins, proved " << bound);
  CHECK(reached <= bound);
  CHECK(reached >= bound / 1.5);
}

/// A set with a rate, and a stage for the errors that they leave.
struct Proposal {
  dft_block::LockBounds set;
  dft_block::LockRate rate;
  dft_block::LateStage stage;
};

std::optional<Proposal> propose(const dft_block::LockProblem& problem) {
  const dft_block::LockSearch search(problem);
  constexpr double kRadius = 0.3;
  constexpr double kLate = 0.26;
  const auto set = search.set_for(kRadius);
  const auto rate = set ? search.rate_for(*set, kRadius) : std::nullopt;
  const auto stage = dft_block::propose_stage(search, dft_block::ErrorSet::ball(kLate), 1.02);
  return rate && stage ? std::optional(Proposal{*set, *rate, *stage}) : std::nullopt;
}

TEST_CASE("what is not true of a stage is not verified") {
  const dft_block::LockProblem problem = lock_problem(-0.02, 0.02, kNoise, kSlew);
  const auto proposal = propose(problem);
  REQUIRE(proposal);
  const rigor::UpwardRounding upward;
  constexpr std::int64_t kCells = 30'000;
  const auto verified = [&](const dft_block::LateStage& stage) {
    const auto frame = dft_block::LockFrame::make(problem, proposal->set.with(stage));
    return frame && frame->verify(stage, kCells);
  };
  CHECK(verified(proposal->stage));
  const auto with = [&](auto change) {
    dft_block::LateStage stage = proposal->stage;
    change(stage);
    return stage;
  };
  using Stage = dft_block::LateStage;
  CHECK_FALSE(verified(with([](Stage& stage) { stage.excess *= 0.8; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.reference *= 0.9; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.noise *= 0.8; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.noise(0, 1) += 0.01; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.errors = dft_block::ErrorSet::ball(0.4); })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.errors.limits(1) = NAN; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.next_above = 1.0; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.next_below = 1.0; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.next_above = stage.above; })));
  CHECK_FALSE(verified(with([](Stage& stage) { stage.noise_weight = -stage.noise_weight; })));
}

TEST_CASE("bounds over time never rise, end at that of the long run, and begin with the rate alone") {
  const dft_block::LockProblem problem = lock_problem(-0.02, 0.02, kNoise, kSlew);
  const auto proposal = propose(problem);
  REQUIRE(proposal);
  const rigor::UpwardRounding upward;
  const auto frame = dft_block::LockFrame::make(problem, proposal->set);
  REQUIRE(frame);
  const auto timeline_with = [&](const std::vector<dft_block::LateStage>& stages) {
    return dft_block::timeline_of(*frame, proposal->set, proposal->rate, stages, Interval(0.25));
  };
  const dft_block::Timeline alone = timeline_with({});
  const dft_block::Timeline both = timeline_with({proposal->stage});
  CHECK(both.ultimate.upper() < 0.5 * alone.ultimate.upper());
  CHECK(both.offset_error.front().upper() == alone.offset_error.front().upper());
  CHECK(both.offset_error.back().upper() == both.ultimate.upper());
  CHECK(std::ranges::is_sorted(both.offset_error, std::greater{}, &Interval::upper));
  // One that errors do not come to is not used.
  dft_block::LateStage far = proposal->stage;
  far.errors = dft_block::ErrorSet::ball(1e-6);
  CHECK(timeline_with({far}).ultimate.upper() == alone.ultimate.upper());
}

TEST_CASE("covariances approach the bounds of a stage by the factor of a block") {
  dft_block::LateStage stage;
  stage.above = 1.2;
  stage.next_above = 1.1;
  stage.below = 1.2;
  stage.next_below = 1.0;
  const rigor::UpwardRounding upward;
  CHECK(dft_block::blocks_to_approach(1.2, 1.1, stage) == 0);
  // 1.3 (1.1/1.2) < 1.2; 2 (1/1.2)^3 < 1.2 < 2 (1/1.2)^2.
  CHECK(dft_block::blocks_to_approach(1.3, 1.1, stage) == 1);
  CHECK(dft_block::blocks_to_approach(1.3, 2.0, stage) == 3);
  stage.next_above = stage.above;
  CHECK(dft_block::blocks_to_approach(1.3, 1.1, stage) == -1);
}

}  // namespace

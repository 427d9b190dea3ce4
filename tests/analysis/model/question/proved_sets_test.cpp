#include "analysis/model/question/proved_sets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr double kAssumedNoise = 0.01;
constexpr double kDeviationOfW = 0.0002;
constexpr double kDeviationOfTheta = 0.004;

/// For noise and starts that are well inside its set, and all there is to ask without a slew.
SetQuestion thorough_question(const test::Example& loop) {
  SetQuestion question{.tone = test::tone_of(loop.tracker), .tracker = loop.model};
  question.band = {0.3, 0.3002, {}};
  question.noise = kAssumedNoise;
  question.deviations = {Interval(kDeviationOfW), Interval(kDeviationOfTheta)};
  question.assumes_start = true;
  question.largest_noise = true;
  question.is_thorough = true;
  return question;
}

/// Proved once.
struct ThoroughSets {
  test::Example loop{test::phase_locked_loop()};
  std::vector<double> shares;
  ProvedSets sets = prove_sets(thorough_question(loop), [this](double share) { shares.push_back(share); });
};
const ThoroughSets& thorough() {
  static const ThoroughSets made;
  return made;
}

/// Runs of the loop w' = w + ki e, theta' = theta + w + kp e, e = -y sin theta, in long double, from starts
/// off the steady state: the largest |w - omega| over all samples, and over the last of them.
std::array<long double, 2> largest_errors(const test::ExampleTracker& loop, const SearchedBand& band) {
  constexpr int kSamples = 3000;
  test::Random random(17);
  std::array<long double, 2> largest{};
  for (int run = 0; run < 40; ++run) {
    const long double omega = random.uniform(band.low, band.high);
    long double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    long double w = omega;
    long double theta = phase;
    for (int k = 0; k < 2 * kSamples; ++k) {
      if (k == kSamples) {  // settled, without noise: now it starts
        w += random.below(2) == 0 ? kDeviationOfW : -kDeviationOfW;
        theta += random.below(2) == 0 ? kDeviationOfTheta : -kDeviationOfTheta;
      }
      if (k >= kSamples) {
        largest[0] = std::max(largest[0], std::fabs(w - omega));
      }
      phase += omega;
      const long double noise = k < kSamples ? 0.0L : random.below(2) == 0 ? kAssumedNoise : -kAssumedNoise;
      const long double e = -(std::cos(phase) + noise) * std::sin(theta);
      theta += w + static_cast<long double>(loop.constants[1]) * e;
      w += static_cast<long double>(loop.constants[0]) * e;
    }
    largest[1] = std::max(largest[1], std::fabs(w - omega));
  }
  return largest;
}

TEST_CASE("runs from the assumed starts, with the assumed noise, are within what is proved") {
  const ProvedSets& sets = thorough().sets;
  CHECK(std::is_sorted(thorough().shares.begin(), thorough().shares.end()));
  CHECK(thorough().shares.back() == 1.0);
  REQUIRE(sets.assumed.has_value());
  REQUIRE(sets.assumed->is_proved());
  REQUIRE(sets.starts.is_proved());
  REQUIRE(sets.assumed->start_share <= 1.0);
  CHECK_FALSE(sets.slew.has_value());
  CHECK_FALSE(sets.long_run.has_value());
  REQUIRE_FALSE(sets.slices.empty());
  CHECK(sets.slices.front().low <= 0.3);
  CHECK(sets.slices.back().high >= 0.3002);
  const auto [ever, late] = largest_errors(thorough().loop.tracker, {0.3, 0.3002, {}});
  CHECK(ever <= sets.assumed->frequency_error);
  CHECK(late <= sets.assumed->settled_error);
  CHECK(ever > 0.05 * sets.assumed->frequency_error);
}

TEST_CASE("a thorough question has the largest noise, of each cell too, and an estimate to first order") {
  const ProvedSets& sets = thorough().sets;
  REQUIRE(sets.noise.has_value());
  CHECK(sets.noise->tubes.noise > kAssumedNoise);
  CHECK(sets.noise->tubes.tubes.front().own_noise >= sets.noise->tubes.noise);
  REQUIRE(sets.linear.has_value());
  CHECK(sets.linear->disturbed > 0.0);
  CHECK(sets.linear->disturbed < settled_error_of(sets));
}

TEST_CASE("a required error decides at which level a set begins") {
  const ProvedSet& without = thorough().sets.deciding();
  SetQuestion question = thorough_question(thorough().loop);
  question.largest_noise = question.is_thorough = false;
  const double between = 0.5 * (without.frequency_error + without.settled_error);
  question.required_error = Interval(between);
  const ProvedSets sets = prove_sets(question);
  CHECK(sets.deciding().is_proved());
  CHECK(sets.deciding().frequency_error < between);
  CHECK(without.frequency_error > between);
  CHECK_FALSE(sets.noise.has_value());
  CHECK_FALSE(sets.linear.has_value());
}

TEST_CASE("without disturbances the set for starts decides; the long run is that of the innermost set") {
  ProvedSets sets;
  CHECK(&sets.deciding() == &sets.starts);
  CHECK(settled_error_of(sets) == INFINITY);
  sets.assumed.emplace().settled_error = 0.25;
  CHECK(&sets.deciding() == &*sets.assumed);
  CHECK(settled_error_of(sets) == 0.25);
  sets.long_run.emplace().settled_error = 0.125;
  CHECK(&sets.deciding() == &*sets.assumed);
  CHECK(settled_error_of(sets) == 0.125);
}

}  // namespace
}  // namespace veritrack::model

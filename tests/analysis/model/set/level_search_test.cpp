#include "analysis/model/set/level_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model::detail {
namespace {

/// A loop, and its proposal about 0.3 rad/sample.
struct ProposedLoop {
  test::Example loop{test::phase_locked_loop()};
  TubeProposal proposal;

  ProposedLoop() {
    TubeSettings settings;
    settings.shape.objective = ShapeObjective::largest_noise;
    settings.largest_curve_error = 1e-7;
    proposal = propose_tube(test::tone_of(loop.tracker), 0.3, 0.005, settings);
    REQUIRE(proposal.tube.has_value());
  }
  ProposedLoop(const ProposedLoop&) = delete;
  ProposedLoop& operator=(const ProposedLoop&) = delete;
  ProposedLoop(ProposedLoop&&) = delete;
  ProposedLoop& operator=(ProposedLoop&&) = delete;
  ~ProposedLoop() = default;

  /// The longest step from the rim of a level, over it, at random places in floating point.
  [[nodiscard]] double longest_step(const Tube& tube, double radius, double noise) const {
    const test::PointTube points(tube);
    test::Random random(70);
    double longest = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
      const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double omega = random.uniform(points.low(), points.high());
      const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
      const Eigen::VectorXd state =
          points.curve(phase, omega) +
          radius * points.shape(phase, omega) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const double sample = std::cos(phase + omega) + (random.below(2) == 0 ? noise : -noise);
      longest = std::max(longest,
                         points.level(test::next_state(loop.tracker, state, sample), phase + omega, omega));
    }
    return longest / radius;
  }
};

const ProposedLoop& proposed_loop() {
  static const ProposedLoop made;
  return made;
}

TEST_CASE("levels for a noise: no sampled step is longer than what shrinks, from any level") {
  const auto& [loop, proposal] = std::tie(proposed_loop().loop, proposed_loop().proposal);
  const double noise = 0.4 * proposal.worth.noise;
  SetTask task;
  task.noise = noise;
  const auto found = LevelSearch(loop.model, proposal, task).with_noise(noise);
  REQUIRE(found.has_value());
  REQUIRE(found->levels.size() > 1);
  REQUIRE(found->shrinking.size() + 1 == found->levels.size());
  for (std::size_t j = 0; j < found->shrinking.size(); ++j) {
    CHECK(found->levels[j + 1] < found->levels[j]);
    CHECK(found->shrinking[j] < 1.0);
    for (const double share : {0.0, 0.5, 1.0}) {
      const double radius = found->levels[j + 1] + share * (found->levels[j] - found->levels[j + 1]);
      CHECK(proposed_loop().longest_step(found->tube, radius, noise) <= found->shrinking[j]);
    }
  }
  // Not far above the first level steps are too long.
  CHECK(proposed_loop().longest_step(found->tube, 2.0 * found->levels.front(), noise) > 1.0);
  CHECK_FALSE(LevelSearch(loop.model, proposal, task).with_noise(4.0 * proposal.worth.noise).has_value());
}

TEST_CASE("the largest noise is near the guess, at most what is asked, and sampled steps stay inside") {
  const auto& [loop, proposal] = std::tie(proposed_loop().loop, proposed_loop().proposal);
  SetTask task;
  task.largest_noise = true;
  const auto most = LevelSearch(loop.model, proposal, task).with_largest_noise(INFINITY);
  REQUIRE(most.has_value());
  const auto& [proved, noise] = *most;
  CHECK(noise > 0.8 * proposal.worth.noise);
  CHECK(noise < 1.5 * proposal.worth.noise);
  CHECK(proposed_loop().longest_step(proved.tube, proved.levels.front(), noise) <= 1.0);
  CHECK(proposed_loop().longest_step(proved.tube, proved.levels.front(), 3.0 * noise) > 1.0);
  const double little = 0.25 * proposal.worth.noise;
  const auto limited = LevelSearch(loop.model, proposal, task).with_largest_noise(little);
  REQUIRE(limited.has_value());
  CHECK(limited->second <= little);
  CHECK(limited->second > 0.5 * little);
}

TEST_CASE("the search begins at the proposed level, less where errors were larger than the frequency") {
  const test::Example& loop = proposed_loop().loop;
  TubeProposal proposal = proposed_loop().proposal;
  const SetTask task;
  CHECK(LevelSearch(loop.model, proposal, task).guess() == proposal.worth.level);
  proposal.worth.reach = 4.0 * proposal.frequency;
  CHECK(LevelSearch(loop.model, proposal, task).guess() == doctest::Approx(0.25 * proposal.worth.level));
  SetTask late;
  late.deadline = search::Deadline(0.0);
  CHECK_FALSE(LevelSearch(loop.model, proposal, late).with_noise(0.0).has_value());
}

}  // namespace
}  // namespace veritrack::model::detail

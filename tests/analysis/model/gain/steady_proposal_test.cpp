#include "analysis/model/gain/steady_proposal.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/gain_attack.hpp"
#include "analysis/model/gain/gain_bounds.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

const ProposedVector kSamples{0, 1, 1};

std::vector<SteadyValue> proposed(const test::TwoChannelExample& loop, const ProposedVector& vector) {
  const rigor::UpwardRounding upward;
  return proposed_steady_state(loop.model, loop.tone.start, -1.0, 1.0, vector).value();
}

TEST_CASE("pairs of states that are no angles may be vectors, with two channels") {
  const test::TwoChannelExample turn(test::turn_between_samples(0.2));
  CHECK(possible_vectors(turn.model).size() ==
        24);  // ordered pairs of three, turning or not, with a length or not
  const test::TwoChannelExample loop(test::two_channel_loop(0.2, 0.01, test::Detector::sine));
  CHECK(possible_vectors(loop.model).empty());
}

TEST_CASE("a copy of the samples is a vector that turns with the signal") {
  const test::TwoChannelExample loop(test::turn_between_samples(0.2, 2.5));
  const std::vector<SteadyValue> steady = proposed(loop, kSamples);
  REQUIRE(steady.size() == 3);
  CHECK(steady[0].imaginary == 1);
  CHECK(steady[0].turns == 1);
  CHECK(steady[0].constant == 0.0);
  CHECK(std::fabs(steady[0].per_frequency) < 1e-12);
  CHECK(steady[2].per_frequency == 1.0);
  const auto vector = vector_of(steady);
  REQUIRE(vector.has_value());
  CHECK(vector->real == 0);
  CHECK(vector->imaginary == 1);
  // The state, by its formula.
  const rigor::NearestRounding nearest;
  const Eigen::VectorXd state = state_at(loop.tone, steady, 0.7, 0.3);
  CHECK((state - Eigen::Vector3d(2.5 * std::cos(0.7), 2.5 * std::sin(0.7), 0.3)).norm() < 1e-12);
  const Eigen::VectorXd change = state_per_frequency(loop.tone, steady, 0.7, 0.3);
  CHECK((change - Eigen::Vector3d(0.0, 0.0, 1.0)).norm() < 1e-9);
}

TEST_CASE("the length of a vector is known where it matters") {
  const test::TwoChannelExample loop(test::turn_between_samples(0.2, 2.5));
  const std::vector<SteadyValue> steady = proposed(loop, {0, 1, 1, true});
  REQUIRE(steady.size() == 3);
  CHECK(steady[1].constant == doctest::Approx(2.5));
  CHECK(std::fabs(steady[1].per_frequency) < 1e-9);
  CHECK(has_length(steady[0], steady));
  CHECK(vector_of(steady)->has_length);
  const rigor::NearestRounding nearest;
  const Eigen::VectorXd state = state_at(loop.tone, steady, 0.7, 0.3);
  CHECK((state - Eigen::Vector3d(2.5 * std::cos(0.7), 2.5 * std::sin(0.7), 0.3)).norm() < 1e-9);
}

TEST_CASE(
    "without a vector, with its parts exchanged, or at rest the loop has no steady state of this form") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::turn_between_samples(0.2));
  const auto is_none = [&](const std::optional<ProposedVector>& vector) {
    try {
      const auto steady = proposed_steady_state(loop.model, loop.tone.start, -1.0, 1.0, vector);
      return !steady;
    } catch (const NoFrame&) {
      return true;
    }
  };
  CHECK(is_none(std::nullopt));
  CHECK(is_none(ProposedVector{1, 0, 1}));
  CHECK(is_none(ProposedVector{0, 1, 0}));
  CHECK(is_none(ProposedVector{0, 2, 1}));
  CHECK_FALSE(is_none(kSamples));
}

TEST_CASE("a loop with a vector: its matrix on paper, and bounds that noise reaches") {
  const test::TwoChannelExample loop(test::turn_between_samples(0.2));
  const std::vector<SteadyValue> steady = proposed(loop, kSamples);
  const rigor::UpwardRounding upward;
  const LoopNetwork network = loop_network(loop.model, steady, Interval::from_bounds(-1.0, 1.0));
  const auto is = [](const Interval& x, double value) {
    return rigor::magnitude(x - Interval(value)) < 1e-12;
  };
  for (std::size_t j = 0; j < 3; ++j) {
    CHECK(network.a[0][j] == Interval(0.0));  // the next direction is that of the sample
    CHECK(network.a[1][j] == Interval(0.0));
  }
  CHECK(is(network.a[2][0], -0.2));
  CHECK(is(network.a[2][1], 0.0));
  CHECK(is(network.a[2][2], 0.8));
  const auto gains = GainBounds::make(network, 256, 64);
  REQUIRE(gains.has_value());
  for (const double noise : {0.02, 0.3, 0.8}) {
    const auto bounds = gains->bounds({noise, 0.0, {}});
    REQUIRE(bounds.has_value());
    // The turn is off by two angles of noise, and the second comes back at the next sample.
    const double angle = std::asin(noise);
    CHECK(bounds->long_run <= 0.4 * angle * (1.0 + 1e-6));
    for (const double omega : {-0.7, 0.0, 0.3}) {
      const double reached = attack_loop(loop.tone, steady, omega, noise, 0.0, 256);
      CHECK(reached <= bounds->for_ever * (1.0 + 1e-11));
      CHECK(reached >= 0.95 * bounds->long_run);
    }
  }
  CHECK_FALSE(gains->bounds({std::sin(0.5 * (std::acos(-1.0) - 1.0)) + 1e-3, 0.0, {}}).has_value());
}

}  // namespace
}  // namespace veritrack::model

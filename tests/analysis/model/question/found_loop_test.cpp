#include "analysis/model/question/found_loop.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

SetQuestion asked_over(const test::TwoChannelExample& loop, double low, double high) {
  SetQuestion question{.tone = loop.tone, .tracker = loop.model};
  question.whole_band = Interval::from_bounds(low, high);
  return question;
}

Eigen::MatrixXd middle_of(const std::vector<linear::Row>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      matrix(i, j) = rigor::midpoint(rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  return matrix;
}

bool is_turned_by(double constant, double angle) {
  return std::fabs(std::remainder(constant - angle, 2.0 * std::numbers::pi)) < 1e-9;
}

TEST_CASE("from any start the stable one of both steady states of a multiplier is found, with its matrix") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  Eigen::Matrix2d expected;
  expected << 0.95, 1.0, -0.001, 1.0;  // theta' = theta + w - kp theta, w' = w - ki theta
  for (const double off : {0.0, 0.3, std::numbers::pi, -2.9, 1.5}) {
    CAPTURE(off);
    SetQuestion question = asked_over(loop, -0.5, 0.5);
    question.tone.start = [off](double omega) { return std::vector<double>{omega + off, omega}; };
    const auto found = find_loop(question);
    REQUIRE(found.has_value());
    CHECK(found->steady[0].turns == 1);
    CHECK(is_turned_by(found->steady[0].constant, 0.0));
    CHECK(found->steady[0].per_frequency == doctest::Approx(1.0));
    CHECK(std::fabs(found->steady[1].constant) < 1e-9);
    CHECK((middle_of(found->network.a) - expected).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("of a loop that a simulation does not bring away from rest the state half a turn on is tried") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(2e-4, 1e-8, Detector::sine));
  SetQuestion question = asked_over(loop, 0.1, 0.2);
  question.tone.start = [](double omega) { return std::vector<double>{omega + std::numbers::pi, omega}; };
  const auto found = find_loop(question);
  REQUIRE(found.has_value());
  CHECK(is_turned_by(found->steady[0].constant, 0.0));
}

TEST_CASE("where errors decay at neither, the steady state next to the start is given") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(2.1, 0.03, Detector::sine));
  for (const double off : {0.0, std::numbers::pi}) {
    SetQuestion question = asked_over(loop, 0.1, 0.2);
    question.tone.start = [off](double omega) { return std::vector<double>{omega + off, omega}; };
    const auto found = find_loop(question);
    REQUIRE(found.has_value());
    CHECK(is_turned_by(found->steady[0].constant, off));
    Eigen::Matrix2d expected;
    const double sign = off == 0.0 ? 1.0 : -1.0;
    expected << 1.0 - sign * 2.1, 1.0, -sign * 0.03, 1.0;
    CHECK((middle_of(found->network.a) - expected).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(oracle::spectral_radius(expected) > 1.0);
  }
}

TEST_CASE("the network depends on the band, also where that is one frequency") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::arctangent2));
  for (const auto& [low, high] : {std::pair(0.3, 0.3), std::pair(-1.0, 2.0)}) {
    const auto found = find_loop(asked_over(loop, low, high));
    REQUIRE(found.has_value());
    CHECK(found->steady[1].per_frequency == doctest::Approx(1.0));
    CHECK(rigor::contains(found->network.bias, 0.0));
    CHECK(rigor::magnitude(found->network.bias) < 1e-9);
  }
}

TEST_CASE("two states of which the direction alone matters are a vector, unless a start is assumed off") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::turn_between_samples(0.2, 2.5));
  SetQuestion question = asked_over(loop, -1.0, 1.0);
  const auto plain = find_loop(question);
  REQUIRE(plain.has_value());
  CHECK(plain->steady[0].imaginary == 1);
  CHECK_FALSE(has_length(plain->steady[0], plain->steady));
  // The last sample is forgotten: w' = 0.8 w + 0.2 (angle now - angle before).
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected.row(2) << -0.2, 0.0, 0.8;
  CHECK((middle_of(plain->network.a) - expected).cwiseAbs().maxCoeff() < 1e-9);

  question.deviations = {Interval(0.0), Interval(0.1), Interval(0.0)};
  CHECK(find_loop(question).has_value());  // deviations alone are no assumption
  question.assumes_start = true;
  question.deviations = {Interval(0.0), Interval(0.0), Interval(0.1)};
  CHECK(find_loop(question)->steady[0].imaginary == 1);
  for (const std::size_t off : {0U, 1U}) {
    question.deviations.assign(3, Interval(0.0));
    question.deviations[off] = Interval(0.1);
    CHECK_THROWS_AS((void)find_loop(question), NoFrame);
  }
}

TEST_CASE("a steady state as far off as a false lock is no lock, and the message says how far") {
  const rigor::UpwardRounding upward;
  test::ExampleTracker biased = test::two_channel_loop(0.05, 0.001, Detector::sine);
  trackers::StraightLineProgram frequency(4);
  frequency.add_result(frequency.append(trackers::Operation::negate, 3));  // -w
  biased.recursion.frequency = frequency;
  const test::TwoChannelExample loop(std::move(biased));
  // Off by 2 omega, where a false lock may be off by 2 pi.
  CHECK(find_loop(asked_over(loop, 0.1, 0.2)).has_value());
  try {
    (void)find_loop(asked_over(loop, 0.1, 3.0));
    FAIL("found");
  } catch (const NoFrame& reason) {
    CHECK(std::string(reason.what()).find("off by 6 rad/sample") != std::string::npos);
  }
}

TEST_CASE("where the rules do not cover a loop that is said") {
  const rigor::UpwardRounding upward;
  test::ExampleTracker plain = test::two_channel_loop(0.05, 0.001, Detector::sine);
  trackers::StraightLineProgram step(6);
  step.add_result(step.append(trackers::Operation::multiply, 4, 5));  // y1 y2 turns twice with the signal
  step.add_result(3);
  plain.recursion.step = step;
  const test::TwoChannelExample loop(std::move(plain));
  CHECK_THROWS_AS((void)find_loop(asked_over(loop, 0.1, 0.2)), NoFrame);
}

}  // namespace
}  // namespace veritrack::model

#include "papers/single_channel/published_examples.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "trackers/signals/random.hpp"

namespace veritrack::single_channel {
namespace {

const ExampleStart kTruth = example_starts().at(3);

TEST_CASE("the signals are those of the paper") {
  const ExampleRun one =
      run_example({Example::one, ProcessNoiseReading::identity, 0.005, 0.01, 0.0, kTruth}, 1);
  REQUIRE(one.frequency.size() == 1000);
  CHECK(one.completed);
  CHECK(one.true_frequency[299] == std::numbers::pi / 6.0);
  CHECK(one.true_frequency[499] == doctest::Approx(std::numbers::pi * (1.0 / 6.0 + 0.25)));
  CHECK(one.true_frequency[700] == 2.0 * std::numbers::pi / 3.0);
  const ExampleRun two = run_example({Example::two, ProcessNoiseReading::identity, 1.0, 1.0, 0.0, kTruth}, 1);
  CHECK(two.true_frequency[499] == std::numbers::pi / 6.0);
  CHECK(two.true_frequency[500] == 2.0 * std::numbers::pi / 3.0);
}

TEST_CASE("an innovation variance of exactly zero ends a run") {
  const ExampleRun run = run_example(
      {Example::two, ProcessNoiseReading::frequency_only, 1.0, 0.0, 0.0, {"", 0.0, 0.0, 0.0, 0.0}}, 1);
  CHECK_FALSE(run.completed);
  CHECK(run.frequency.empty());
}

TEST_CASE("with q diag(1, 1, 1) the tracker locks, with the leak's bias; with q diag(0, 0, 1) it does not") {
  const auto leaking =
      summarize_runs({Example::one, ProcessNoiseReading::identity, 0.005, 0.01, 0.05, kTruth}, 20);
  int locked = 0;
  for (const RunSummary& run : leaking) {
    locked += run.first.locked && run.last.locked ? 1 : 0;
    // Noise moves the mean a little off the noise-free bias, -0.0797 and -0.248 rad/sample.
    if (run.first.locked) {
      CHECK(run.first.mean_error == doctest::Approx(-0.08).epsilon(0.25));
    }
    if (run.last.locked) {
      CHECK(run.last.mean_error == doctest::Approx(-0.248).epsilon(0.1));
    }
  }
  CHECK(locked >= 15);
  for (const RunSummary& run :
       summarize_runs({Example::one, ProcessNoiseReading::frequency_only, 0.005, 0.01, 0.0, kTruth}, 20)) {
    CHECK_FALSE(run.first.locked);
    CHECK(run.first.near_zero);
  }
}

/// The oracle: the paper's (2a) with matrices, F(t) at x(t-1|t-1).
TEST_CASE("F as printed is one sample late: the run is that of the printed recursion") {
  const ExampleSetting setting{Example::one, ProcessNoiseReading::identity, 0.005, 0.01, 0.05,
                               kTruth,       LinearizationPoint::as_printed};
  const ExampleRun run = run_example(setting, 3);
  const auto transition = [](const Eigen::Vector3d& x) {
    Eigen::Matrix3d f;
    f << std::cos(x[2]), -std::sin(x[2]), -std::sin(x[2]) * x[0] - std::cos(x[2]) * x[1],  //
        std::sin(x[2]), std::cos(x[2]), std::cos(x[2]) * x[0] - std::sin(x[2]) * x[1],     //
        0.0, 0.0, 0.95;
    return f;
  };
  trackers::RandomStream random(3);
  Eigen::Vector3d x(kTruth.in_phase, kTruth.quadrature, kTruth.frequency);
  Eigen::Vector3d before = x;
  // P(1) from P(0|0); then P(t+1) from P(t).
  Eigen::Matrix3d p = transition(x) * transition(x).transpose() + 0.005 * Eigen::Matrix3d::Identity();
  double phase = 0.0;
  for (std::size_t t = 1; t <= 60; ++t) {
    phase += run.true_frequency[t - 1];
    const double y = std::cos(phase) + 0.1 * random.normal();
    const Eigen::Vector3d predicted(std::cos(x[2]) * x[0] - std::sin(x[2]) * x[1],
                                    std::sin(x[2]) * x[0] + std::cos(x[2]) * x[1], 0.95 * x[2]);
    const Eigen::Vector3d gain = p.col(0) / (p(0, 0) + 0.01);
    before = x;
    x = predicted + gain * (y - predicted[0]);
    const Eigen::Matrix3d filtered = p - gain * p.row(0);
    p = transition(before) * filtered * transition(before).transpose() + 0.005 * Eigen::Matrix3d::Identity();
    CAPTURE(t);
    CHECK(run.frequency[t - 1] == doctest::Approx(x[2]).epsilon(1e-6));
  }
}

TEST_CASE("with F as printed no run locks on both frequencies of Example 1, for either Q") {
  for (const ExampleStart& start : example_starts()) {
    CAPTURE(start.words);
    for (const auto reading : {ProcessNoiseReading::frequency_only, ProcessNoiseReading::identity}) {
      CHECK(locked_runs(reading, 0.0, start, LinearizationPoint::as_printed, 20) == 0);
    }
  }
  CHECK(locked_runs(ProcessNoiseReading::identity, 0.0, kTruth, LinearizationPoint::latest_estimate, 20) >=
        15);
}

TEST_CASE("rates are shares, the same whatever the number of threads") {
  const auto many = statement_rates(ProcessNoiseReading::identity, kTruth, 10);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto one = statement_rates(ProcessNoiseReading::identity, kTruth, 10);
  REQUIRE(many.size() == one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(many[i].rate == one[i].rate);
    CHECK(many[i].rate >= 0.0);
    CHECK(many[i].rate <= 1.0);
  }
}

}  // namespace
}  // namespace veritrack::single_channel

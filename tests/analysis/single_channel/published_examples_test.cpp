#include "analysis/single_channel/published_examples.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

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

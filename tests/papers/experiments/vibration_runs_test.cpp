#include "papers/experiments/vibration_runs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace veritrack::experiments {
namespace {

TEST_CASE("the ideal controller has the vibration's pole, also with surplus parameters") {
  for (const VibrationOrder order : {VibrationOrder::three, VibrationOrder::five}) {
    CHECK(pole_error(ideal_parameters(order)) < 1e-15);
    Eigen::VectorXd other = ideal_parameters(order);
    other(other.size() / 2 + 1) += 0.1;
    CHECK(pole_error(other) > 1e-3);
  }
}

TEST_CASE("started at the ideal parameters, EFRA drives the output to zero and keeps the vibration's pole") {
  const VibrationStart start{1.0, 0.5, 1.0, ideal_parameters(VibrationOrder::three)};
  const VibrationRun run = vibration_run(VibrationOrder::three, Estimator::efra, start, 600);
  REQUIRE(run.output.size() == 600);
  CHECK(pole_error(run.parameters.back()) < 1e-6);
  CHECK(std::fabs(run.output.back()) < 1e-6);
}

TEST_CASE("the monitored estimator, too, takes the output down, but slowly") {
  const VibrationStart start{1.0, 0.5, 1.0, ideal_parameters(VibrationOrder::three)};
  const VibrationRun run = vibration_run(VibrationOrder::three, Estimator::monitored, start, 3000, 1e9);
  const auto largest = [&](std::size_t first) {
    double result = 0.0;
    for (std::size_t k = first; k < first + 100; ++k) {
      result = std::max(result, std::fabs(run.output[k]));
    }
    return result;
  };
  CHECK(largest(2900) < 0.5 * largest(0));
}

TEST_CASE("limits are the last parameters of the run, and starts are reproducible") {
  for (const FirstGuess guess : {FirstGuess::nothing, FirstGuess::near_ideal}) {
    const VibrationStart start = drawn_start(VibrationOrder::five, guess, 3);
    CHECK(start.parameters == drawn_start(VibrationOrder::five, guess, 3).parameters);
    CHECK(start.parameters.size() == 10);
    CHECK(start.parameters(5) != 0.0);
    const VibrationRun run = vibration_run(VibrationOrder::five, Estimator::efra, start, 100);
    CHECK(limiting_parameters(VibrationOrder::five, Estimator::efra, start, 100) == run.parameters.back());
  }
}

}  // namespace
}  // namespace veritrack::experiments

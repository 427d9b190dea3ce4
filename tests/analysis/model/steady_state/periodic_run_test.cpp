#include "analysis/model/steady_state/periodic_run.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model::detail {
namespace {

constexpr double kWhole = 2.0 * std::numbers::pi;

TEST_CASE("a fraction is near its frequency, and shares no small factor with short repetitions") {
  for (const double frequency : {1e-4, 0.01, 0.3, 1.0, 2.0, 3.1}) {
    const Fraction fraction = nearby_fraction(frequency);
    CHECK(std::gcd(fraction.turns, fraction.samples) == 1);
    CHECK(std::gcd(fraction.turns, 30) == 1);
    CHECK(std::gcd(fraction.samples, 30) == 1);
    CHECK(fraction.samples >= 301);
    const double exact = kWhole * fraction.turns / fraction.samples;
    CHECK(std::fabs(exact - frequency) < 0.02 * frequency);
    // At least as near as every other such fraction with about as many samples.
    for (int q = 301; frequency > 0.1 && q <= 1204; ++q) {
      const int p = static_cast<int>(std::lround(frequency * q / kWhole));
      if (std::gcd(p, 30) == 1 && std::gcd(q, 30) == 1 && std::gcd(p, q) == 1) {
        CHECK(std::fabs(exact - frequency) <= std::fabs(kWhole * p / q - frequency) + 1e-12);
      }
    }
  }
}

/// The loop by its formula, from (w, theta), for `samples` samples: all states.
std::vector<std::pair<double, double>> run_by_formula(const test::ExampleTracker& loop,
                                                      const Fraction& fraction, double w, double theta,
                                                      int samples) {
  std::vector<std::pair<double, double>> states{{w, theta}};
  for (int k = 1; k <= samples; ++k) {
    const double e = -std::cos(kWhole * fraction.turns * k / fraction.samples) * std::sin(theta);
    theta += w + loop.constants[1] * e;
    w += loop.constants[0] * e;
    states.emplace_back(w, theta);
  }
  return states;
}

TEST_CASE("period after period, the states of a loop, its mean frequency, and its turns") {
  const test::ExampleTracker loop = test::phase_locked_loop();
  const TrackedTone tone = test::tone_of(loop);
  const Fraction fraction = nearby_fraction(0.3);
  const int q = fraction.samples;
  PeriodicRun run(tone, fraction, {0.31, 0.5});
  History history;
  history.add(run);
  CHECK_FALSE(history.reaches(1));
  const auto expected = run_by_formula(loop, fraction, 0.31, 0.5, 2 * q);
  double turned = 0.0;
  for (int period = 0; period < 2; ++period) {
    turned = run.wound()[1];
    run.run();
    history.add(run);
    REQUIRE(run.states().cols() == q + 1);
    double mean = 0.0;
    for (int k = 0; k <= q; ++k) {
      const auto& [w, theta] = expected[static_cast<std::size_t>(period * q + k)];
      CHECK(std::fabs(run.states()(0, k) - w) < 1e-9);
      CHECK(std::fabs(run.states()(1, k) + kWhole * turned - theta) < 1e-9);
      mean += k > 0 ? w / q : 0.0;
    }
    CHECK(run.mean_frequency() == doctest::Approx(mean));
  }
  CHECK(std::fabs(run.wrapped()[1]) <= 0.5 * kWhole + 1e-9);
  CHECK(run.wound()[0] == 0.0);
  REQUIRE(history.reaches(2));
  CHECK_FALSE(history.reaches(3));
  const auto& [first, middle, last] =
      std::tie(expected[0], expected[static_cast<std::size_t>(q)], expected.back());
  const Eigen::VectorXd change = history.change(1, loop.recursion.is_angle);
  CHECK(std::fabs(change[0] - (last.first - middle.first)) < 1e-9);
  CHECK(std::fabs(change[1] - std::remainder(last.second - middle.second, kWhole)) < 1e-9);
  CHECK(history.turns(2)[1] == std::round((last.second - first.second) / kWhole));
  CHECK(history.turns(1)[1] == std::round((last.second - middle.second) / kWhole));
}

TEST_CASE("sorted by phase, states less their turns are a function of the phase") {
  // An accumulator theta' = theta + w that starts at w = 2 pi p/q has theta = phi + 1/2.
  test::ExampleTracker loop = test::phase_locked_loop();
  loop.constants = {0.0, 0.0};
  const TrackedTone tone = test::tone_of(loop);
  const Fraction fraction = nearby_fraction(0.7);
  const double w = kWhole * fraction.turns / fraction.samples;
  PeriodicRun run(tone, fraction, {w, 0.5});
  run.run();
  const Eigen::MatrixXd sorted = sorted_states(run, fraction, {0, 1});
  REQUIRE(sorted.cols() == fraction.samples);
  CHECK((sorted.row(0).array() - w).abs().maxCoeff() < 1e-12);
  CHECK((sorted.row(1).array() - 0.5).abs().maxCoeff() < 1e-9);
  // Without the turns, the state at the phase 2 pi j/q is phi + 1/2 up to whole turns.
  const Eigen::MatrixXd plain = sorted_states(run, fraction, {0, 0});
  for (Eigen::Index j = 0; j < plain.cols(); ++j) {
    const double phase = kWhole * static_cast<double>(j) / fraction.samples;
    CHECK(std::fabs(std::remainder(plain(1, j) - 0.5 - phase, kWhole)) < 1e-9);
  }
}

}  // namespace
}  // namespace veritrack::model::detail

#include "analysis/model/gaussian/gaussian_drift.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "analysis/model/gaussian/gaussian_set.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/binomial.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Verdict;
using test::Example;

/// The largest (E[W(X+)] - c0)/W(X) at random states of a tube: the recursion in doubles and an integral over
/// the noise, which shares no code with the verification.
double largest_drift(const Example& example, const ProvedTube& proved, const GaussianTerms& terms,
                     double deviation, int trials) {
  const test::PointTube tube(proved.tube);
  const double radius = proved.levels.front();
  const auto weight = [&](double level) {
    return std::exp(terms.exponent * level * level / radius / radius);
  };
  test::Random random(17);
  double worst = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const double phase = random.uniform(0.0, 2.0 * M_PI);
    const double omega = random.uniform(tube.low(), tube.high());
    Eigen::VectorXd xi(static_cast<Eigen::Index>(proved.tube.curve.size()));
    for (double& component : xi) {
      component = random.uniform(-1.0, 1.0);
    }
    const double level = radius * std::sqrt(random.uniform(0.0, 1.0));
    const Eigen::VectorXd state =
        tube.curve(phase, omega) + level * tube.shape(phase, omega) * xi.normalized();
    double mean = 0.0;
    constexpr int kSteps = 400;
    constexpr double kLongest = 7.0;  // deviations
    for (int i = 0; i <= kSteps; ++i) {
      const double u = kLongest * (2.0 * i / kSteps - 1.0);
      const Eigen::VectorXd next =
          test::next_state(example.tracker, state, std::cos(phase + omega) + deviation * u);
      mean += std::exp(-0.5 * u * u) * weight(tube.level(next, phase + omega, omega));
    }
    mean *= 2.0 * kLongest / kSteps / std::sqrt(2.0 * M_PI);
    worst = std::max(worst, (mean - terms.constant) / weight(level));
  }
  return worst;
}

GaussianTask task_of(double deviation) {
  GaussianTask task;
  task.name = "gaussian";
  task.deviation = deviation;
  task.largest_deviation = deviation == 0.0;
  task.samples = 1e6;
  task.probability = 1e-6;
  return task;
}

TEST_CASE("a phase-locked loop: the drift that is proved is above the integral over the noise" *
          doctest::test_suite("nightly")) {
  const Example loop(test::phase_locked_loop());
  const TubeSet set = prove_gaussian_set(test::tone_of(loop.tracker), loop.model, 0.28, 0.32, task_of(0.0));
  REQUIRE(set.is_complete);
  REQUIRE(set.gaussian.has_value());
  const GaussianTerms terms = *set.gaussian;
  for (const ProvedTube& proved : set.tubes) {
    const double worst = largest_drift(loop, proved, terms, terms.deviation, 2000);
    CHECK(worst < terms.factor);
    CHECK(largest_drift(loop, proved, terms, 2.0 * terms.deviation, 2000) > 1.0);
    DriftQuestion more{proved.levels.front(), 1.3 * terms.deviation, terms.most_noise,
                       terms.exponent,        terms.factor,          terms.constant};
    CHECK(verify_drift(loop.model, proved.tube, more, {}).verdict == Verdict::undecided);
  }
  const rigor::UpwardRounding upward;
  CHECK(leaving_probability(terms, 1, rigor::Interval(1e6), 0.0) < 1e-6);
}

TEST_CASE("runs in as much noise as was proved leave the tube no more often than is said") {
  const Example loop(test::phase_locked_loop());
  GaussianTask task = task_of(0.0);
  task.samples = 1000.0;
  task.probability = 0.05;
  const TubeSet set = prove_gaussian_set(test::tone_of(loop.tracker), loop.model, 0.29, 0.31, task);
  REQUIRE(set.is_complete);
  const GaussianTerms& terms = *set.gaussian;
  test::Random random(31);
  const auto normal = [&] {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    return radius * std::cos(2.0 * M_PI * random.uniform());
  };
  const std::int64_t runs = test::effort(200);
  std::int64_t losses = 0;
  double largest = 0.0;
  for (std::int64_t run = 0; run < runs; ++run) {
    const ProvedTube& proved = set.tubes[static_cast<std::size_t>(random.below(set.tubes.size()))];
    const test::PointTube tube(proved.tube);
    const double omega = random.uniform(tube.low(), tube.high());
    double phase = random.uniform(0.0, 2.0 * M_PI);
    Eigen::VectorXd xi(2);
    xi << random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0);
    const double start = task.start_share * proved.levels.front();
    Eigen::VectorXd state = tube.curve(phase, omega) + start * tube.shape(phase, omega) * xi.normalized();
    bool is_in_lock = true;
    for (int k = 0; k < 1000 && is_in_lock; ++k) {
      phase += omega;
      state = test::next_state(loop.tracker, state, std::cos(phase) + terms.deviation * normal());
      const double share = tube.level(state, phase, omega) / proved.levels.front();
      largest = std::max(largest, share);
      is_in_lock = share <= 1.0;
    }
    losses += is_in_lock ? 0 : 1;
  }
  const rigor::UpwardRounding upward;
  const double bound = leaving_probability(terms, 1, rigor::Interval(1000.0), task.start_share);
  CHECK(bound < 0.051);
  CHECK(test::clopper_pearson(losses, runs, 1e-6).lower <= bound);
  CHECK(largest > 0.4);  // the noise is felt
}

TEST_CASE("nothing is concluded from questions that are none") {
  const Example loop(test::phase_locked_loop());
  const TubeSet set = prove_gaussian_set(test::tone_of(loop.tracker), loop.model, 0.29, 0.31, task_of(0.02));
  REQUIRE(set.is_complete);
  const ProvedTube& proved = set.tubes.front();
  const GaussianTerms& terms = *set.gaussian;
  const DriftQuestion good{proved.levels.front(), terms.deviation, terms.most_noise,
                           terms.exponent,        terms.factor,    terms.constant};
  CHECK(verify_drift(loop.model, proved.tube, good, {}).verdict == Verdict::proved);
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    for (double DriftQuestion::*member :
         {&DriftQuestion::radius, &DriftQuestion::deviation, &DriftQuestion::most_noise,
          &DriftQuestion::exponent, &DriftQuestion::factor, &DriftQuestion::constant}) {
      DriftQuestion question = good;
      question.*member = bad;
      CHECK(verify_drift(loop.model, proved.tube, question, {}).verdict == Verdict::undecided);
    }
  }
}

}  // namespace
}  // namespace veritrack::model

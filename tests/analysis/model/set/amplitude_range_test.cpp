// Signals whose amplitude is another one at each sample, within a range: what is proved of a step against
// steps at such amplitudes, in doubles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "analysis/model/gaussian/gaussian_drift.hpp"
#include "analysis/model/set/falsifier.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/model/steady_state/linear_worst_case.hpp"
#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::BallModel;
using rigor::Interval;
using test::Example;
using trackers::Operation;
using trackers::StraightLineProgram;

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

/// The amplitudes from 1 - deviation to 1 + deviation.
void spread(TrackerModel& model, double deviation) {
  model.amplitude = Interval::from_bounds(1.0 - deviation, 1.0 + deviation);
  model.amplitude_varies = true;
}

/// A cos(phi) + (A^2 cos(2 phi) + 1) times the second of the constants.
StraightLineProgram bent_signal(int constants) {
  StraightLineProgram program(constants + 2);
  const int phase = constants + 1;
  const int wave = program.append(Operation::multiply, constants, program.append(Operation::cos, phase));
  const int twice = program.append(Operation::add, phase, phase);
  const int squared = program.append(Operation::multiply, constants, constants);
  const int second = program.append(Operation::multiply, squared, program.append(Operation::cos, twice));
  const int share = program.append(Operation::multiply, second, 1);
  program.add_result(program.append(Operation::add, program.append(Operation::add, wave, share), 1));
  return program;
}

double value_of(const StraightLineProgram& signal, const std::vector<double>& constants, double amplitude,
                double phase) {
  std::vector<double> inputs = constants;
  inputs.insert(inputs.end(), {amplitude, phase});
  std::vector<double> registers;
  std::vector<double> values(1);
  signal.run(std::span<const double>(inputs), registers, std::span(values));
  return values.front();
}

Tube proposed(const Example& example, double half_width = 0.02) {
  TubeSettings settings;
  settings.shape.objective = ShapeObjective::largest_noise;
  settings.largest_curve_error = 1e-7;
  const TubeProposal proposal = propose_tube(test::tone_of(example.tracker), 0.3, half_width, settings);
  REQUIRE(proposal.tube.has_value());
  return *proposal.tube;
}

struct Shares {
  double smallest = INFINITY, largest = 0.0;  ///< of the bound, over cells: the worst step that was met
};

/// Steps from random places of random cells, with amplitudes and noise of which many are extreme.
Shares steps_over_bounds(const Example& example, const Tube& tube, double radius, double noise, double slew) {
  test::Random random(16);
  const test::PointTube points(tube);
  const double low = example.model.amplitude.lower();
  const double high = example.model.amplitude.upper();
  constexpr int kCells = 64;
  Shares shares;
  for (std::int64_t trial = 0; trial < test::effort(40); ++trial) {
    const TubeCell cell{(static_cast<double>(random.below(kCells)) + 0.5) / kCells, 0.5 / kCells,
                        random.below(2) == 0 ? -0.5 : 0.5, 0.5};
    const double bound = bound_step(example.model, tube, cell, radius, noise, {1.0}, slew).steps.front();
    REQUIRE(std::isfinite(bound));
    const rigor::NearestRounding nearest;
    double worst = 0.0;
    for (int i = 0; i < 400; ++i) {
      const double phase = kWholeTurn * (cell.turn + cell.half_turn * random.uniform(-1.0, 1.0));
      const double z = cell.z + cell.half_z * random.uniform(-1.0, 1.0);
      const double omega = tube.frequency + tube.half_width * z;
      Eigen::VectorXd xi(static_cast<Eigen::Index>(tube.curve.size()));
      for (double& component : xi) {
        component = random.uniform(-1.0, 1.0);
      }
      const Eigen::VectorXd state =
          points.curve(phase, omega) + radius * points.shape(phase, omega) * xi.normalized();
      const std::uint64_t kind = random.below(4);
      const double amplitude = kind == 0 ? low : kind == 1 ? high : random.uniform(low, high);
      const double error = noise * (random.below(2) == 0 ? 1.0 : random.uniform(-1.0, 1.0)) *
                           (random.below(2) == 0 ? 1.0 : -1.0);
      const double sample =
          value_of(example.signal, example.tracker.constants, amplitude, phase + omega) + error;
      const double later = omega + slew * (random.below(2) == 0 ? 1.0 : -1.0);
      worst = std::max(worst,
                       points.level(test::next_state(example.tracker, state, sample), phase + omega, later));
    }
    CAPTURE(cell.turn);
    REQUIRE(worst <= bound * (1.0 + 1e-12));
    shares.smallest = std::min(shares.smallest, worst / bound);
    shares.largest = std::max(shares.largest, worst / bound);
  }
  return shares;
}

TEST_CASE("no step at an amplitude of the range is longer than its bound, and some are about as long") {
  Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop);
  spread(loop.model, 0.03);
  for (const double noise : {0.0, 0.01}) {
    for (const double slew : {0.0, 1e-5}) {
      CAPTURE(noise);
      CAPTURE(slew);
      CHECK(steps_over_bounds(loop, tube, 0.004, noise, slew).largest > 0.9);
    }
  }
}

TEST_CASE("so it is for a signal that is no multiple of the amplitude, with an offset") {
  Example loop(test::phase_locked_loop());
  loop.signal = bent_signal(loop.tracker.recursion.constants);
  const Tube tube = proposed(loop);  // about the curve of another signal: any tube has its steps
  spread(loop.model, 0.03);
  CHECK(steps_over_bounds(loop, tube, 0.03, 0.01, 0.0).largest > 0.8);
}

TEST_CASE("amplitudes count as the noise that they come to at each phase, and no more") {
  Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop);
  Example varying(test::phase_locked_loop());
  spread(varying.model, 0.03);
  constexpr double kRadius = 0.004;
  constexpr double kNoise = 0.01;
  constexpr int kCells = 128;
  const auto bound = [&](const Example& example, const TubeCell& cell, double noise) {
    return bound_step(example.model, tube, cell, kRadius, noise, {1.0}).steps.front();
  };
  for (int k = 0; k < kCells; ++k) {
    CAPTURE(k);
    const TubeCell cell{(k + 0.5) / kCells, 0.5 / kCells, 0.0, 0.01};
    const double share = std::fabs(std::cos(kWholeTurn * cell.turn + tube.frequency));
    const double width = kWholeTurn * cell.half_turn + 0.01 * tube.half_width;
    const double found = bound(varying, cell, kNoise);
    REQUIRE(found >= bound(loop, cell, kNoise + 0.03 * std::max(0.0, share - width)) * (1.0 - 1e-6));
    REQUIRE(found <= bound(loop, cell, kNoise + 0.03 * (share + 2.0 * width)) * (1.0 + 1e-6));
  }
}

TEST_CASE("a set for a range of amplitudes is not left by the worst of them, and by those of a wider one") {
  Example loop(test::phase_locked_loop());
  spread(loop.model, 0.03);
  TrackedTone tone = test::tone_of(loop.tracker);
  tone.amplitude_deviation = 0.03;
  for (const double noise : {0.0, 0.01}) {
    CAPTURE(noise);
    SetTask task;
    task.objective = ShapeObjective::largest_noise;
    task.noise = noise;
    const TubeSet set = prove_set(tone, loop.model, 0.29, 0.31, task);
    REQUIRE(set.is_complete);
    CHECK(set.noise == noise);
    const TubeAttack attack = attack_tubes(loop.model, set);
    CHECK(attack.level_share <= 1.0);
    CHECK(attack.level_share > 0.8);
    Example wider(test::phase_locked_loop());
    spread(wider.model, 0.15);
    CHECK(attack_tubes(wider.model, set, {20, 500, 4, 1}).level_share > 1.0);
  }
  // As much as is tolerated beside the amplitudes.
  SetTask largest;
  largest.objective = ShapeObjective::largest_noise;
  largest.largest_noise = true;
  const TubeSet set = prove_set(tone, loop.model, 0.29, 0.31, largest);
  REQUIRE(set.is_complete);
  CHECK(set.noise > 0.01);
  CHECK(set.noise < 0.04);  // 0.05 at one amplitude
}

TEST_CASE("the error of the samples is at most what is taken for it, on two channels, too") {
  Example filter(test::phase_locked_loop());
  filter.signal = test::tone(filter.tracker.recursion.constants, true);
  spread(filter.model, 0.1);
  const rigor::UpwardRounding upward;
  const rigor::BallModelScope scope(2, 2);
  constexpr double kMiddle = 0.7;
  constexpr double kHalf = 0.05;
  const BallModel phase = BallModel(kMiddle) + BallModel(kHalf) * BallModel::s();
  const std::vector<BallModel> clean =
      run(filter.model, filter.signal, {BallModel(filter.model.amplitude), phase});
  REQUIRE(clean.size() == 2);
  const std::vector<BallModel> noisy = noisy_samples(filter.model, clean, 0.02, 1.0);
  REQUIRE(noisy.size() == 2);
  const std::size_t of_noise = noisy[0].monomials().class_of(0, 1, 0, 0);
  const double length = noisy[0].norm(of_noise);
  CHECK(length == noisy[1].norm(of_noise));
  CHECK(length > 0.12);
  CHECK(length < 0.12 * 1.06);
  CHECK(noisy[0].error() < 1e-12);
  for (const double s : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
    for (const double amplitude : {0.9, 1.0, 1.1}) {
      // The polynomials at s, whose only other variable is the noise.
      double square_of_length = 0.0;
      for (std::size_t c = 0; c < noisy.size(); ++c) {
        double value = 0.0;
        for (int power = 0; power <= 4; ++power) {
          const auto& of_power =
              noisy[c].monomials().classes()[noisy[c].monomials().class_of(0, 0, power, 0)];
          value += noisy[c].coefficients()[of_power.first] * std::pow(s, power);
        }
        const double angle = kMiddle + kHalf * s;
        const double error = amplitude * (c == 0 ? std::cos(angle) : std::sin(angle)) - value;
        square_of_length += error * error;
      }
      CHECK(std::sqrt(square_of_length) + 0.02 <= length);
    }
  }
}

TEST_CASE("samples of which nothing is known are not known with noise either") {
  Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop);
  loop.model.amplitude_varies = true;
  loop.model.amplitude = Interval::empty();
  const TubeCell cell{0.5, 0.01, 0.0, 0.1};
  CHECK_FALSE(std::isfinite(bound_step(loop.model, tube, cell, 0.004, 0.01, {1.0}).steps.front()));
  CHECK(verify_level(loop.model, tube, {0.004, 0.0}, {}).verdict == rigor::Verdict::undecided);
  loop.model.amplitude = Interval::from_bounds(-1e308, 1e308);
  CHECK(verify_level(loop.model, tube, {0.004, 0.0}, {}).verdict == rigor::Verdict::undecided);
}

TEST_CASE("nothing is proved of Gaussian noise") {
  Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop);
  DriftQuestion question;
  question.radius = 0.004;
  question.deviation = 0.002;
  question.most_noise = 0.02;
  question.exponent = 20.0;
  question.factor = 1.0;
  question.constant = 5.0;
  const DriftResult before = verify_drift(loop.model, tube, question, {});
  CHECK(before.verdict == rigor::Verdict::proved);
  spread(loop.model, 1e-6);
  const DriftResult after = verify_drift(loop.model, tube, question, {});
  CHECK(after.verdict == rigor::Verdict::undecided);
  CHECK(after.reason == "in Gaussian noise the amplitude must be constant");
}

TEST_CASE("the linear worst case adds what amplitudes do at each phase") {
  const test::ExampleTracker loop = test::phase_locked_loop();
  TrackedTone tone = test::tone_of(loop);
  const auto alone = linear_worst_case(tone, 0.3, 0.01, 0.0);
  tone.amplitude_deviation = 0.02;
  const auto both = linear_worst_case(tone, 0.3, 0.01, 0.0);
  const auto as_noise = linear_worst_case(test::tone_of(loop), 0.3, 0.03, 0.0);
  REQUIRE(alone);
  REQUIRE(both);
  REQUIRE(as_noise);
  CHECK(both->undisturbed == alone->undisturbed);
  // sin(2 phi)/2 in place of sin(phi): 2/pi of it.
  const double added = both->disturbed - alone->disturbed;
  const double of_noise = as_noise->disturbed - alone->disturbed;
  CHECK(added > 0.3 * of_noise);
  CHECK(added < 0.7 * of_noise);
}

}  // namespace
}  // namespace veritrack::model

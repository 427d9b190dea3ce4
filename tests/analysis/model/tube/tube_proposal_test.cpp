#include "analysis/model/tube/tube_proposal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

using test::tone_of;

TubeSettings settings_for(ShapeObjective objective) {
  TubeSettings settings;
  settings.shape.objective = objective;
  settings.largest_curve_error = 1e-7;
  return settings;
}

/// A series at a phase and z.
double value_of(const PhaseSeries& series, double phase, double z) {
  std::vector<std::pair<double, double>> harmonics;
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    harmonics.emplace_back(std::cos(static_cast<double>(h) * phase),
                           std::sin(static_cast<double>(h) * phase));
  }
  return series.at(harmonics, std::vector<double>{1.0, z, z * z, z * z * z, z * z * z * z});
}

struct Frame {
  Eigen::VectorXd middle;
  Eigen::MatrixXd shape;
};
Frame frame_at(const Tube& tube, double phase, double z) {
  const auto n = static_cast<Eigen::Index>(tube.curve.size());
  Frame frame{Eigen::VectorXd(n), Eigen::MatrixXd::Zero(n, n)};
  std::size_t place = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto state = static_cast<std::size_t>(i);
    frame.middle[i] = tube.turns[state] * phase + value_of(tube.curve[state], phase, z);
    for (Eigen::Index j = 0; j <= i; ++j) {
      frame.shape(i, j) = value_of(tube.shape[place++], phase, z);
    }
  }
  return frame;
}

/// The largest |F| at random places of the tube's boundary, for the radius 1.
double largest_step(const TrackedTone& tone, const Tube& tube, double radius, double noise) {
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  double largest = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double phase = M_PI * uniform(random);
    const double z = uniform(random);
    const double frequency = tube.frequency + z * tube.half_width;
    const Frame here = frame_at(tube, phase, z);
    const Frame next = frame_at(tube, phase + frequency, z);
    Eigen::VectorXd xi(here.middle.size());
    std::generate(xi.begin(), xi.end(), [&] { return normal(random); });
    Eigen::VectorXd samples = samples_of(tone.signal, 1.0, phase + frequency);
    samples[0] += uniform(random) < 0.0 ? noise : -noise;
    const Eigen::VectorXd image =
        tone.step.next(here.middle + here.shape * (radius * xi.normalized()), samples) - next.middle;
    largest = std::max(largest, next.shape.triangularView<Eigen::Lower>().solve(image).norm() / radius);
  }
  return largest;
}

TEST_CASE("tubes for starts: sampled steps stay inside, and the radii are those of the derivation") {
  const rigor::NearestRounding nearest;
  struct Case {
    test::ExampleTracker example;
    double frequency, half_width, least_radius;
  };
  const double hertz = 2.0 * M_PI / 10000.0;
  for (const Case& c :
       {Case{test::phase_locked_loop(), 0.2, 0.01, 0.0117},
        Case{test::phase_locked_loop(), 0.3, 0.04, 0.0121},
        Case{test::phase_locked_loop(), 0.5, 0.04, 0.0130},
        Case{test::integrator_loop(), 45.0 * hertz, hertz, 0.0020},
        Case{test::integrator_loop(), 55.0 * hertz, hertz, 0.0022},
        Case{test::notch_filter(), 0.4, 0.005, 0.0050}, Case{test::notch_filter(), 0.8, 0.005, 0.0039}}) {
    const TrackedTone tone = tone_of(c.example);
    const TubeProposal proposal =
        propose_tube(tone, c.frequency, c.half_width, settings_for(ShapeObjective::largest_starts));
    REQUIRE_MESSAGE(proposal.outcome == TubeOutcome::proposed, reason_of(proposal));
    CHECK(proposal.worth.least_reach > c.least_radius);
    CHECK(proposal.worth.level >= proposal.worth.least_reach);
    CHECK(proposal.loss < 0.01);
    const double step = largest_step(tone, *proposal.tube, proposal.worth.level, 0.0);
    CHECK(step < 1.0);
    CHECK(step > 0.9);
  }
}

TEST_CASE("tubes for noise and for slew tolerate what the derivation says" * doctest::test_suite("nightly")) {
  const rigor::NearestRounding nearest;
  struct Case {
    test::ExampleTracker example;
    double frequency, half_width, least_noise, least_slew;
  };
  const double hertz = 2.0 * M_PI / 10000.0;
  for (const Case& c : {Case{test::phase_locked_loop(), 0.3, 0.04, 0.055, 5.4e-5},
                        Case{test::integrator_loop(), 50.0 * hertz, hertz, 0.021, 3.0e-6},
                        Case{test::notch_filter(), 0.5, 0.005, 0.022, 1.4e-5}}) {
    const TrackedTone tone = tone_of(c.example);
    const TubeProposal for_noise =
        propose_tube(tone, c.frequency, c.half_width, settings_for(ShapeObjective::largest_noise));
    REQUIRE_MESSAGE(for_noise.outcome == TubeOutcome::proposed, reason_of(for_noise));
    CHECK(for_noise.worth.noise > c.least_noise);
    CHECK(largest_step(tone, *for_noise.tube, for_noise.worth.level, 0.98 * for_noise.worth.noise) < 1.0);
    const TubeProposal for_slew =
        propose_tube(tone, c.frequency, c.half_width, settings_for(ShapeObjective::largest_slew));
    REQUIRE_MESSAGE(for_slew.outcome == TubeOutcome::proposed, reason_of(for_slew));
    CHECK(for_slew.worth.slew > c.least_slew);
  }
}

TEST_CASE("the least error in the long run, and starts of given deviations") {
  const rigor::NearestRounding nearest;
  const TrackedTone tone = tone_of(test::phase_locked_loop());
  TubeSettings settings = settings_for(ShapeObjective::least_long_run_error);
  settings.shape.noise = 0.02;
  const TubeProposal proposal = propose_tube(tone, 0.3, 0.02, settings);
  REQUIRE_MESSAGE(proposal.outcome == TubeOutcome::proposed, reason_of(proposal));
  CHECK(largest_step(tone, *proposal.tube, proposal.worth.level, 0.02) < 1.0);
  // 0.033 for each unit of small noise.
  CHECK(proposal.worth.level < 1.3 * 0.033 * 0.02);
  settings = settings_for(ShapeObjective::largest_starts);
  settings.shape.start = Eigen::Vector2d(0.005, 0.05);
  const TubeProposal starts = propose_tube(tone, 0.3, 0.02, settings);
  REQUIRE_MESSAGE(starts.outcome == TubeOutcome::proposed, reason_of(starts));
  CHECK(starts.worth.start_share > 1.0);
  for (const double sign : {1.0, -1.0}) {
    const Frame frame = frame_at(*starts.tube, 1.0, 0.5);
    const Eigen::Vector2d corner(0.005, sign * 0.05);
    CHECK(frame.shape.triangularView<Eigen::Lower>().solve(corner).norm() < starts.worth.level);
  }
}

TEST_CASE("proposals are the same each time, and kept parameters fit neighbouring cells together") {
  const TrackedTone tone = tone_of(test::phase_locked_loop());
  const TubeSettings settings = settings_for(ShapeObjective::largest_starts);
  const TubeProposal first = propose_tube(tone, 0.3, 0.02, settings);
  const TubeProposal again = propose_tube(tone, 0.3, 0.02, settings);
  REQUIRE(first.tube);
  REQUIRE(again.tube);
  CHECK(first.tube->shape.front().coefficients == again.tube->shape.front().coefficients);
  CHECK(first.tube->curve.front().coefficients == again.tube->curve.front().coefficients);
  const TubeProposal next = propose_tube(tone, 0.34, 0.02, settings, first.shape.parameters, true);
  REQUIRE(next.tube);
  const TubeProposal kept = propose_tube(tone, 0.3, 0.02, settings, first.shape.parameters, true);
  REQUIRE(kept.tube);
  for (const double phase : {0.0, 1.0, 2.5}) {
    const Frame left = frame_at(*kept.tube, phase, 1.0);
    const Frame right = frame_at(*next.tube, phase, -1.0);
    CHECK((left.middle - right.middle).norm() < 1e-7);
    CHECK((left.shape - right.shape).norm() < 1e-5 * left.shape.norm());
  }
}

TEST_CASE("a filter with covariances among its states" * doctest::test_suite("nightly")) {
  const rigor::NearestRounding nearest;
  const TrackedTone tone = tone_of(test::kalman_filter(2, 0.0023, 0.05), true);
  TubeSettings settings = settings_for(ShapeObjective::largest_starts);
  const TubeProposal proposal = propose_tube(tone, 1.0, 0.05, settings);
  REQUIRE_MESSAGE(proposal.outcome == TubeOutcome::proposed, reason_of(proposal));
  CHECK(proposal.worth.least_reach > 0.05);
  CHECK(largest_step(tone, *proposal.tube, proposal.worth.level, 0.0) < 1.0);
}

TEST_CASE("when the time is over a search ends, and says nothing of the tracker") {
  const TrackedTone tone = tone_of(test::phase_locked_loop());
  TubeSettings settings = settings_for(ShapeObjective::largest_starts);
  settings.shape.deadline = search::Deadline(0.0);
  CHECK(propose_tube(tone, 0.3, 0.02, settings).outcome == TubeOutcome::time_limit);
  settings = settings_for(ShapeObjective::largest_starts);
  settings.steady_state.deadline = search::Deadline(0.0);
  test::ExampleTracker slow = test::phase_locked_loop(1e-4);
  slow.start = [](double omega) { return std::vector<double>{omega + 1e-5, 0.0}; };
  const TubeProposal proposal = propose_tube(tone_of(slow), 0.3, 0.02, settings);
  CHECK(proposal.outcome == TubeOutcome::time_limit);
  CHECK(proposal.steady_state.samples == proposal.steady_state.period);
  CHECK(reason_of(proposal) == kTimeLimit);
}

TEST_CASE("a cell that is not within (0, pi) is refused") {
  const TrackedTone tone = tone_of(test::phase_locked_loop());
  CHECK_THROWS_AS((void)propose_tube(tone, 0.5, 0.6, {}), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model

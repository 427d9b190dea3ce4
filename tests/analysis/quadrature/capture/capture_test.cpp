#include "analysis/quadrature/capture/capture.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "tests/analysis/quadrature/capture/capture_support.hpp"

namespace {

using namespace veritrack;
using quadrature::CaptureOutcome;
using quadrature::CaptureResult;
using quadrature::CertifiedSetTarget;
using test::Interval;
using test::StartBox;

/// Members of a box that was found captured (or locked elsewhere) are in the set, seen by the tracker itself,
/// at the very sample that the propagation names. `disturb` chooses (noise_1, noise_2, slew) at each sample.
template <typename Disturb>
void check_members(const test::CaptureProblem& problem, const quadrature::CertifiedSet& set,
                   const StartBox& box, const CaptureResult& result, test::Random& random, int members,
                   Disturb disturb) {
  for (int n = 0; n < members; ++n) {
    const double omega = test::member(problem.frequency, random);
    test::TrackedRun run(problem, omega, test::member(box.amplitude_error, random),
                         test::member(box.phase_error, random), test::member(box.frequency_error, random));
    for (int k = 0; k < result.samples; ++k) {
      const auto d = disturb(n, k);
      run.step(d[0], d[1], d[2]);
    }
    CHECK(run.is_in(set, result.turns));
  }
}

const auto kQuiet = [](int, int) { return std::array{0.0, 0.0, 0.0}; };

TEST_CASE("boxes found captured are captured: the tracker agrees at random members and corners") {
  test::Random random(21);
  int captured = 0;
  const int count = static_cast<int>(test::effort(60));
  for (int n = 0; n < count; ++n) {
    const auto& example = test::capture_examples()[static_cast<std::size_t>(n % 4)];
    const auto problem = test::capture_problem(example);
    const auto set = test::target_set(example);
    const double width = std::exp(random.uniform(std::log(1e-4), std::log(0.1)));
    const bool with_amplitude = n % 3 == 0;
    const double a = with_amplitude ? random.uniform(-0.2, 0.2) : 0.0;
    const StartBox box{with_amplitude ? test::around(a, width) : Interval(0.0),
                       test::around(random.uniform(-3.2, 3.2), width),
                       test::around(random.uniform(-1.3, 1.3), width)};
    const CaptureResult result = follow_starts(problem, CertifiedSetTarget(set, true), box);
    if (result.outcome == CaptureOutcome::locked) {
      ++captured;
      CHECK(result.turns == 0);
      check_members(problem, set, box, result, random, 16, kQuiet);
    }
  }
  CHECK(captured > count / 3);
}

TEST_CASE("with noise and slew, whatever they do within their bounds") {
  test::Random random(22);
  int captured = 0;
  for (int n = 0; n < 8; ++n) {
    const auto& example = test::capture_examples()[static_cast<std::size_t>(n % 4)];
    auto problem = test::capture_problem(example);
    problem.noise = 0.004;
    problem.slew = n < 4 ? 0.0 : 0.0005;
    const auto set = test::target_set(example);
    const StartBox box{Interval(0.0), test::around(random.uniform(-1.0, 1.0), 0.003),
                       test::around(random.uniform(-0.6, 0.6), 0.003)};
    const CaptureResult result = follow_starts(problem, CertifiedSetTarget(set, true), box);
    captured += result.outcome == CaptureOutcome::locked ? 1 : 0;
    if (result.outcome != CaptureOutcome::locked) {
      continue;
    }
    check_members(problem, set, box, result, random, 40, [&](int member, int k) {
      // Constant, turning, alternating, and random directions.
      const double angle = member % 4 == 0   ? 0.7 * member
                           : member % 4 == 1 ? 0.3 * k + member
                           : member % 4 == 2 ? 3.14159 * k + member
                                             : random.uniform(0.0, 6.28);
      const double slew = member % 3 == 0 ? problem.slew : random.uniform(-problem.slew, problem.slew);
      return std::array{problem.noise * std::cos(angle), problem.noise * std::sin(angle), slew};
    });
  }
  CHECK(captured >= 6);
}

TEST_CASE("a leak: the frequency matters, and an interval of frequencies holds for each of them") {
  test::Random random(23);
  const auto& example = test::capture_examples()[2];
  auto problem = test::capture_problem(example);
  problem.design.epsilon = Interval(0.01);
  problem.frequency = Interval::from_bounds(0.1, 0.2);
  const auto set = test::target_set(example);
  const StartBox box{test::around(0.0, 0.02), test::around(0.2, 0.02), test::around(0.5, 0.02)};
  const CaptureResult result = follow_starts(problem, CertifiedSetTarget(set, false), box);
  REQUIRE(result.outcome == CaptureOutcome::locked);
  check_members(problem, set, box, result, random, 100, kQuiet);
}

TEST_CASE("covariances must come between both bounds of the set") {
  const auto& example = test::capture_examples()[1];
  const auto problem = test::capture_problem(example);
  const StartBox box{Interval(0.0), test::around(0.5, 0.01), test::around(0.3, 0.01)};
  const auto outcome = [&](double lower, double upper) {
    auto set = test::target_set(example);
    set.covariance_lower *= lower;
    set.covariance_upper *= upper;
    return follow_starts(problem, CertifiedSetTarget(set, true), box).outcome;
  };
  CHECK(outcome(1.0, 1.0) == CaptureOutcome::locked);
  // The steady covariance of the design is below twice the lower bound, and above a quarter of the upper one.
  CHECK(outcome(2.5, 4.0) != CaptureOutcome::locked);
  CHECK(outcome(0.1, 0.2) != CaptureOutcome::locked);
}

TEST_CASE("the phase is an angle: whole turns of it change nothing") {
  const auto& example = test::capture_examples()[1];
  const auto problem = test::capture_problem(example);
  const auto set = test::target_set(example);
  const CertifiedSetTarget target(set, true);
  const CaptureResult none =
      follow_starts(problem, target, {Interval(0.0), test::around(0.5, 0.01), test::around(0.3, 0.01)});
  const CaptureResult turned = follow_starts(
      problem, target, {Interval(0.0), test::around(0.5 + 6.283185307179586, 0.01), test::around(0.3, 0.01)});
  CHECK(none.outcome == CaptureOutcome::locked);
  CHECK(turned.outcome == CaptureOutcome::locked);
  CHECK(none.samples == turned.samples);
}

TEST_CASE("starts that lock at a wrong frequency are never captured, and are found out") {
  // Where the simulated tracker ends at nu = 2 pi k, k not 0: at frequency errors of nearly pi and beyond.
  test::Random random(24);
  int elsewhere = 0;
  const int count = static_cast<int>(test::effort(60));
  for (int n = 0; n < count; ++n) {
    const auto& example = test::capture_examples()[2];
    const auto problem = test::capture_problem(example);
    const auto set = test::target_set(example);
    const double phase = random.uniform(-3.1, 3.1);
    const double frequency = random.uniform(2.9, 5.5);
    test::TrackedRun run(problem, 0.7, 0.0, phase, frequency);
    for (int k = 0; k < 600; ++k) {
      run.step();
    }
    const bool locks = run.is_in(set);
    for (const double width : {0.1, 1e-3, 0.0}) {
      const StartBox box{Interval(0.0), test::around(phase, width), test::around(frequency, width)};
      const CaptureResult result = follow_starts(problem, CertifiedSetTarget(set, true), box);
      if (!locks) {
        CHECK(result.outcome != CaptureOutcome::locked);
      } else {
        CHECK(result.outcome != CaptureOutcome::locked_elsewhere);
      }
      if (result.outcome == CaptureOutcome::locked_elsewhere) {
        ++elsewhere;
        CHECK(result.turns != 0);
        check_members(problem, set, box, result, random, 8, kQuiet);
      }
    }
    // For epsilon > 0 there is no such symmetry: the shift is not looked for.
    const StartBox point{Interval(0.0), Interval(phase), Interval(frequency)};
    CHECK(follow_starts(problem, CertifiedSetTarget(set, false), point).outcome !=
          CaptureOutcome::locked_elsewhere);
  }
  CHECK(elsewhere > count / 4);
}

TEST_CASE("what is unknown, infinite or far too large is given up") {
  const auto& example = test::capture_examples()[1];
  const auto problem = test::capture_problem(example);
  const CertifiedSetTarget target(test::target_set(example), true);
  const StartBox good{Interval(0.0), test::around(0.5, 0.01), test::around(0.6, 0.01)};
  REQUIRE(follow_starts(problem, target, good).outcome == CaptureOutcome::locked);

  const Interval empty = Interval::empty();
  for (const StartBox& box : {StartBox{empty, good.phase_error, good.frequency_error},
                              StartBox{Interval(0.0), empty, good.frequency_error},
                              StartBox{Interval(0.0), good.phase_error, Interval::entire()},
                              StartBox{Interval(0.0), test::around(0.0, 4.0), test::around(0.0, 4.0)},
                              StartBox{Interval(0.0), test::around(0.0, 1e300), good.frequency_error},
                              StartBox{test::around(0.0, 1.5), good.phase_error, good.frequency_error}}) {
    CHECK(follow_starts(problem, target, box).outcome == CaptureOutcome::enclosure_lost);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, -1.0, std::numeric_limits<double>::infinity(), 1e200}) {
    auto noisy = problem;
    noisy.noise = bad;
    CHECK(follow_starts(noisy, target, good).outcome == CaptureOutcome::enclosure_lost);
    auto slewing = problem;
    slewing.slew = bad;
    CHECK(follow_starts(slewing, target, good).outcome == CaptureOutcome::enclosure_lost);
  }
  auto unknown = problem;
  unknown.design.r = empty;
  CHECK(follow_starts(unknown, target, good).outcome == CaptureOutcome::enclosure_lost);
  unknown = problem;
  unknown.initial_covariance(1, 2) = empty;
  CHECK(follow_starts(unknown, target, good).outcome == CaptureOutcome::enclosure_lost);
  unknown = problem;
  unknown.frequency = empty;
  CHECK(follow_starts(unknown, target, good).outcome == CaptureOutcome::enclosure_lost);

  auto set = test::target_set(example);
  set.radius = nan;
  CHECK(follow_starts(problem, CertifiedSetTarget(set, true), good).outcome != CaptureOutcome::locked);
  set = test::target_set(example);
  set.metric(1, 1) = nan;
  CHECK(follow_starts(problem, CertifiedSetTarget(set, true), good).outcome != CaptureOutcome::locked);
  set = test::target_set(example);
  set.covariance_upper = set.covariance_lower;
  CHECK(follow_starts(problem, CertifiedSetTarget(set, true), good).outcome ==
        CaptureOutcome::out_of_samples);
}

TEST_CASE("an interval design and covariance hold for each of their members") {
  const auto& example = test::capture_examples()[1];
  auto problem = test::capture_problem(example);
  const auto set = test::target_set(example);
  {
    const rigor::UpwardRounding upward;
    problem.design.r = test::around(example.r, 1e-5);
    problem.design.q2 = test::around(example.q, 1e-6);
    for (Interval& entry : problem.initial_covariance.reshaped()) {
      entry = entry * Interval::from_bounds(0.999, 1.001);
    }
  }
  const StartBox box{Interval(0.0), test::around(0.4, 0.01), test::around(-0.5, 0.01)};
  const CaptureResult result = follow_starts(problem, CertifiedSetTarget(set, true), box);
  REQUIRE(result.outcome == CaptureOutcome::locked);
  test::Random random(25);
  for (int n = 0; n < 100; ++n) {
    auto member = problem;
    member.design.r = Interval(test::member(problem.design.r, random));
    member.design.q2 = Interval(test::member(problem.design.q2, random));
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        member.initial_covariance(i, j) = member.initial_covariance(j, i) =
            Interval(test::member(problem.initial_covariance(i, j), random));
      }
    }
    check_members(member, set, box, result, random, 1, kQuiet);
  }
}

}  // namespace

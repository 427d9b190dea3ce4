// Starts that are followed, against the tracker's own code from random starts with random noise.
#include "checker/quadrature/followed_starts.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

Ball between(double low, double high) {
  return Ball::hull(Ball(low), Ball(high));
}

/// Contains the point, which was computed in double. What is lost, a ball of everything, does.
void check_contains(const Ball& enclosure, double point) {
  const double slack = 1e-11 * (1.0 + std::fabs(point));
  CHECK_FALSE(checker::certainly_less(enclosure, Ball(point - slack)));
  CHECK_FALSE(checker::certainly_less(Ball(point + slack), enclosure));
}

struct Case {
  trackers::ToneModel<double> design;
  double frequency, noise, slew;
  trackers::PolarError<double> low, width;  ///< of the starts
  trackers::PolarCovariance<double> covariance;
};

Case random_case(test::Random& random, std::int64_t i) {
  const double epsilon = i % 2 == 0 ? 0.0 : random.uniform(0.001, 0.05);
  return {{random.uniform(5e-4, 0.005), random.uniform(5e-4, 0.005), random.uniform(0.03, 0.2), epsilon},
          random.uniform(0.05, 1.0),
          i % 3 == 0 ? 0.0 : 0.002,
          i % 4 == 2 ? 0.001 : 0.0,
          {random.uniform(-0.1, 0.05), random.uniform(-0.8, 0.7), random.uniform(-0.4, 0.3)},
          {0.05, 0.1, 0.05},
          {random.uniform(0.01, 0.05), random.uniform(-0.002, 0.002), random.uniform(-0.002, 0.002),
           random.uniform(0.02, 0.05), random.uniform(0.0, 0.01), random.uniform(0.01, 0.02)}};
}

checker::Matrix3 in_balls(const Eigen::Matrix3d& matrix) {
  checker::Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = Ball(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return result;
}

void check_holds(const checker::FollowedStarts& starts,
                 const std::vector<trackers::PolarFrameState<double>>& runs) {
  const checker::Matrix3 unit = checker::diagonal(Ball(1.0), Ball(1.0), Ball(1.0));
  const checker::PolarEnclosure polar = starts.polar(unit, {Ball(0.0), Ball(0.0), Ball(0.0)});
  for (const trackers::PolarFrameState<double>& run : runs) {
    check_contains(starts.frequency_error(), run.error.frequency);
    check_contains(polar.error[0], run.error.amplitude);
    check_contains(polar.error[1], std::remainder(run.error.phase, 2.0 * 3.141592653589793));
    check_contains(polar.error[2], run.error.frequency);
    const Eigen::Matrix3d p = run.covariance.matrix();
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        check_contains(polar.covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], p(i, j));
      }
    }
  }
}

}  // namespace

TEST_CASE("every run from a box of starts is in what is followed") {
  constexpr int kRuns = 20;
  constexpr int kSamples = 12;
  constexpr double kBand = 0.002;
  test::Random random(91);
  std::int64_t lost = 0;
  for (std::int64_t i = 0; i < test::effort(12); ++i) {
    CAPTURE(i);
    const Case c = random_case(random, i);
    const checker::Loop loop{Ball(c.design.q1),
                             Ball(c.design.q2),
                             Ball(c.design.r),
                             Ball(c.design.epsilon),
                             between(c.frequency, c.frequency + kBand),
                             Ball(c.noise),
                             Ball(c.slew),
                             Ball(1.0),
                             Ball(3.2)};
    checker::FollowedStarts starts(loop,
                                   {between(c.low.amplitude, c.low.amplitude + c.width.amplitude),
                                    between(c.low.phase, c.low.phase + c.width.phase),
                                    between(c.low.frequency, c.low.frequency + c.width.frequency)},
                                   in_balls(c.covariance.matrix()));
    std::vector<trackers::PolarFrameState<double>> runs;
    std::vector<double> frequencies;
    for (int run = 0; run < kRuns; ++run) {
      runs.push_back({{c.low.amplitude + random.uniform(0.0, c.width.amplitude),
                       c.low.phase + random.uniform(0.0, c.width.phase),
                       c.low.frequency + random.uniform(0.0, c.width.frequency)},
                      c.covariance});
      frequencies.push_back(random.uniform(c.frequency, c.frequency + kBand));
    }
    for (int k = 0; k <= kSamples; ++k) {
      CAPTURE(k);
      check_holds(starts, runs);
      starts.step();
      for (std::size_t run = 0; run < runs.size(); ++run) {
        // Without a leak the frequency acts through its changes alone, and need not keep to the band.
        const double slew = c.design.epsilon == 0.0 ? random.uniform(-c.slew, c.slew) : 0.0;
        const double direction = random.uniform(-3.2, 3.2);
        runs[run] = trackers::polar_frame_map(
            runs[run], {c.noise * std::cos(direction), c.noise * std::sin(direction), slew, frequencies[run]},
            c.design);
      }
    }
    lost += starts.frequency_error().finite() ? 0 : 1;
  }
  CHECK(lost <= test::effort(12) / 6);
}

TEST_CASE("a frequency that only ever rises, or falls, is followed") {
  constexpr double kSlew = 0.01;
  const trackers::ToneModel<double> design{0.001, 0.001, 0.1, 0.0};
  const Ball zero(0.0);
  const checker::Loop loop{Ball(design.q1), Ball(design.q2), Ball(design.r), zero, zero, zero,
                           Ball(kSlew),     Ball(1.0),       Ball(3.2)};
  const trackers::PolarCovariance<double> covariance{0.01, 0.0, 0.0, 0.01, 0.0, 0.01};
  checker::FollowedStarts starts(loop, {zero, zero, zero}, in_balls(covariance.matrix()));
  std::vector<trackers::PolarFrameState<double>> runs(2, {{0.0, 0.0, 0.0}, covariance});
  for (int k = 0; k < 5; ++k) {
    starts.step();
    for (std::size_t run = 0; run < 2; ++run) {
      runs[run] = trackers::polar_frame_map(runs[run], {0.0, 0.0, run == 0 ? kSlew : -kSlew, 0.5}, design);
    }
    check_holds(starts, runs);
    CHECK(starts.frequency_error().finite());
  }
  CHECK(std::fabs(runs[0].error.frequency) > kSlew);
}

TEST_CASE("an estimate that may be zero is not followed") {
  const Ball zero(0.0);
  const checker::Loop loop{Ball(0.001), Ball(0.001), Ball(0.1), zero, zero, zero, zero, Ball(1.0), Ball(3.2)};
  const checker::Matrix3 p = checker::diagonal(Ball(0.01), Ball(0.01), Ball(0.01));
  checker::FollowedStarts starts(loop, {between(-1.0, 0.0), zero, zero}, p);
  starts.step();
  CHECK_FALSE(starts.frequency_error().finite());
}

TEST_CASE("phases that differ by half a turn have no polar enclosure") {
  const Ball zero(0.0);
  const checker::Loop loop{Ball(0.001), Ball(0.001), Ball(0.1), zero, zero, zero, zero, Ball(1.0), Ball(3.2)};
  const checker::Matrix3 p = checker::diagonal(Ball(0.01), Ball(0.01), Ball(0.01));
  const checker::Matrix3 unit = checker::diagonal(Ball(1.0), Ball(1.0), Ball(1.0));
  const auto phase_of = [&](double phase) {
    const checker::FollowedStarts starts(loop, {zero, between(-phase, phase), zero}, p);
    return starts.polar(unit, {zero, zero, zero}).error[1];
  };
  CHECK(phase_of(0.5).finite());
  CHECK_FALSE(phase_of(1.8).finite());
  CHECK_FALSE(phase_of(3.1).finite());
}

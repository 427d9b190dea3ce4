#include "analysis/model/gain/phase_loop.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

const Interval kNarrow = Interval::from_bounds(0.3, 0.3004);

/// The largest error after `samples` samples of w' = w + ki e, theta' = theta + w + kp e, e = -y sin theta,
/// from its steady state, with noise in the direction of its adjoint.
double adjoint_attack(const test::ExampleTracker& loop, double omega, double end, double noise, int samples) {
  constexpr int kSettling = 4000;
  const double ki = loop.constants[0];
  const double kp = loop.constants[1];
  double w = omega;
  double theta = end - (samples + kSettling) * omega;
  const auto advance = [&](int left, double push) {
    const double e = -(std::cos(end - left * omega) + push) * std::sin(theta);
    theta += w + kp * e;
    w += ki * e;
  };
  for (int left = samples + kSettling; left-- > samples;) {
    advance(left, 0.0);
  }
  const double settled_w = w;
  const double settled_theta = theta;
  std::vector<double> angles;
  for (int left = samples; left-- > 0;) {
    angles.push_back(theta);
    advance(left, 0.0);
  }
  std::vector<double> signs(angles.size());
  double by_w = 1.0;
  double by_theta = 0.0;
  for (int k = samples; k-- > 0;) {
    const double angle = angles[static_cast<std::size_t>(k)];
    const double seen = ki * by_w + kp * by_theta;
    signs[static_cast<std::size_t>(k)] = -std::sin(angle) * seen > 0.0 ? 1.0 : -1.0;
    const double slope = -std::cos(end - (samples - 1 - k) * omega) * std::cos(angle);
    by_w += by_theta;
    by_theta += slope * seen;
  }
  w = settled_w;
  theta = settled_theta;
  for (int left = samples; left-- > 0;) {
    advance(left, noise * signs[static_cast<std::size_t>(samples - 1 - left)]);
  }
  return std::fabs(w - omega);
}

std::string no_loop_because(const TrackerModel& tracker, const TrackedTone& tone, bool with_slew) {
  try {
    (void)PhaseLoop::make(tracker, tone, kNarrow, with_slew, {});
  } catch (const NoFrame& reason) {
    return reason.what();
  }
  return "none";
}

TEST_CASE("a loop with a linear detector has the gain and the horizon of its recursion") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::angle_loop(0.004, 0.1));
  const PhaseLoop made = PhaseLoop::make(loop.model, loop.tone, kNarrow, false, {});
  // e = noise - theta - w; w' = w + ki e, theta' = theta + w + kp e.
  double gain = 0.0;
  double w = 0.004;
  double theta = 0.1;
  double largest = 0.0;
  std::size_t last = 0;
  for (std::size_t k = 0; k < 5000; ++k) {
    gain += std::fabs(w);
    const double size = std::max(std::fabs(w) / 0.004, std::fabs(theta));
    largest = std::max(largest, size);
    last = size > 1e-4 * largest ? k : last;
    const double ahead = theta + w;
    w -= 0.004 * ahead;
    theta = ahead - 0.1 * ahead;
  }
  CHECK(made.probe().largest_gain() >= 0.999 * gain);
  CHECK(made.probe().largest_gain() * (1.0 + made.probe().missed_share()) >= gain);
  CHECK(made.probe().largest_gain() <= 1.05 * gain);
  CHECK(made.probe().missed_share() < 0.1);
  CHECK(made.gridding().late_blocks == 0);
  CHECK(made.gridding().lags == made.gridding().horizon);
  CHECK(made.gridding().lags % PhaseKernels::kBlocks == 0);
  CHECK(made.gridding().lags > last / 2);
  CHECK(made.gridding().lags < 2 * last);
}

TEST_CASE(
    "the parts cover the band, each is worked on once, and attacks at its frequency are within its bounds") {
  const rigor::UpwardRounding upward;
  const test::Example loop(test::phase_locked_loop(0.05));
  const TrackedTone tone = test::tone_of(loop.tracker);
  const PhaseLoop made = PhaseLoop::make(loop.model, tone, kNarrow, false, {});
  const std::vector<FloquetCell>& cells = made.cells();
  CHECK(made.parts() == cells.size() * made.gridding().parts);
  CHECK(cells.front().curve.frequency - cells.front().curve.half_width < kNarrow.lower());
  CHECK(cells.back().curve.frequency + cells.back().curve.half_width > kNarrow.upper());
  constexpr double kNoise = 0.02;
  std::vector<std::atomic<int>> visits(made.parts());
  std::vector<double> bounds(made.parts(), 0.0);
  CHECK(made.for_each_part([&](std::size_t part, const PhaseGains& gains) {
    ++visits[part];
    const auto errors = gains.errors({kNoise, 0.0, {}});
    bounds[part] = errors ? errors->for_ever : INFINITY;
    return true;
  }));
  for (std::size_t part = 0; part < made.parts(); ++part) {
    REQUIRE(visits[part] == 1);
    const Tube& curve = cells[part / made.gridding().parts].curve;
    const double place = static_cast<double>(2 * (part % made.gridding().parts) + 1) /
                             static_cast<double>(made.gridding().parts) -
                         1.0;
    double reached = 0.0;
    for (int i = 0; i < 16; ++i) {
      const double end = 2.0 * std::numbers::pi * i / 16.0;
      const double omega = curve.frequency + place * curve.half_width;
      reached = std::max(reached, adjoint_attack(loop.tracker, omega, end, kNoise, 400));
    }
    CHECK(reached <= bounds[part]);
    CHECK(reached >= 0.7 * bounds[part]);
  }
  std::atomic<int> tried = 0;
  CHECK_FALSE(made.for_each_part([&](std::size_t, const PhaseGains&) {
    ++tried;
    return false;
  }));
  CHECK(tried >= 1);
}

TEST_CASE("with a slew one cell has bounds of all its parts, up to that slew") {
  const rigor::UpwardRounding upward;
  constexpr double kSlew = 1e-7;
  const test::TwoChannelExample loop(test::angle_loop(0.004, 0.1));
  const PhaseLoop made = PhaseLoop::make(loop.model, loop.tone, kNarrow, true, {});
  REQUIRE(made.cells().size() == 1);
  const auto gains = made.with_slew(kSlew);
  REQUIRE(gains);
  CHECK_FALSE(gains->errors({0.01, 2.0 * kSlew, {}}));
  const auto errors = gains->errors({0.0, kSlew, {}});
  REQUIRE(errors);
  // In the end w' - w is the slew, so e = slew/ki; theta behind by (1 - kp) e, and w by kp e.
  const double behind = kSlew * 0.1 / 0.004;
  CHECK(errors->long_run >= 0.9 * behind);
  CHECK(errors->long_run <= 1.5 * behind);
}

TEST_CASE("a loop without bounds has its reason") {
  const rigor::UpwardRounding upward;
  const test::Example unstable(test::phase_locked_loop(2.0));
  CHECK(no_loop_because(unstable.model, test::tone_of(unstable.tracker), false).starts_with("no basis"));
  const test::TwoChannelExample fast(test::angle_loop(0.004, 0.1));
  CHECK_THROWS_AS((void)PhaseLoop::make(fast.model, fast.tone, kNarrow, false, search::Deadline(0.0)),
                  NoTime);
  const test::TwoChannelExample slow(test::angle_loop(1e-9, 4e-5));
  const std::string reason = no_loop_because(slow.model, slow.tone, true);
  CHECK(reason.ends_with("too many with a slew"));
  // A clamp that is idle in the steady state costs nothing.
  const test::TwoChannelExample bent(test::two_channel_loop(0.1, 0.004, test::Detector::knee));
  CHECK(no_loop_because(bent.model, bent.tone, false) == "none");
}

}  // namespace
}  // namespace veritrack::model

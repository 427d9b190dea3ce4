// Settings that break one condition of the theorem of docs/contraction.md by little, or the meaning of a
// step.
#include "checker/quadrature/set_inequality.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

using namespace veritrack::checker;

namespace {

/// A verified set of the design of La Scala's Figure 3.5 without its leak, with a shorter radius.
Setting the_setting() {
  Setting s;
  s.q1 = s.q2 = Ball(0.0023);
  s.r = Ball(0.05);
  s.metric = {Ball(0x1.dd7f420252bdap+0), Ball(0x1.94a22f42e4696p+2), Ball(-0x1.02075762a01aap+2),
              Ball(0x1.5c78cd65fb9f1p+4)};
  s.lower = {Ball(0x1.2e4c5a0945dbfp-7), Ball(0x1.832337e95f5c9p-6), Ball(0x1.cf96fd9ebfcdbp-8),
             Ball(0x1.d54edb3a42124p-8)};
  s.upper = {Ball(0x1.49e1fbad57c06p-7), Ball(0x1.b0b68f440f5c1p-6), Ball(0x1.099c6fba71f43p-7),
             Ball(0x1.080dcafbd5d4ap-7)};
  s.radius = Ball(0x1p-6);
  s.noise = zero;
  s.slew = zero;
  s.rate = Ball(0.995);
  s.noise_gain = s.slew_gain = Ball(1024.0);
  s.largest_amplitude = (s.radius / s.metric.amplitude).upper();
  s.largest_chi = (s.radius * sqrt(square(one / s.metric.phase) +
                                   square((one - s.metric.coupling / s.metric.phase) / s.metric.frequency)))
                      .upper();
  return s;
}

bool contracts_with(const Setting& setting) {
  std::int64_t cells = 0;
  return contracts(setting, cells);
}

}  // namespace

TEST_CASE("both bounds on the covariance must be kept") {
  const Setting setting = the_setting();
  CHECK(keeps_covariance(setting));
  SUBCASE("a lower bound above the steady state") {
    Setting changed = setting;
    changed.lower = {setting.upper.p11 * Ball(0.999), setting.upper.p22 * Ball(0.999),
                     setting.upper.p23 * Ball(0.999), setting.upper.p33 * Ball(0.999)};
    CHECK_FALSE(keeps_covariance(changed));
  }
  SUBCASE("an upper bound below the steady state") {
    Setting changed = setting;
    changed.upper = {setting.lower.p11 * Ball(1.001), setting.lower.p22 * Ball(1.001),
                     setting.lower.p23 * Ball(1.001), setting.lower.p33 * Ball(1.001)};
    CHECK_FALSE(keeps_covariance(changed));
  }
}

TEST_CASE("bounds that a turn of the estimate leaves are not kept") {
  Setting setting = the_setting();
  setting.noisy = true;
  setting.noise = Ball(0.01);
  CHECK(keeps_covariance(setting));
  setting.noise = Ball(0.5);  // turns by a third of a radian, while the gains stay what they are
  CHECK_FALSE(keeps_covariance(setting));
}

TEST_CASE("noise that may carry the estimate through zero keeps no covariance, nor much more noise") {
  Setting setting = the_setting();
  for (const double noise : {5.0, 1e3, 1e6}) {
    CAPTURE(noise);
    setting.noise = Ball(noise);
    setting.noisy = true;
    CHECK_FALSE(keeps_covariance(setting));
    setting.rate = Ball(1e6);
    setting.noise_gain = Ball(1e6);
    CHECK_FALSE(contracts_with(setting));
  }
}

TEST_CASE("errors contract at the rate of the tracker, and no faster") {
  Setting setting = the_setting();
  CHECK(contracts_with(setting));
  setting.rate = Ball(0.9);
  CHECK_FALSE(contracts_with(setting));
}

TEST_CASE("a rate that states on the rim exceed is not proved, though the middles of cells keep it") {
  Setting setting = the_setting();
  setting.radius = Ball(0x1.efdab44e59523p-4);
  setting.largest_amplitude = (setting.radius / setting.metric.amplitude).upper();
  setting.largest_chi =
      (setting.radius *
       sqrt(square(one / setting.metric.phase) +
            square((one - setting.metric.coupling / setting.metric.phase) / setting.metric.frequency)))
          .upper();
  // The tracker's own code, from the rim.
  const double t1 = setting.metric.amplitude.near();
  const double t2 = setting.metric.phase.near();
  const double t3 = setting.metric.coupling.near();
  const double t4 = setting.metric.frequency.near();
  const double radius = setting.radius.near();
  veritrack::test::Random random(77);
  double needed = 0.0;
  for (int k = 0; k < 20000; ++k) {
    std::array<double, 3> u{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const double length = std::hypot(u[0], u[1], u[2]);
    const double frequency = radius * u[2] / length / t4;
    const double phase = (radius * u[1] / length - t3 * frequency) / t2;
    const Covariance<Ball>& p = k % 2 == 0 ? setting.lower : setting.upper;
    const veritrack::trackers::PolarFrameState<double> state{
        {radius * u[0] / length / t1, phase, frequency},
        {p.p11.near(), 0.0, 0.0, p.p22.near(), p.p23.near(), p.p33.near()}};
    const auto next =
        veritrack::trackers::polar_frame_map(state, {0.0, 0.0, 0.0, 0.7}, {0.0023, 0.0023, 0.05, 0.0}).error;
    needed = std::max(
        needed,
        std::hypot(t1 * next.amplitude, t2 * next.phase + t3 * next.frequency, t4 * next.frequency) / radius);
  }
  setting.rate = Ball(0x1.fb4e515d8926ep-1);
  CHECK(contracts_with(setting));
  CHECK(needed < 0x1.fb4e515d8926ep-1);
  setting.rate = Ball(0.999 * needed);
  CHECK_FALSE(contracts_with(setting));
}

TEST_CASE("a gain that cells keep in their middles and not at their ends is not proved") {
  Setting setting = the_setting();
  setting.radius = Ball(0.6);
  setting.largest_amplitude = (setting.radius / setting.metric.amplitude).upper();
  setting.largest_chi =
      (setting.radius *
       sqrt(square(one / setting.metric.phase) +
            square((one - setting.metric.coupling / setting.metric.phase) / setting.metric.frequency)))
          .upper();
  setting.rate = Ball(0.997);
  setting.noisy = true;
  setting.noise = Ball(0.2);
  setting.noise_gain = Ball(17.6);
  CHECK(contracts_with(setting));
  setting.noise_gain = Ball(16.7);
  CHECK_FALSE(contracts_with(setting));
}

TEST_CASE("noise and slew need their gains") {
  Setting setting = the_setting();
  setting.noisy = setting.slewing = true;
  setting.noise = Ball(1e-4);
  CHECK(contracts_with(setting));
  SUBCASE("of noise") {
    setting.noise_gain = Ball(2.0);
  }
  SUBCASE("of slew") {
    setting.slew_gain = Ball(10.0);
  }
  CHECK_FALSE(contracts_with(setting));
}

TEST_CASE("a set with amplitude zero in it is not proved, however generous the rate") {
  Setting setting = the_setting();
  setting.rate = Ball(1e6);
  CHECK(contracts_with(setting));
  setting.largest_amplitude = Ball(1.25);
  CHECK_FALSE(contracts_with(setting));
}

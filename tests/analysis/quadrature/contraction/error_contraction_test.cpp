#include "analysis/quadrature/contraction/error_contraction.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// A tracker with such a gain in amplitude and phase, whose covariance is known closely: r = 1 and nearly no
/// process noise.
StepSetting<Interval> setting_of(double gain, double largest_amplitude, double largest_chi, double noise) {
  const double variance = gain / (1.0 - gain);
  const auto covariance = [&](double factor) {
    return BlockCovariance<Interval>{Interval(factor * variance), Interval(factor * variance), Interval(0.0),
                                     Interval(factor * 1e-6)};
  };
  return {{Interval(1e-9), Interval(1e-9), Interval(1.0), Interval(0.0)},
          {Interval(1.0), Interval(1.0), Interval(0.0), Interval(1.0)},
          covariance(1.0),
          covariance(1.001),
          Interval(largest_amplitude),
          Interval(largest_chi),
          Interval(noise)};
}

/// So generous that nothing but the meaning of the step is in question.
StepConstants<Interval> generous(bool noisy = false) {
  return {Interval(1e6), Interval(1e6), Interval(1.0), noisy, false};
}

TEST_CASE("cells that cross the pole of the corrected estimate are not proved, however generous the rate") {
  const rigor::UpwardRounding upward;
  CHECK(prove_contraction(setting_of(0.9, 0.1, 1.3, 0.0), generous()).proved);
  // The estimate follows the signal, which lies behind the prediction.
  CHECK_FALSE(prove_contraction(setting_of(0.9, 0.1, 2.2, 0.0), generous()).proved);
  // The estimate hardly moves, and the signal lies behind it.
  CHECK(prove_contraction(setting_of(0.1, 0.1, 1.3, 0.0), generous()).proved);
  CHECK_FALSE(prove_contraction(setting_of(0.1, 0.1, 2.2, 0.0), generous()).proved);
  // Noise may carry it across.
  CHECK(prove_contraction(setting_of(0.5, 0.1, 0.5, 0.2), generous(true)).proved);
  CHECK_FALSE(prove_contraction(setting_of(0.5, 0.1, 0.5, 2.5), generous(true)).proved);
  CHECK_FALSE(prove_contraction(setting_of(0.5, 0.1, 0.5, 1e3), generous(true)).proved);
}

TEST_CASE(
    "every set of instructions finds the same of the same cells, where they hold and where they do not") {
  using trackers::InstructionSet;
  const rigor::UpwardRounding upward;
  test::Random random(82);
  int proved = 0;
  int many = 0;
  const std::int64_t count = test::effort(12);
  for (std::int64_t k = 0; k < count; ++k) {
    const bool noisy = k % 2 == 0;
    // One time in ten so much noise that nothing is known of where the corrections are.
    const double noise = !noisy ? 0.0 : k % 20 == 0 ? 1e200 : random.uniform(0.0, 0.3);
    const StepSetting<Interval> setting =
        setting_of(random.uniform(0.05, 0.95), random.uniform(0.02, 0.6), random.uniform(0.05, 2.5), noise);
    StepConstants<Interval> constants = generous(noisy);
    if (k % 3 != 0) {
      constants.rate_squared = Interval(random.uniform(0.9, 4.0));
      constants.noise_gain_squared = Interval(random.uniform(1.0, 10.0));
    }
    const ContractionOverSet one = prove_contraction(setting, constants, InstructionSet::sse2);
    proved += one.proved ? 1 : 0;
    many += one.cells > 128 ? 1 : 0;
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
      if (trackers::has(set)) {
        const ContractionOverSet other = prove_contraction(setting, constants, set);
        CHECK(other.proved == one.proved);
        CHECK(other.cells == one.cells);
        CHECK(other.reason == one.reason);
      }
    }
  }
  CHECK(proved > count / 10);
  CHECK(proved < count);
  CHECK(many > count / 10);
}

TEST_CASE("the angle to the axis is bounded over the whole cell, from above and closely") {
  const rigor::UpwardRounding upward;
  test::Random random(81);
  for (int k = 0; k < 2000; ++k) {
    const double axis = random.uniform(0.0, 3.14);
    const double low = axis - random.uniform(0.0, 1.5);
    const double high = axis + random.uniform(0.0, 1.5);
    const double found = tangent_squared_from(Interval(std::cos(axis)), Interval(std::sin(axis)), low, high);
    const double farther = std::max(axis - low, high - axis);
    const double exact = std::tan(farther) * std::tan(farther);
    CHECK(found >= exact * (1.0 - 1e-12));
    CHECK(found <= exact * (1.0 + 1e-9));
  }
  CHECK(std::isinf(tangent_squared_from(Interval(1.0), Interval(0.0), -0.5, 1.6)));
  CHECK(std::isinf(tangent_squared_from(Interval(1.0), Interval(0.0), -1.6, 0.5)));
}

}  // namespace
}  // namespace veritrack::quadrature

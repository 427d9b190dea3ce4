// The levels and disturbances that the bounds along a shape allow: the second half of shape_bounds.hpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/model/shape/shape_bounds.hpp"

namespace veritrack::model {
namespace {

/// At two phases, of which now one and now the other is the narrower.
std::vector<PhaseBounds> two_phases() {
  return {{.rate = 0.9,
           .disturbed_rate = 0.93,
           .second = 0.2,
           .third = 0.4,
           .mixed = 0.1,
           .sample = 0.3,
           .straight = 10.0,
           .reach = 1.0},
          {.rate = 0.95,
           .disturbed_rate = 0.96,
           .second = 0.05,
           .third = 0.1,
           .mixed = 0.2,
           .sample = 0.1,
           .straight = 10.0,
           .reach = 1.0}};
}

/// Whether |F| <= R by the formula of the bounds, in long double.
bool is_kept(const PhaseBounds& b, long double level, long double noise, long double squared) {
  const long double rate = b.disturbed_rate;
  const long double step = std::sqrt(rate * rate * level * level + squared) +
                           b.second * level * level / 2.0L + b.third * level * level * level / 6.0L +
                           b.mixed * level * noise + b.sample * noise * noise / 2.0L;
  return step <= level;
}

/// The largest size of a disturbance that some level keeps, by trying levels one after the other.
template <typename Kept>
long double largest_by_trial(const Kept& kept) {
  long double best = 0.0L;
  for (int i = 1; i <= 2000; ++i) {
    const long double level = 1e-3L * static_cast<long double>(i);
    while (kept(level, best * 1.0001L + 1e-7L)) {
      best = best * 1.0001L + 1e-7L;
    }
  }
  return best;
}

TEST_CASE("the largest starts, noise and slew are those that trying all levels finds") {
  const std::vector<PhaseBounds> bounds = two_phases();
  const double start = largest_start_level(bounds);
  const auto starts_kept = [&](long double level) {
    bool is = true;
    for (const PhaseBounds& b : bounds) {
      is = is && b.rate + b.second * level / 2.0L + b.third * level * level / 6.0L <= 1.0L;
    }
    return is;
  };
  CHECK(starts_kept(start * (1.0L - 1e-12L)));
  CHECK_FALSE(starts_kept(start * (1.0L + 1e-12L)));
  constexpr double kWeight = 0.5;
  const ToleratedDisturbance noise = largest_noise(bounds, kWeight);
  const auto all_keep = [&](long double level, long double of_noise, long double squared) {
    return is_kept(bounds[0], level, of_noise, squared) && is_kept(bounds[1], level, of_noise, squared);
  };
  const long double by_trial =
      largest_by_trial([&](long double level, long double v) { return all_keep(level, v, v * v / kWeight); });
  CHECK(noise.size == doctest::Approx(static_cast<double>(by_trial)).epsilon(2e-3));
  CHECK(all_keep(noise.level, 0.9999L * noise.size, std::pow(0.9999L * noise.size, 2) / kWeight));
  const ToleratedDisturbance slew = largest_slew(bounds, kWeight);
  const long double slew_by_trial = largest_by_trial(
      [&](long double level, long double w) { return all_keep(level, 0.0L, w * w / kWeight); });
  CHECK(slew.size == doctest::Approx(static_cast<double>(slew_by_trial)).epsilon(2e-3));
}

TEST_CASE("where the frequency bends, or nothing shrinks, no more is tolerated") {
  std::vector<PhaseBounds> bounds = two_phases();
  bounds[0].straight = 0.03125;
  CHECK(largest_start_level(bounds) == 0.03125);
  bounds[0].rate = bounds[0].disturbed_rate = 1.0;
  CHECK(largest_start_level(bounds) == 0.0);
  CHECK(largest_noise(bounds, 0.5).size == 0.0);
  CHECK(largest_slew(bounds, 0.5).size == 0.0);
  CHECK(largest_deviation(bounds, 0.5, 20.0).size == 0.0);
  CHECK(largest_start_level({}) == 0.0);
}

TEST_CASE("for Gaussian noise the level is where the mean no longer shrinks") {
  const std::vector<PhaseBounds> bounds = two_phases();
  constexpr long double kWeight = 0.5L, kExponent = 20.0L;
  const ToleratedDisturbance found =
      largest_deviation(bounds, static_cast<double>(kWeight), static_cast<double>(kExponent));
  const long double share = std::sqrt(kWeight / (2.0L * kExponent));
  CHECK(found.size == doctest::Approx(static_cast<double>(share * found.level)));
  // rate + R (second/2 + mixed share + 8 sample share^2/2) + third R^2/6 is 1 at one phase, less at the
  // other.
  long double largest = 0.0L;
  for (const PhaseBounds& b : bounds) {
    const long double r = found.level;
    largest =
        std::max(largest, b.disturbed_rate +
                              r * (b.second / 2.0L + b.mixed * share + 4.0L * b.sample * share * share) +
                              b.third * r * r / 6.0L);
  }
  CHECK(static_cast<double>(largest) == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("the level of the long run is the least that is never left, up to a step of the search") {
  const std::vector<PhaseBounds> bounds = two_phases();
  const DisturbanceWeights weights{0.5, 0.25};
  // Without second orders: R^2 (1 - rate^2) = 1/b at the worse phase.
  CHECK(long_run_level(bounds, weights, 0.0, 0.0) ==
        doctest::Approx(std::sqrt(1.0 / 0.5 / (1.0 - 0.96 * 0.96))));
  constexpr long double kNoise = 0.002L, kSlew = 0.001L;
  const long double squared = kNoise * kNoise / 0.5L + kSlew * kSlew / 0.25L;
  long double least = 1e-4L;
  while (!is_kept(bounds[0], least, kNoise, squared) || !is_kept(bounds[1], least, kNoise, squared)) {
    least *= 1.0001L;
    REQUIRE(least < 1.0L);
  }
  const double found = long_run_level(bounds, weights, 0.002, 0.001);
  CHECK(found >= 0.9998L * least);
  CHECK(found <= 1.021L * least);
  CHECK(long_run_level(bounds, weights, 1.0, 0.0) == std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace veritrack::model

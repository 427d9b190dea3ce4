// The static map in double beside its twin in long double, from the same filter states.
#include "analysis/kkl_observer/rounding/inverse_rounding.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;
using Long = long double;

/// The states of which a certificate for these rates may know so much.
template <int M>
FilterStatesOf<M> states_of(const Eigen::Matrix<double, M, 1>& rates, double ell, double largest_ell,
                            double low, double high) {
  FilterStatesOf<M> states;
  states.lambda = rigor::to_interval(rates);
  states.ell = Interval(ell);
  states.largest_ell = Interval(largest_ell);
  states.squared_frequency = Interval::from_bounds(low * low, high * high);
  states.least_amplitude = Interval(0.3);
  return states;
}

/// What the twin finds, and what is proved.
struct Compared {
  InverseRounding seen{0.0, 0.0}, proved{};
};

/// Filters near those of signals from `low` to `high`, moved at random.
template <int M>
Compared compare(const FilterStatesOf<M>& states, double low, double high, double moved,
                 test::Random& random) {
  Compared result;
  {
    const rigor::UpwardRounding upward;
    result.proved = inverse_rounding(states);
  }
  const Eigen::Matrix<double, M, 1> rates = rigor::midpoint(states.lambda);
  const trackers::KklObserverDesign<double, M> design{rates, states.ell.lower()};
  const trackers::KklObserverDesign<Long, M> twin{rates.template cast<Long>(),
                                                  static_cast<Long>(states.ell.lower())};
  std::int64_t inside = 0;
  for (std::int64_t i = 0; i < test::effort(20'000); ++i) {
    const double scale = std::exp2(random.uniform(-100.0, 100.0));
    Eigen::Matrix<double, M, 1> xi = trackers::kkl_transform<double, M>(
        trackers::oscillator_state(scale, random.uniform(0.0, 6.3), random.uniform(low, high)), rates);
    for (double& state : xi) {
      state += moved * scale * random.uniform(-1.0, 1.0);
    }
    const Eigen::Matrix<Long, M, 1> same = xi.template cast<Long>();
    const Long norm = std::sqrt(same.squaredNorm());
    const Eigen::Matrix<Long, M, 1> unit = same / norm;
    const auto exact = trackers::kkl_inverse<Long, M>(same, twin);
    const auto exact_units = trackers::in_engineering_units(exact);
    const Long ratio = trackers::kkl_excitation<Long, M>(unit, twin.lambda);
    const bool is_known = 2.0L * ratio >= states.largest_ell.upper() &&
                          exact(2) >= states.squared_frequency.lower() &&
                          exact(2) <= states.squared_frequency.upper() &&
                          exact_units.amplitude >= states.least_amplitude.upper() * norm;
    if (!is_known) {
      continue;
    }
    ++inside;
    const auto computed = trackers::in_engineering_units(trackers::kkl_inverse<double, M>(xi, design));
    result.seen.frequency = std::max(
        result.seen.frequency, static_cast<double>(std::fabs(computed.frequency - exact_units.frequency)));
    result.seen.amplitude =
        std::max(result.seen.amplitude,
                 static_cast<double>(std::fabs(computed.amplitude - exact_units.amplitude) / norm));
  }
  CHECK(inside > test::effort(20'000) / 20);
  return result;
}

TEST_CASE("no twin of the static map comes farther from it than the bound, at any scale") {
  test::Random random(281);
  const Eigen::Vector4d paper(1.0, 2.0, 3.0, 4.0);
  for (const double moved : {0.0, 1e-3}) {
    const Compared found = compare(states_of<4>(paper, 3e-4, 1e-3, 1.9, 4.1), 2.0, 4.0, moved, random);
    CHECK(found.seen.frequency <= found.proved.frequency);
    CHECK(found.seen.amplitude <= found.proved.amplitude);
    CHECK(found.proved.frequency < 300.0 * found.seen.frequency);
    CHECK(found.proved.amplitude < 10'000.0 * found.seen.amplitude);
  }
  // Rates in no order, some of them close.
  const Eigen::Vector4d others(0.7, 0.6, 5.0, 3.1);
  const Compared found = compare(states_of<4>(others, 1e-6, 1e-5, 0.3, 1.1), 0.4, 1.0, 1e-4, random);
  CHECK(found.seen.frequency <= found.proved.frequency);
  CHECK(found.seen.amplitude <= found.proved.amplitude);
  CHECK(found.proved.frequency < 1e-4);
}

TEST_CASE("the same of five and of eight filters") {
  test::Random random(282);
  const auto check = [&](const auto& states) {
    for (const double moved : {0.0, 1e-3}) {
      const Compared found = compare(states, 2.0, 4.0, moved, random);
      CHECK(found.seen.frequency <= found.proved.frequency);
      CHECK(found.seen.amplitude <= found.proved.amplitude);
      CHECK(found.proved.frequency < 1e-7);
    }
  };
  check(states_of<5>(Eigen::Matrix<double, 5, 1>::LinSpaced(1.0, 5.0), 3e-3, 8e-3, 1.9, 4.1));
  check(states_of<8>(Eigen::Matrix<double, 8, 1>::LinSpaced(1.0, 8.0), 3e-3, 8e-3, 1.9, 4.1));
}

TEST_CASE("there is no bound where mu may not be computed as zero, or little is known") {
  const rigor::UpwardRounding upward;
  const Eigen::Vector4d paper(1.0, 2.0, 3.0, 4.0);
  const auto is_bounded = [](const FilterStates& states) {
    const InverseRounding found = inverse_rounding(states);
    CHECK(std::isfinite(found.frequency) == std::isfinite(found.amplitude));
    return std::isfinite(found.frequency);
  };
  CHECK(is_bounded(states_of(paper, 9.99e-4, 1e-3, 2.0, 4.0)));
  CHECK_FALSE(is_bounded(states_of(paper, 1e-3, 1e-3, 2.0, 4.0)));
  CHECK_FALSE(is_bounded(states_of(paper, 5.0, 1e-3, 2.0, 4.0)));
  CHECK_FALSE(is_bounded(states_of(paper, 1e-15, 0.0, 2.0, 4.0)));
  CHECK_FALSE(is_bounded(states_of(paper, 1e-15, -1.0, 2.0, 4.0)));
  CHECK_FALSE(is_bounded(states_of(paper, 1e-3, 1e9, 2.0, 4.0)));  // no such states
  CHECK_FALSE(is_bounded(states_of(paper, 1e-15, 2e-15, 2.0, 4.0)));
  FilterStates unknown = states_of<4>(paper, 3e-4, 1e-3, 2.0, 4.0);
  unknown.squared_frequency = Interval::from_bounds(0.0, 16.0);
  CHECK_FALSE(is_bounded(unknown));
  unknown.squared_frequency = Interval();
  CHECK_FALSE(is_bounded(unknown));
  unknown = states_of<4>(paper, 3e-4, 1e-3, 2.0, 4.0);
  unknown.largest_ell = Interval();
  CHECK_FALSE(is_bounded(unknown));
}

}  // namespace
}  // namespace veritrack::kkl_observer

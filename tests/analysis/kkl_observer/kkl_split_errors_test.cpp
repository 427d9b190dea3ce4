// The bounds for any number of filters, against gamma, the observer that runs, and the bounds for four.
#include "analysis/kkl_observer/kkl_split_errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/kkl_observer/kkl_worst_case.hpp"
#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;
using rigor::Verdict;

template <int M>
using Rates = Eigen::Matrix<double, M, 1>;
constexpr double kSmallEll = 1e-5;

template <int M>
KklRobustnessQuestionOf<M> question(const Disturbance& disturbance, double low = 3.0, double high = 3.0) {
  KklRobustnessQuestionOf<M> q;
  q.range = {rigor::to_interval(Rates<M>::LinSpaced(1.0, M)), Interval::from_bounds(low, high)};
  q.amplitude = Interval(2.0);
  q.ell = Interval(kSmallEll);
  q.disturbance = disturbance;
  q.cells = 20'000;
  return q;
}

/// The largest errors of the running observer, from rest, at all samples after the settling time.
template <int M, typename Input>
SampledErrors largest_in_run(double settled, double amplitude, double frequency, double phase,
                             const Input& input) {
  constexpr double kInterval = 2e-3;
  trackers::KklObserver<double, M> observer({Rates<M>::LinSpaced(1.0, M), kSmallEll}, kInterval);
  const auto signal = [&](int k) {
    const double t = k * kInterval;
    return amplitude * std::sin(frequency * t + phase) + input(k, t);
  };
  SampledErrors largest;
  for (int k = 0; k * kInterval < settled + 12.0; ++k) {
    observer.step_interpolated(signal(k), signal(k + 1));
    if (k * kInterval > settled) {
      const auto estimate = observer.estimate();
      largest.frequency = std::max(largest.frequency, std::fabs(estimate.frequency - frequency));
      largest.amplitude = std::max(largest.amplitude, std::fabs(estimate.amplitude - amplitude));
    }
  }
  return largest;
}

void check_within(const SampledErrors& seen, const KklRobustness& bounds) {
  CHECK(seen.frequency <= bounds.frequency_error_bound.upper());
  CHECK(seen.amplitude <= bounds.amplitude_error_bound.upper());
}

void require_finite(const KklRobustness& bounds) {
  REQUIRE(rigor::is_finite(bounds.frequency_error_bound));
  REQUIRE(rigor::is_finite(bounds.amplitude_error_bound));
  REQUIRE(bounds.largest_ell.lower() > kSmallEll);
}

/// gamma at filters that are moved at random, and the equation on which the bounds rest.
template <int M>
void check_equation(test::Random& random) {
  using Errors = KklErrorMap<double, M>;
  Rates<M> lambda;
  double rate = 0.0;
  for (double& x : lambda) {
    x = rate += random.uniform(0.5, 1.5);
  }
  const double frequency = random.uniform(0.8, 4.0);
  const double phase = random.uniform(0.0, 6.3);
  const Errors map(lambda);
  const auto at = map.signal(frequency, phase);
  Rates<M> xi = trackers::kkl_transform<double, M>(trackers::oscillator_state(1.0, phase, frequency), lambda);
  // Moves of a size that leaves y its direction.
  typename Errors::template Filters<double> u;
  const double size = 0.1 * std::sqrt(Errors::squared_norm(at.projected));
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = size * random.uniform(-1.0, 1.0) / std::sqrt(1.0 * M);
    xi(static_cast<Eigen::Index>(i)) += u[i];
  }
  const auto x = trackers::kkl_inverse<double, M>(xi, {lambda, 0.0});
  const double e = x(2) - frequency * frequency;
  const auto estimate = trackers::in_engineering_units(x);
  const double found = map.squared_frequency_error(at, u, map.perturbed(at, u));
  CHECK(found == doctest::Approx(e).epsilon(1e-6).scale(1e-2));
  if (x(2) > 0.0) {  // else the filters are those of no oscillation
    CHECK(map.amplitude_error(at, u, found) ==
          doctest::Approx(estimate.amplitude - 1.0).epsilon(1e-5).scale(1e-2));
  }
  CHECK(map.excitation_ratio(at, u, map.perturbed(at, u)) ==
        doctest::Approx(trackers::kkl_excitation<double, M>(xi, lambda) / xi.squaredNorm()).epsilon(1e-6));
  // e |y0|^2 (1 + a) = -(1 + a) y0'v - (Pz)'Pv with v = N'(F^2 + s + e) u.
  typename Errors::template Filters<double> lifted;
  for (std::size_t i = 0; i < u.size(); ++i) {
    lifted[i] = (at.denominators[i] + e) * u[i];
  }
  typename Errors::template Across<double> z;
  typename Errors::template Across<double> v;
  for (std::size_t j = 0; j < z.size(); ++j) {
    z[j] = Errors::along(u, map.basis()[j]);
    v[j] = Errors::along(lifted, map.basis()[j]);
  }
  const double norm = Errors::squared_norm(at.projected);
  const double a = Errors::product(at.projected, z) / norm;
  const double first = Errors::product(at.projected, v);
  const double across = Errors::product(z, v) - a * first;  // (Pz)'Pv
  CHECK(-first / norm - across / (norm * (1.0 + a)) == doctest::Approx(e).epsilon(1e-6).scale(1e-2));
}

TEST_CASE("the equation for the error of x3 is true of gamma itself, for four to eight filters") {
  test::Random random(311);
  for (std::int64_t trial = 0; trial < test::effort(100); ++trial) {
    CAPTURE(trial);
    check_equation<4>(random);
    check_equation<5>(random);
    check_equation<6>(random);
    check_equation<7>(random);
    check_equation<8>(random);
  }
}

TEST_CASE("with four filters the bounds over signals come near those over signal and disturbance") {
  for (const Disturbance& disturbance : {Disturbance(SinusoidalDisturbance{Interval(0.2), Interval(100.0)}),
                                         Disturbance(SinusoidalDisturbance{Interval(0.1), Interval(10.0)}),
                                         Disturbance(BoundedDisturbance{Interval(0.002)})}) {
    auto q = question<4>(disturbance);
    const KklRobustness split = bound_kkl_errors_over_signals(q);
    require_finite(split);
    check_within(sample_errors(q), split);
    const KklRobustness searched = bound_kkl_errors(q);
    CHECK(split.frequency_error_bound.upper() <= 1.1 * searched.frequency_error_bound.upper());
    CHECK(split.amplitude_error_bound.upper() <= 1.25 * searched.amplitude_error_bound.upper());
    CHECK(split.largest_ell.lower() >= 0.7 * searched.largest_ell.lower());
    CHECK(identical(split.settling_time, searched.settling_time));
  }
}

template <int M>
void check_sinusoids(test::Random& random) {
  CAPTURE(M);
  const auto q = question<M>(SinusoidalDisturbance{Interval(0.2), Interval(50.0)});
  const KklRobustness bounds = bound_kkl_errors(q);
  require_finite(bounds);
  const SampledErrors sampled = sample_errors(q, 45);
  check_within(sampled, bounds);
  CHECK(bounds.frequency_error_bound.upper() <= 1.15 * sampled.frequency);
  CHECK(bounds.amplitude_error_bound.upper() <= 1.5 * sampled.amplitude);
  for (std::int64_t trial = 0; trial < test::effort(4); ++trial) {
    CAPTURE(trial);
    const double other = random.uniform(50.0, 60.0);
    const double phase = random.uniform(0.0, 6.3);
    // Interpolation between samples weakens what is added.
    check_within(largest_in_run<M>(bounds.settling_time.upper(), 2.0, 3.0, random.uniform(0.0, 6.3),
                                   [&](int, double t) { return 0.2 * std::sin(other * t + phase); }),
                 bounds);
  }
}

TEST_CASE(
    "a sinusoidal disturbance of more than four filters: simulated runs from rest stay within the bounds") {
  test::Random random(312);
  check_sinusoids<5>(random);
  check_sinusoids<8>(random);
}

template <int M>
void check_bounded(test::Random& random, double low, double high) {
  CAPTURE(M);
  constexpr double kBound = 0.004;
  auto q = question<M>(BoundedDisturbance{Interval(kBound)}, low, high);
  q.amplitude = Interval::from_bounds(2.0, 4.0);
  const KklRobustness bounds = bound_kkl_errors(q);
  require_finite(bounds);
  const SampledErrors sampled = sample_errors(q, 45);
  check_within(sampled, bounds);
  CHECK(bounds.frequency_error_bound.upper() <= 1.35 * sampled.frequency);
  for (std::int64_t trial = 0; trial < test::effort(5); ++trial) {
    CAPTURE(trial);
    // On and off at random times, from fast to slow; and noise.
    const double changes = std::pow(10.0, random.uniform(-3.0, 0.0));
    double level = kBound;
    int last = -1;
    const auto input = [&](int k, double) {
      if (k > last) {
        last = k;
        level = trial % 4 == 3               ? random.uniform(-kBound, kBound)
                : random.uniform() < changes ? -level
                                             : level;
      }
      return level;
    };
    check_within(largest_in_run<M>(bounds.settling_time.upper(), random.uniform(2.0, 4.0),
                                   random.uniform(low, high), random.uniform(0.0, 6.3), input),
                 bounds);
  }
}

TEST_CASE(
    "a bounded disturbance of more than four filters: simulated runs from rest stay within the bounds") {
  test::Random random(313);
  check_bounded<5>(random, 3.0, 3.0);
  check_bounded<6>(random, 2.5, 3.5);
  check_bounded<7>(random, 3.0, 3.0);
}

TEST_CASE("no disturbance: a thousandth of the frequency is left of the start") {
  const KklRobustness bounds = bound_kkl_errors(question<5>(NoDisturbance{}, 2.0, 4.0));
  require_finite(bounds);
  CHECK(bounds.frequency_error_bound.upper() < 0.004);
  check_within(
      largest_in_run<5>(bounds.settling_time.upper(), 2.0, 2.5, 0.3, [](int, double) { return 0.0; }),
      bounds);
}

TEST_CASE("a program with five filters that gets samples: a bound on rounding, but none for any sinusoid") {
  auto q = question<5>(BoundedDisturbance{Interval(0.002)});
  const KklRobustness continuous = bound_kkl_errors(q);
  q.interval = Interval(2e-3);
  const KklRobustness sampled = bound_kkl_errors(q);
  require_finite(sampled);
  CHECK(sampled.frequency_error_bound.upper() > continuous.frequency_error_bound.upper());
  CHECK(sampled.rounding.upper() > 0.0);
  CHECK(sampled.rounding.upper() < 1e-4);
  q.disturbance = SinusoidalDisturbance{Interval(0.2), Interval(100.0)};
  const auto found = derive_kkl_robustness(q);
  CHECK(found.verdict == Verdict::undecided);
  CHECK(found.conditions.front().reason.find("may have any samples") != std::string::npos);
}

TEST_CASE("five filters: an ell or a disturbance that is too large leaves everything undecided") {
  auto q = question<5>(SinusoidalDisturbance{Interval(0.2), Interval(100.0)});
  CHECK(derive_kkl_robustness(q).verdict == Verdict::proved);
  q.ell = Interval(5.0);
  auto large = question<5>(BoundedDisturbance{Interval(1.0)});
  large.cells = 2'000;
  for (const auto& asked : {q, large}) {
    const auto found = derive_kkl_robustness(asked);
    CHECK(found.verdict == Verdict::undecided);
    CHECK(theorems::find_quantity(found, "frequency_error_bound").not_applicable);
    for (const theorems::Condition& condition : found.conditions) {
      CHECK_MESSAGE(condition.verdict == Verdict::undecided, condition.id);
    }
  }
}

}  // namespace
}  // namespace veritrack::kkl_observer

#include "analysis/kkl_observer/kkl_robustness.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/kkl_observer/kkl_worst_case.hpp"
#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;
using rigor::Verdict;

KklRobustnessQuestion question(const Disturbance& disturbance, double low = 3.0, double high = 3.0) {
  KklRobustnessQuestion q;
  q.range = {rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0)), Interval::from_bounds(low, high)};
  q.amplitude = Interval(2.0);
  q.ell = Interval(3e-4);
  q.disturbance = disturbance;
  q.cells = 40'000;
  return q;
}

/// The largest errors of the running observer, from rest, at all samples after the settling time.
SampledErrors largest_in_run(const KklRobustness& bounds, double frequency, double phase, double disturbance,
                             double disturbance_frequency, double disturbance_phase) {
  constexpr double kInterval = 2e-3;
  trackers::KklObserver<double> observer({Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), 3e-4}, kInterval);
  const auto signal = [&](double t) {
    return 2.0 * std::sin(frequency * t + phase) +
           disturbance * std::sin(disturbance_frequency * t + disturbance_phase);
  };
  SampledErrors largest;
  const double settled = bounds.settling_time.upper();
  for (int k = 0; k * kInterval < settled + 15.0; ++k) {
    observer.step_interpolated(signal(k * kInterval), signal((k + 1) * kInterval));
    if (k * kInterval > settled) {
      const auto estimate = observer.estimate();
      largest.frequency = std::max(largest.frequency, std::fabs(estimate.frequency - frequency));
      largest.amplitude = std::max(largest.amplitude, std::fabs(estimate.amplitude - 2.0));
    }
  }
  return largest;
}

TEST_CASE("a sinusoidal disturbance: simulated runs from rest stay within the bounds once settled") {
  const auto q = question(SinusoidalDisturbance{Interval(0.2), Interval(50.0)});
  const KklRobustness bounds = bound_kkl_errors(q);
  REQUIRE(rigor::is_finite(bounds.frequency_error_bound));
  REQUIRE(rigor::is_finite(bounds.amplitude_error_bound));
  const SampledErrors sampled = sample_errors(q);
  CHECK(sampled.frequency <= bounds.frequency_error_bound.upper());
  CHECK(sampled.amplitude <= bounds.amplitude_error_bound.upper());
  CHECK(bounds.frequency_error_bound.upper() <= 1.15 * sampled.frequency);
  test::Random random(41);
  // Interpolation of the input between samples costs a little: 50 rad/s is sampled 63 times a period.
  for (std::int64_t trial = 0; trial < test::effort(10); ++trial) {
    CAPTURE(trial);
    const SampledErrors run = largest_in_run(bounds, 3.0, random.uniform(0.0, 6.3), 0.2,
                                             random.uniform(50.0, 60.0), random.uniform(0.0, 6.3));
    CHECK(run.frequency <= bounds.frequency_error_bound.upper() * 1.01);
    CHECK(run.amplitude <= bounds.amplitude_error_bound.upper() * 1.01);
  }
}

TEST_CASE("a bounded disturbance: the bang-bang input stays within the bounds, and comes near") {
  const auto q = question(BoundedDisturbance{Interval(0.002)});
  const KklRobustness bounds = bound_kkl_errors(q);
  REQUIRE(rigor::is_finite(bounds.frequency_error_bound));
  REQUIRE(rigor::is_finite(bounds.amplitude_error_bound));
  const SampledErrors sampled = sample_errors(q);
  CHECK(sampled.frequency <= bounds.frequency_error_bound.upper());
  CHECK(sampled.amplitude <= bounds.amplitude_error_bound.upper());
  CHECK(bounds.frequency_error_bound.upper() <= 1.5 * sampled.frequency);
}

TEST_CASE("a program that gets samples: its runs stay within the bounds, which a coarser interval widens") {
  auto q = question(BoundedDisturbance{Interval(0.002)});
  const KklRobustness continuous = bound_kkl_errors(q);
  q.interval = Interval(2e-3);
  const KklRobustness sampled = bound_kkl_errors(q);
  q.interval = Interval(2e-2);
  const KklRobustness coarse = bound_kkl_errors(q);
  REQUIRE(rigor::is_finite(coarse.frequency_error_bound));
  CHECK(sampled.frequency_error_bound.upper() > continuous.frequency_error_bound.upper());
  CHECK(coarse.frequency_error_bound.upper() > sampled.frequency_error_bound.upper());
  test::Random random(42);
  for (std::int64_t trial = 0; trial < test::effort(4); ++trial) {
    CAPTURE(trial);
    const SampledErrors run = largest_in_run(sampled, 3.0, random.uniform(0.0, 6.3), 0.002,
                                             random.uniform(0.5, 60.0), random.uniform(0.0, 6.3));
    CHECK(run.frequency <= sampled.frequency_error_bound.upper());
    CHECK(run.amplitude <= sampled.amplitude_error_bound.upper());
  }
}

TEST_CASE("samples of a sinusoid of any frequency may be any samples: undecided, with the reason") {
  auto q = question(SinusoidalDisturbance{Interval(0.2), Interval(100.0)});
  CHECK(derive_kkl_robustness(q).verdict == Verdict::proved);
  q.interval = Interval(1e-3);
  const auto found = derive_kkl_robustness(q);
  CHECK(found.verdict == Verdict::undecided);
  CHECK(found.conditions.front().reason.find("may have any samples") != std::string::npos);
  CHECK(theorems::find_quantity(found, "frequency_error_bound").not_applicable);
}

TEST_CASE("without a disturbance what is left is a thousandth of the frequency") {
  const KklRobustness bounds = bound_kkl_errors(question(NoDisturbance{}, 2.0, 4.0));
  CHECK(bounds.frequency_error_bound.upper() < 0.004);
  const SampledErrors run = largest_in_run(bounds, 2.5, 0.3, 0.0, 1.0, 0.0);
  CHECK(run.frequency <= bounds.frequency_error_bound.upper());
}

TEST_CASE("the same question has the same answer, bit by bit") {
  const auto q = question(SinusoidalDisturbance{Interval(0.2), Interval(100.0)}, 2.9, 3.1);
  const KklRobustness first = bound_kkl_errors(q);
  const KklRobustness second = bound_kkl_errors(q);
  CHECK(rigor::identical(first.frequency_error_bound, second.frequency_error_bound));
  CHECK(rigor::identical(first.amplitude_error_bound, second.amplitude_error_bound));
  CHECK(first.cells == second.cells);
}

TEST_CASE("an ell for which mu does not vanish, or a disturbance too large, leaves everything undecided") {
  auto q = question(SinusoidalDisturbance{Interval(0.2), Interval(100.0)});
  q.ell = Interval(5.0);
  const auto with_large_ell = derive_kkl_robustness(q);
  CHECK(with_large_ell.verdict == Verdict::undecided);
  CHECK(theorems::find_quantity(with_large_ell, "frequency_error_bound").not_applicable);
  // At 3 rad/s and the phase 0.785 rad the observer with ell = 5 estimates x3 as -0.144.
  for (const theorems::Condition& condition : with_large_ell.conditions) {
    CHECK_MESSAGE(condition.verdict == Verdict::undecided, condition.id);
  }
  auto large = question(BoundedDisturbance{Interval(1.0)});
  large.cells = 3'000;
  const auto with_large_disturbance = derive_kkl_robustness(large);
  CHECK(with_large_disturbance.verdict == Verdict::undecided);
  const rigor::UpwardRounding upward;
  // Where no ell is small enough, none is named.
  for (const auto* found : {&with_large_ell, &with_large_disturbance}) {
    const bool exists = rigor::certainly_positive(theorems::find_quantity(*found, "largest_ell").value);
    const std::string& reason = found->conditions.front().reason;
    CHECK((reason.find("is small enough)") != std::string::npos) == exists);
    CHECK((reason.find("(nan") == std::string::npos && reason.find("(0 ") == std::string::npos));
  }
}

TEST_CASE("a disturbance that leaves mu zero may still take the frequency away") {
  auto q = question(SinusoidalDisturbance{Interval(1.6), Interval(20.0)});
  q.cells = 4'000;
  const auto found = derive_kkl_robustness(q);
  for (const theorems::Condition& condition : found.conditions) {
    CHECK_MESSAGE((condition.verdict == Verdict::proved) == (condition.id == "regular"), condition.id);
  }
  CHECK(theorems::find_quantity(found, "frequency_error_bound").not_applicable);
  CHECK(found.verdict == Verdict::undecided);
}

}  // namespace
}  // namespace veritrack::kkl_observer

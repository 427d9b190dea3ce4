#include "analysis/quadrature/contraction/start_bounds.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

CertifiedSet some_set() {
  CertifiedSet set;
  set.metric << 2.0, 0.0, 0.0, 0.0, 3.0, -1.0, 0.0, 0.0, 4.0;
  set.radius = 1.0;
  set.covariance_lower = 0.1 * rigor::Matrix<3>::Identity();
  set.covariance_upper = 0.5 * rigor::Matrix<3>::Identity();
  set.noise = 0.1;
  set.slew = 0.05;
  set.rate = 0.9;
  set.noise_gain = 2.0;
  set.slew_gain = 1.5;
  return set;
}

sets::StartCovariance multiple_of_identity(double multiple) {
  return {rigor::to_interval(rigor::Matrix<3>(multiple * rigor::Matrix<3>::Identity())), Interval(1.0), true};
}

sets::ContractionQuestion some_question(double size) {
  sets::ContractionQuestion question;
  question.noise = Interval(0.02);
  question.slew = Interval(0.01);
  question.initial_amplitude_error = Interval(size);
  question.initial_phase_error = Interval(size);
  question.initial_frequency_error = Interval(size);
  question.start_covariance = multiple_of_identity(0.3);
  return question;
}

TEST_CASE("bounds and settling are those of the recursion for |T e|, with and without rounding") {
  test::Random random(91);
  for (int k = 0; k < 300; ++k) {
    CertifiedSet set = some_set();
    set.rate = random.uniform(0.3, 0.99);
    const bool rounds = k % 2 == 1;
    set.error_rounding = rounds ? random.uniform(0.0, 1e-3) : 0.0;
    const sets::ContractionQuestion question = some_question(random.uniform(0.0, 0.15));
    const double factor = random.uniform(1.05, 3.0);
    const rigor::UpwardRounding upward;
    const StartBounds bounds(question, set);
    REQUIRE(bounds.contains_starts());
    const Interval settled = Interval(factor) * bounds.ultimate_frequency_error();
    const auto samples = bounds.samples_until(settled);
    REQUIRE(samples.has_value());
    // The recursion itself, from the worst start.
    double level = bounds.start_level().upper();
    double largest = level;
    const double pushed = std::pow(2.0 * 0.02, 2) + std::pow(1.5 * 0.01, 2);
    for (int step = 0; step < 4000; ++step) {
      if (step >= samples->upper()) {
        CHECK(level / 4.0 <= settled.upper() * (1.0 + 1e-9));
      }
      if (!rounds && step + 1 == static_cast<int>(samples->upper())) {
        CHECK(level / 4.0 >= settled.lower() * (1.0 - 1e-9));  // not a sample too many
      }
      level = std::sqrt(set.rate * set.rate * level * level + pushed) + set.error_rounding;
      largest = std::max(largest, level);
    }
    CHECK(level / 4.0 == doctest::Approx(bounds.ultimate_frequency_error().upper()).epsilon(1e-6));
    CHECK(largest / 4.0 <= bounds.frequency_error_bound().upper() * (1.0 + 1e-9));
    CHECK(largest / 4.0 >= bounds.frequency_error_bound().upper() * (1.0 - 1e-6));
    CHECK_FALSE(bounds.samples_until(Interval(0.99) * bounds.ultimate_frequency_error()).has_value());
  }
}

TEST_CASE("without noise and slew rounding alone is left, and the level after a step has room for it") {
  const rigor::UpwardRounding upward;
  CertifiedSet set = some_set();
  set.error_rounding = 1e-12;
  const Interval none(0.0);
  CHECK(ultimate_level(set, none, none).lower() >= 0.999e-11);  // 1e-12 / (1 - 0.9)
  CHECK(ultimate_level(set, none, none).upper() <= 1.001e-11);
  CHECK(next_level(set, Interval(0.5), none, none).lower() > 0.45 + 0.99e-12);
  CHECK(next_level(set, Interval(0.5), none, none).upper() < 0.45 + 1.01e-12);
}

TEST_CASE("starts outside are not inside, nor those with another covariance or without numbers") {
  const rigor::UpwardRounding upward;
  CHECK_FALSE(StartBounds(some_question(0.5), some_set()).contains_starts());
  sets::ContractionQuestion question = some_question(0.01);
  question.start_covariance = multiple_of_identity(0.3);
  CHECK(StartBounds(question, some_set()).contains_starts());
  question.start_covariance = multiple_of_identity(0.6);
  CHECK_FALSE(StartBounds(question, some_set()).contains_starts());
  question.start_covariance.reset();
  CHECK_FALSE(StartBounds(question, some_set()).contains_starts());
  for (const Interval& bad : {Interval::empty(), Interval::entire()}) {
    question = some_question(0.01);
    question.initial_phase_error = bad;
    CHECK_FALSE(StartBounds(question, some_set()).contains_starts());
    question = some_question(0.01);
    question.noise = bad;
    const StartBounds bounds(question, some_set());
    CHECK_FALSE(rigor::is_finite(bounds.ultimate_frequency_error()));
    CHECK_FALSE(bounds.samples_until(Interval(0.1)).has_value());
  }
}

TEST_CASE("one set leads into another only when it ends within it") {
  const rigor::UpwardRounding upward;
  const Interval noise(0.02);
  const Interval slew(0.0);
  const CertifiedSet outer = some_set();
  CertifiedSet inner = outer;
  inner.covariance_lower = 0.09 * rigor::Matrix<3>::Identity();
  inner.covariance_upper = 0.51 * rigor::Matrix<3>::Identity();
  // The ultimate level of the outer set is 0.04 / sqrt(1 - 0.81) = 0.0918; its box reaches a little further.
  inner.radius = 0.25;
  CHECK(certainly_maps_into(outer, inner, noise, slew));
  inner.radius = 0.09;
  CHECK_FALSE(certainly_maps_into(outer, inner, noise, slew));
  inner.radius = 0.25;
  inner.covariance_upper = 0.49 * rigor::Matrix<3>::Identity();
  CHECK_FALSE(certainly_maps_into(outer, inner, noise, slew));
  inner.covariance_upper = 0.51 * rigor::Matrix<3>::Identity();
  inner.covariance_lower = 0.11 * rigor::Matrix<3>::Identity();
  CHECK_FALSE(certainly_maps_into(outer, inner, noise, slew));
  CHECK_FALSE(certainly_maps_into(outer, outer, Interval::empty(), slew));
  // Without noise errors shrink for ever; but they are never zero, and no level above zero is its own double.
  inner.covariance_lower = 0.09 * rigor::Matrix<3>::Identity();
  CHECK(certainly_maps_into(outer, inner, noise, slew));
  CHECK_FALSE(certainly_maps_into(outer, inner, Interval(0.0), slew));
}

}  // namespace
}  // namespace veritrack::quadrature

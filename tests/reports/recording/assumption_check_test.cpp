#include "reports/recording/assumption_check.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/reports/recording/recorded_tone.hpp"
#include "tests/support/random.hpp"

namespace veritrack::reports {
namespace {

certificates::SignalAssumptions assumptions(double noise, double slew) {
  certificates::SignalAssumptions assume;
  assume.frequency = {0.1, 3.0};
  assume.noise = noise;
  assume.slew = slew;
  return assume;
}

AssumptionFindings check(const certificates::SignalAssumptions& assume,
                         const std::vector<RecordedSample>& recording, int channels, double frequency) {
  AssumptionCheck check(assume, 64, channels, false);
  for (std::size_t k = 0; k < recording.size(); ++k) {
    check.push(static_cast<std::int64_t>(k), recording[k], frequency);
  }
  return check.findings();
}

TEST_CASE("a recording within the assumptions keeps to them") {
  for (const int channels : {1, 2}) {
    const auto count = static_cast<std::size_t>(test::effort(100000));
    const auto tone = test::recorded_tone(count, channels, 0.01, [](std::size_t) { return 0.7; });
    const AssumptionFindings found = check(assumptions(0.07, 0.0), tone, channels, 0.7);
    CHECK(found.keeps());
    CHECK(found.judged == static_cast<std::int64_t>(count / 64 * 64));
    CHECK(found.noise_deviation == doctest::Approx(0.01).epsilon(0.05));
    CHECK(found.distance_deviation == doctest::Approx(0.01).epsilon(0.05));
    CHECK(found.amplitude.least > 0.98);
    CHECK(found.amplitude.largest < 1.02);
  }
}

TEST_CASE("one sample that is too noisy is found, and its place") {
  auto tone = test::recorded_tone(6400, 2, 1e-4, [](std::size_t) { return 0.7; });
  tone[3000].in_phase += 0.05;
  const AssumptionFindings found = check(assumptions(0.03, 0.0), tone, 2, 0.7);
  REQUIRE(found.noise_exceeded.count() == 1);
  CHECK(found.noise_exceeded.kept().front().first == 3000);
  CHECK(found.noise_exceeded.kept().front().last == 3000);
  CHECK(found.largest_residual == doctest::Approx(0.05).epsilon(0.1));
}

TEST_CASE("an amplitude that is not the assumed one counts as noise") {
  auto tone = test::recorded_tone(6400, 2, 0.0, [](std::size_t) { return 0.7; });
  for (RecordedSample& sample : tone) {
    sample.in_phase *= 1.1;
    sample.quadrature *= 1.1;
  }
  const AssumptionFindings found = check(assumptions(0.05, 0.0), tone, 2, 0.7);
  CHECK(found.largest_distance == doctest::Approx(0.1));
  CHECK(found.largest_residual < 1e-9);
  CHECK(found.noise_exceeded.samples() == 6400);
  certificates::SignalAssumptions range = assumptions(0.05, 0.0);
  range.amplitude = {1.0, 1.2};
  CHECK(check(range, tone, 2, 0.7).keeps());
}

TEST_CASE("slew and band: a frequency that runs away is found where it does") {
  const auto tone = test::recorded_tone(64 * 100, 2, 1e-4, [](std::size_t k) {
    return k < 3200 ? 0.5 : 0.5 + 2e-6 * static_cast<double>(k - 3200);
  });
  const AssumptionFindings slow = check(assumptions(0.01, 3e-6), tone, 2, 0.503);
  CHECK(slow.slew_exceeded.count() == 0);
  const AssumptionFindings fast = check(assumptions(0.01, 1e-6), tone, 2, 0.503);
  REQUIRE(fast.slew_exceeded.count() == 1);
  CHECK(std::fabs(static_cast<double>(fast.slew_exceeded.kept().front().first) - 3200.0) <= 128.0);
  CHECK(fast.largest_slew == doctest::Approx(2e-6).epsilon(0.2));
  certificates::SignalAssumptions narrow = assumptions(0.01, 1e-5);
  narrow.frequency = {0.4, 0.505};
  const AssumptionFindings left = check(narrow, tone, 2, 0.503);
  REQUIRE(left.frequency_exceeded.count() == 1);
  // 0.505 is reached 2500 samples after the start of the slew.
  CHECK(std::fabs(static_cast<double>(left.frequency_exceeded.kept().front().first) - 5700.0) <= 128.0);
}

TEST_CASE("Gaussian noise is compared by its deviation") {
  const auto tone = test::recorded_tone(64 * 1000, 2, 0.1, [](std::size_t) { return 0.7; });
  certificates::SignalAssumptions assume = assumptions(0.0, 0.0);
  assume.noise.reset();
  assume.noise_deviation = 0.1;
  CHECK(check(assume, tone, 2, 0.7).keeps());
  assume.noise_deviation = 0.07;
  CHECK(check(assume, tone, 2, 0.7).noise_exceeded.samples() > 64 * 500);
}

TEST_CASE("stretches end at interruptions") {
  const auto tone = test::recorded_tone(200, 2, 0.0, [](std::size_t) { return 0.7; });
  AssumptionCheck check(assumptions(0.1, 0.0), 64, 2, false);
  for (std::size_t k = 0; k < tone.size(); ++k) {
    if (k == 100) {
      check.interrupt();
    }
    check.push(static_cast<std::int64_t>(k), tone[k], 0.7);
  }
  CHECK(check.findings().judged == 128);
  CHECK(check.findings().slew_root_mean_square == 0.0);
}

}  // namespace
}  // namespace veritrack::reports

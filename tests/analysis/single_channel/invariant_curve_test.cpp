#include "analysis/single_channel/invariant_curve.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/trackers/textbook_single_channel_ekf.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;
using rigor::Verdict;
using trackers::ToneModel;

SteadyStateBias bias_of(const ToneModel<double>& design, double frequency) {
  const rigor::UpwardRounding upward;
  return steady_state_bias(
      {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)},
      Interval(frequency));
}

TEST_CASE("a frequency beyond the band of the sampling has no bias") {
  for (const double frequency : {-0.5, 3.3, 4.0}) {
    const SteadyStateBias bias = bias_of({0.005, 0.005, 0.01, 0.01}, frequency);
    CHECK(bias.verdict == Verdict::undecided);
    CHECK(bias.reason.find("within [0, pi]") != std::string::npos);
  }
}

/// The frequency errors of the paper's filter on cos(omega k), in extended precision, after it has settled.
std::vector<double> settled_errors(const ToneModel<double>& design, double frequency) {
  using Vector3 = Eigen::Matrix<long double, 3, 1>;
  const long double omega = frequency;
  const Vector3 q(design.q1, design.q1, design.q2);
  test::TextbookSingleChannelEkf<long double> filter{q.asDiagonal(), design.r, design.epsilon,
                                                     Vector3(1.0L, 0.0L, omega),
                                                     Vector3::Constant(design.r + design.q2).asDiagonal()};
  std::vector<double> errors;
  for (int k = 1; k <= 22000; ++k) {
    filter.step(std::cos(omega * static_cast<long double>(k)));
    if (k > 2000) {
      errors.push_back(static_cast<double>(filter.x(2) - omega));
    }
  }
  return errors;
}

TEST_CASE("the enclosures of the bias hold what the paper's filter settles on") {
  struct Case {
    ToneModel<double> design;
    double frequency;
  };
  for (const auto& [design, frequency] :
       {Case{{0.005, 0.005, 0.01, 0.05}, 0.9}, Case{{0.005, 0.005, 0.01, 0.05}, 2.09},
        Case{{0.002, 0.01, 0.02, 0.01}, 1.3}}) {
    CAPTURE(frequency);
    const SteadyStateBias bias = bias_of(design, frequency);
    REQUIRE(bias.verdict == Verdict::proved);
    CHECK(bias.rate < 1.0);
    CHECK(rigor::width(bias.mean_bias) <= 1e-5);
    CHECK(rigor::width(bias.min_error) <= 1e-3);
    CHECK(rigor::width(bias.max_error) <= 1e-3);
    double sum = 0.0;
    const std::vector<double> errors = settled_errors(design, frequency);
    for (const double error : errors) {
      sum += error;
      CHECK(error >= bias.min_error.lower());
      CHECK(error <= bias.max_error.upper());
    }
    const double mean = sum / static_cast<double>(errors.size());
    CHECK(mean == doctest::Approx(rigor::midpoint(bias.mean_bias)).epsilon(1e-4));
    // 20000 samples come within 1e-3 rad of every phase.
    CHECK(*std::min_element(errors.begin(), errors.end()) <= bias.min_error.upper() + 1e-5);
    CHECK(*std::max_element(errors.begin(), errors.end()) >= bias.max_error.lower() - 1e-5);
  }
}

TEST_CASE("over an interval of frequencies the enclosures hold the bias at each of them") {
  const ToneModel<double> design{0.005, 0.005, 0.01, 0.05};
  for (const double frequency : {0.9, 1.5}) {
    const rigor::UpwardRounding upward;
    const Interval interval = Interval::from_bounds(frequency - 0.003, frequency + 0.003);
    const SteadyStateBias around = steady_state_bias(
        {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)}, interval);
    CAPTURE(around.reason);
    REQUIRE(around.verdict == Verdict::proved);
    CHECK(rigor::width(around.mean_bias) < 0.002);
    for (const double part : {-1.0, -0.3, 0.6, 1.0}) {
      const rigor::NearestRounding nearest;
      const std::vector<double> errors = settled_errors(design, frequency + 0.003 * part);
      double sum = 0.0;
      for (const double error : errors) {
        sum += error;
        CHECK(error >= around.min_error.lower());
        CHECK(error <= around.max_error.upper());
      }
      const double mean = sum / static_cast<double>(errors.size());
      CHECK(mean > around.mean_bias.lower() - 1e-5);  // a finite run has a slightly different mean
      CHECK(mean < around.mean_bias.upper() + 1e-5);
      CHECK(*std::min_element(errors.begin(), errors.end()) <= around.min_error.upper() + 1e-5);
      CHECK(*std::max_element(errors.begin(), errors.end()) >= around.max_error.lower() - 1e-5);
    }
  }
}

TEST_CASE("without a leak the error part of the steady state is exactly zero") {
  for (const double frequency : {0.52, 1.5, 2.6}) {
    const SteadyStateBias bias = bias_of({0.005, 0.005, 0.01, 0.0}, frequency);
    CHECK(bias.verdict == Verdict::proved);
    CHECK(bias.mean_bias == Interval(0.0));
    CHECK(bias.min_error == Interval(0.0));
    CHECK(bias.max_error == Interval(0.0));
  }
}

TEST_CASE(
    "without a leak the steady state is exact at every frequency between 0 and pi, with a tube or without") {
  for (const double frequency : {1e-6, 0.001, 3.14}) {
    const SteadyStateBias bias = bias_of({0.005, 0.005, 0.01, 0.0}, frequency);
    CAPTURE(bias.reason);
    CHECK(bias.verdict == Verdict::proved);
    CHECK(!bias.rate);
    CHECK(bias.min_error == Interval(0.0));
    CHECK(bias.max_error == Interval(0.0));
  }
  // The oracle: the errors of the filter die out there, too, if slowly.
  const double frequency = 3.0;
  trackers::SingleChannelEkf<double> tracker(
      {trackers::identity_process_noise(0.005), 0.01, 0.0},
      {1.0, 0.0, frequency + 1e-4, trackers::identity_process_noise(0.005)});
  for (int k = 1; k <= 4000; ++k) {
    tracker.step(std::cos(frequency * k));
  }
  CHECK(std::fabs(tracker.filtered().frequency - frequency) <= 1e-9);

  const rigor::UpwardRounding upward;
  const Interval inside(1.5);
  const auto settles = [](double q1, double q2, double r, double epsilon, const Interval& at) {
    return settles_exactly({Interval(q1), Interval(q2), Interval(r), Interval(epsilon)}, at);
  };
  CHECK(settles(0.005, 0.005, 0.01, 0.0, inside));
  CHECK_FALSE(settles(0.0, 0.005, 0.01, 0.0, inside));
  CHECK_FALSE(settles(0.005, 0.0, 0.01, 0.0, inside));
  CHECK_FALSE(settles(0.005, 0.005, 0.0, 0.0, inside));
  CHECK_FALSE(settles(0.005, 0.005, 0.01, 1e-300, inside));
  CHECK_FALSE(settles(0.005, 0.005, 0.01, 0.0, Interval(0.0)));
  CHECK_FALSE(settles(0.005, 0.005, 0.01, 0.0, Interval::from_bounds(-0.001, 0.003)));
  CHECK_FALSE(settles(0.005, 0.005, 0.01, 0.0, Interval::from_bounds(3.0, 3.1416)));
  CHECK_FALSE(settles(0.005, 0.005, 0.01, 0.0, Interval::empty()));
}

TEST_CASE("what is not verified is undecided, says why, and gives no number") {
  const auto check = [](const SteadyStateBias& bias) {
    CHECK(bias.verdict == Verdict::undecided);
    CHECK(!bias.reason.empty());
    CHECK(rigor::is_empty(bias.mean_bias));
    CHECK(rigor::is_empty(bias.min_error));
    CHECK(rigor::is_empty(bias.max_error));
  };
  check(bias_of({0.0, 0.005, 0.01, 0.0}, 0.9));      // no exponentially stable steady state
  check(bias_of({0.0, 0.005, 0.01, 0.05}, 0.52));    // the simulated tracker leaves the signal
  check(bias_of({0.005, 0.005, 0.01, 0.05}, -0.5));  // not a frequency of a sampled signal
  check(bias_of({0.005, 0.005, 0.01, 0.05}, 0.0));   // a constant is no tone
}

TEST_CASE("the enclosures do not depend on the number of threads") {
  const ToneModel<double> design{0.005, 0.005, 0.01, 0.05};
  const SteadyStateBias many = bias_of(design, 0.9);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const SteadyStateBias one = bias_of(design, 0.9);
  CHECK(rigor::identical(many.mean_bias, one.mean_bias));
  CHECK(rigor::identical(many.min_error, one.min_error));
  CHECK(rigor::identical(many.max_error, one.max_error));
  CHECK(many.rate == one.rate);
}

}  // namespace
}  // namespace veritrack::single_channel

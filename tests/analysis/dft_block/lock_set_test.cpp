#include "analysis/dft_block/lock_set.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <span>
#include <vector>

#include "analysis/dft_block/lock_certificate.hpp"
#include "analysis/dft_block/lock_search.hpp"
#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/dft_block/tones.hpp"
#include "tests/support/random.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace {

using namespace veritrack;
using dft_block::LockProblem;
using rigor::Interval;
using test::kPi;
using test::lock_problem;
using test::Random;
using test::tone_bins;

/// (-1)^m sinc(m + x) by its definition.
double tap(int m, double x) {
  const double d = m + x;
  const double sinc = d == 0.0 ? 1.0 : std::sin(kPi * d) / (kPi * d);
  return m % 2 == 0 ? sinc : -sinc;
}
double tap_slope(int m, double x) {
  constexpr double kStep = 1e-5;
  return (tap(m, x + kStep) - tap(m, x - kStep)) / (2.0 * kStep);
}

TEST_CASE("sums of the bins over a cell hold those of its points") {
  Random random(20'251);
  const std::int64_t cases = test::effort(300);
  for (std::int64_t i = 0; i < cases; ++i) {
    const int half_width = 1 + static_cast<int>(i % 4);
    const double wide = i % 3 == 0 ? 0.0 : random.uniform(0.0, 0.05);
    const double low = random.uniform(-half_width, half_width);
    const double error_low = random.uniform(-0.2, 0.2);
    const auto offsets = Interval::from_bounds(low, low + wide);
    const auto errors = Interval::from_bounds(error_low, error_low + wide);
    const rigor::UpwardRounding upward;
    const dft_block::ToneSums sums = dft_block::enclose_tone_sums(offsets, errors, half_width);
    const rigor::NearestRounding nearest;
    const double d = low + random.uniform(0.0, 1.0) * wide;
    const double x = d + error_low + random.uniform(0.0, 1.0) * wide;
    double value_value = 0.0;
    double slope_slope = 0.0;
    double value_slope = 0.0;
    double slope_true = 0.0;
    double slope_secant = 0.0;
    for (int m = -half_width; m <= half_width; ++m) {
      const double secant =
          std::fabs(x - d) > 1e-4 ? (tap(m, x) - tap(m, d)) / (x - d) : tap_slope(m, 0.5 * (x + d));
      value_value += tap(m, x) * tap(m, x);
      value_slope += tap(m, x) * tap_slope(m, x);
      slope_slope += tap_slope(m, x) * tap_slope(m, x);
      slope_true += tap_slope(m, x) * tap(m, d);
      slope_secant += tap_slope(m, x) * secant;
    }
    constexpr double kOracle = 1e-7;
    const auto holds = [&](const Interval& interval, double value) {
      return interval.lower() - kOracle <= value && value <= interval.upper() + kOracle;
    };
    CAPTURE(half_width);
    CAPTURE(d);
    CAPTURE(x);
    CHECK(holds(sums.value_value, value_value));
    CHECK(holds(sums.value_slope, value_slope));
    CHECK(holds(sums.slope_slope, slope_slope));
    CHECK(holds(sums.slope_true, slope_true));
    CHECK(holds(sums.slope_secant, slope_secant));
    CHECK(width(sums.value_value) < 3.0 * wide + 1e-9);
  }
}

/// The tracker itself, started on the border of a set and driven by noise and slew at their bounds: its
/// errors and covariances stay in the set, and its errors below what the derivation says.
TEST_CASE("the tracker stays in its set") {
  Random random(20'252);
  const LockProblem problem = lock_problem(-0.3, 0.3, 0.002, 0.002);
  dft_block::LockQuestion question{problem,        Interval(0.01), Interval(0.1),
                                   Interval(0.02), std::nullopt,   std::nullopt};
  const theorems::Derivation found = dft_block::derive_lock(question);
  REQUIRE(found.verdict == rigor::Verdict::proved);
  const auto bound = [&](const char* name) { return theorems::find_quantity(found, name).value.upper(); };
  const auto& numbers = found.evidence.at(0).numbers;
  const auto number = [&](const std::string& name) {
    for (const auto& [key, value] : numbers) {
      if (key == name) {
        return value;
      }
    }
    return 0.0;
  };
  const rigor::Matrix<3> frame = found.evidence.at(0).matrices.at(0).second;
  const double x1 = std::sqrt(1.0 / (4.0 * kPi));
  rigor::Matrix<3> to_start = rigor::Matrix<3>::Identity();  // from the middle of a block, relative
  to_start(0, 0) = x1;
  to_start(1, 2) = -kPi;
  double worst = 0.0;
  const std::int64_t runs = test::effort(40);
  for (std::int64_t run = 0; run < runs; ++run) {
    // A start anywhere on the border, with a covariance anywhere between its bounds.
    rigor::Vector<3> e(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    e *= number("radius") * 0.999 / e.norm();
    rigor::Vector<3> z = frame * e;
    double offset = random.uniform(-0.3, 0.3);
    double phase = random.uniform(-3, 3);
    const double scale =
        std::exp(random.uniform(-std::log(number("below")), std::log(number("above"))) * 0.999);
    trackers::DftBlockEstimate<double> prediction;
    prediction.root_amplitude = x1 * (1.0 + z(0));
    prediction.offset = offset + z(2);
    prediction.phase = phase + z(1) - kPi * z(2);
    prediction.covariance = to_start * (scale * frame * frame.transpose()) * to_start.transpose();
    const trackers::DftBlockDesign<double> design{5e-5, 1e-3, 2.5e-3, 12.5 / 4096.0, 0.0, 0.0};
    trackers::DftBlockEkf<double> tracker(design, prediction);
    rigor::Vector<3> pushed(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    for (int block = 0; block < 40; ++block) {
      auto bins = tone_bins(1.0, phase, offset, 2);
      double length = 0.0;
      std::vector<double> noise;
      // Noise along the columns of H, which moves the state, or anywhere.
      for (std::size_t i = 0; i < 2 * bins.size(); ++i) {
        noise.push_back(random.uniform(-1, 1) +
                        (run % 2 == 0 ? 5.0 * (i % 2 == 0 ? pushed(0) : pushed(1)) : 0.0));
        length += noise.back() * noise.back();
      }
      for (std::size_t i = 0; i < bins.size(); ++i) {
        bins[i].real += 0.002 * noise[2 * i] / std::sqrt(length);
        bins[i].imaginary += 0.002 * noise[2 * i + 1] / std::sqrt(length);
      }
      tracker.measurement_update(std::span<const trackers::DftBin<double>>(bins));
      worst = std::max(worst, std::fabs(tracker.filtered().offset - offset));
      tracker.time_update();
      phase += 2.0 * kPi * offset;
      offset = std::clamp(offset + 0.002 * (pushed(2) > 0.0 ? 1.0 : -1.0), -0.3, 0.3);
      const auto& next = tracker.predicted();
      z << next.root_amplitude / x1 - 1.0,
          std::remainder(next.phase - phase, 2.0 * kPi) + kPi * (next.offset - offset), next.offset - offset;
      const double radius = frame.triangularView<Eigen::Lower>().solve(z).norm();
      CHECK(radius <= number("radius"));
    }
  }
  CHECK(worst <=
        bound("offset_error_bound") * 2.0);  // starts on the border are farther than the assumed ones
  MESSAGE("worst offset error " << worst << " bins, proved " << bound("offset_error_bound"));
}

TEST_CASE("what is not true is not verified") {
  const LockProblem problem = lock_problem(0.2, 0.25, 0.001, 0.0);
  const dft_block::LockSearch search(problem);
  const auto set = search.set_for(0.3);
  REQUIRE(set);
  const auto rate = search.rate_for(*set, 0.3);
  REQUIRE(rate);
  const rigor::UpwardRounding upward;
  constexpr std::int64_t kCells = 20'000;
  const auto verified = [&](const dft_block::LockBounds& one, const dft_block::LockRate& fall) {
    const auto frame = dft_block::LockFrame::make(problem, one);
    return frame && frame->verify(fall, kCells);
  };
  CHECK(verified(*set, *rate));
  CHECK_FALSE(verified(*set, {rate->radius, 0.93 * rate->rate, rate->weight}));
  CHECK_FALSE(verified(*set, {4.0 * rate->radius, rate->rate, rate->weight}));
  CHECK_FALSE(verified({set->frame, 1.001, set->below, set->floor}, *rate));
  CHECK_FALSE(verified({set->frame, set->above, 1.001, set->floor}, *rate));
  CHECK_FALSE(verified(*set, {rate->radius, rate->rate, -rate->weight}));
  CHECK_FALSE(verified(*set, {NAN, rate->rate, rate->weight}));
  const auto floored = dft_block::LockFrame::make(problem, {set->frame, set->above, set->below, 0.9});
  REQUIRE(floored);
  CHECK_FALSE(rigor::is_finite(floored->disturbance()));
}

TEST_CASE("starts outside of every set are undecided") {
  dft_block::LockQuestion question{lock_problem(0.2, 0.22, 0.0, 0.0),
                                   Interval(0.01),
                                   Interval(2.5),
                                   Interval(0.4),
                                   std::nullopt,
                                   std::nullopt};
  const theorems::Derivation found = dft_block::derive_lock(question);
  CHECK(found.verdict == rigor::Verdict::undecided);
  question = {lock_problem(0.2, 0.22, 1.0, 0.0),
              Interval(0.0),
              Interval(0.0),
              Interval(0.0),
              std::nullopt,
              std::nullopt};
  CHECK(dft_block::derive_lock(question).verdict == rigor::Verdict::undecided);
}

}  // namespace

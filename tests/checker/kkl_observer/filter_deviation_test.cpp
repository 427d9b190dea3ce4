// The filters of the program against those of a twin, and what their inputs differ by.
#include "checker/kkl_observer/filter_deviation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using Long = long double;

const Eigen::Vector4d kFilterRates(1.0, 2.0, 3.0, 4.0);

checker::KklDesign design_of(double interval, double frequency = 3.0) {
  checker::KklDesign design;
  for (const double rate : kFilterRates) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = design.frequency_high = Ball(frequency);
  design.amplitude_low = design.amplitude_high = Ball(2.0);
  design.bound = Ball(0.1);
  design.sampling_interval = Ball(interval);
  return design;
}

bool is_bounded(const checker::KklDesign& design) {
  return filter_deviation(design)[0].finite();
}

}  // namespace

TEST_CASE("rounding of the steps is bounded: a twin driven by the same samples") {
  test::Random random(292);
  for (const double interval : {1e-3, 1e-5}) {
    CAPTURE(interval);
    // So low a frequency that its lines between samples are as good as exact.
    const auto bounds = filter_deviation(design_of(interval, 1e-9));
    trackers::KklObserver<double> program({kFilterRates, 1e-3}, interval);
    const trackers::KklDiscretization<Long, 4> twin(kFilterRates.cast<Long>(), static_cast<Long>(interval));
    Eigen::Matrix<Long, 4, 1> exact = Eigen::Matrix<Long, 4, 1>::Zero();
    double before = 0.0;
    std::array<double, 4> seen{};
    for (int k = 0; k < 20'000; ++k) {
      const double now = random.uniform(-2.1, 2.1);
      program.step_interpolated(before, now);
      exact = twin.interpolated(exact, before, now);
      before = now;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        const Long difference = static_cast<Long>(program.filters()(at)) - exact(at);
        seen[i] = std::max(seen[i], static_cast<double>(std::fabs(difference)) / 2.0);
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const double rate = kFilterRates(static_cast<Eigen::Index>(i));
      const double rounding = bounds[i].near() - 0x1p-31 / rate;
      CHECK(seen[i] > 0.0);
      CHECK(seen[i] <= rounding);
      CHECK(rounding <= 1e-16 / (rate * interval * interval) * 100.0);
    }
  }
}

TEST_CASE("lines between samples: a chord is off by what is allowed, and not by much less") {
  const double interval = 0.05;
  const double frequency = 4.0;
  const auto bounds = filter_deviation(design_of(interval, frequency));
  // A low-pass filter of a slow rate sees the mean of the difference, two thirds of the largest.
  const double sagitta = 1.0 - std::cos(0.5 * frequency * interval);
  for (std::size_t i = 0; i < 4; ++i) {
    const double rate = kFilterRates(static_cast<Eigen::Index>(i));
    CHECK(bounds[i].near() * rate >= sagitta);
    CHECK(bounds[i].near() * rate <= 1.01 * sagitta);
  }
}

TEST_CASE("without an interval: 1e-9 over the rates, and the neighbourhood") {
  checker::KklDesign design = design_of(1.0);
  design.sampling_interval.reset();
  const auto allowed = filter_deviation(design);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(allowed[i].near() * kFilterRates(static_cast<Eigen::Index>(i)) >= 1e-9 + 0x1p-31);
  }
}

TEST_CASE("nothing is known of a sinusoid's samples, of steps that lose everything, and out of range") {
  CHECK(is_bounded(design_of(1e-3)));
  checker::KklDesign design = design_of(1e-3);
  design.bound.reset();
  CHECK(is_bounded(design));
  design.disturbance_amplitude = Ball(0.1);
  design.disturbance_frequency = Ball(100.0);
  CHECK_FALSE(is_bounded(design));
  CHECK_FALSE(is_bounded(design_of(1e-8)));
  CHECK_FALSE(is_bounded(design_of(1e-17)));
  design = design_of(1e-3);
  design.amplitude_high = Ball(0x1p250);
  CHECK_FALSE(is_bounded(design));
  design.amplitude_low = design.amplitude_high = Ball(0x1p-250);
  design.bound.reset();
  CHECK_FALSE(is_bounded(design));
}

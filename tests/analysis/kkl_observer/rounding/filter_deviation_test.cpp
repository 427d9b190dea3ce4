// The filters of the program against the solution of their differential equations.
#include "analysis/kkl_observer/rounding/filter_deviation.hpp"

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

const Eigen::Vector4d kRates(1.0, 2.0, 3.0, 4.0);

KklRobustnessQuestion question_of(double low, double high, const Disturbance& disturbance, double interval) {
  KklRobustnessQuestion question;
  question.range = {rigor::to_interval(kRates), Interval(3.0)};
  question.amplitude = Interval::from_bounds(low, high);
  question.disturbance = disturbance;
  question.interval = Interval(interval);
  return question;
}

std::array<double, 4> proved(const KklRobustnessQuestion& question) {
  const rigor::UpwardRounding upward;
  std::array<double, 4> result{};
  const auto found = filter_deviation(question);
  for (std::size_t i = 0; i < found.size(); ++i) {
    result[i] = rigor::is_finite(found[i]) ? found[i].upper() : HUGE_VAL;
  }
  return result;
}

/// The largest distance of the program's filters from those of the tone and the disturbance straight between
/// its samples, over the amplitude. `bent`: the program gets the tone, too, as lines between samples, or the
/// twin does as well.
std::array<double, 4> seen(double amplitude, double bound, double interval, bool bent, int steps,
                           test::Random& random) {
  constexpr double kFrequency = 3.0;
  trackers::KklObserver<double> program({kRates, 3e-4}, interval);
  const Eigen::Matrix<Long, 4, 1> rates = kRates.cast<Long>();
  const trackers::KklDiscretization<Long, 4> exact(rates, static_cast<Long>(interval));
  const Long phase = random.uniform(0.0, 6.3);
  const auto tone = [&](int k) {
    return static_cast<Long>(amplitude) *
           std::sin(kFrequency * static_cast<Long>(interval) * static_cast<Long>(k) + phase);
  };
  const auto transformed = [&](int k) {
    return trackers::kkl_transform<Long, 4>(
        trackers::oscillator_state<Long>(
            amplitude, kFrequency * static_cast<Long>(interval) * static_cast<Long>(k) + phase, kFrequency),
        rates);
  };
  Eigen::Matrix<Long, 4, 1> driven = Eigen::Matrix<Long, 4, 1>::Zero();
  std::array<double, 4> largest{};
  Long before = random.uniform(-bound, bound);
  for (int k = 1; k <= steps; ++k) {
    const Long now = random.below(2) == 0 ? bound : -bound;
    program.step_interpolated(static_cast<double>(tone(k - 1) + before), static_cast<double>(tone(k) + now));
    const Long tone_before = bent ? 0.0L : tone(k - 1);
    const Long tone_now = bent ? 0.0L : tone(k);
    driven = exact.interpolated(driven, before + tone_before, now + tone_now);
    before = now;
    Eigen::Matrix<Long, 4, 1> expected = driven;
    if (bent) {
      const Eigen::Matrix<Long, 4, 1> settled = transformed(k);
      const Eigen::Matrix<Long, 4, 1> start = transformed(0);
      for (int i = 0; i < 4; ++i) {
        expected(i) += settled(i) - std::exp(-rates(i) * static_cast<Long>(interval) * k) * start(i);
      }
    }
    for (int i = 0; i < 4; ++i) {
      largest[static_cast<std::size_t>(i)] =
          std::max(largest[static_cast<std::size_t>(i)],
                   static_cast<double>(std::fabs(static_cast<Long>(program.filters()(i)) - expected(i)) /
                                       static_cast<Long>(amplitude)));
    }
  }
  return largest;
}

TEST_CASE("lines between samples: the program's filters are as near as is proved, and not much nearer") {
  test::Random random(282);
  for (const double interval : {0.1, 0.01, 1e-3}) {
    CAPTURE(interval);
    const auto bounds = proved(question_of(2.0, 2.0, BoundedDisturbance{Interval(0.1)}, interval));
    const int steps = std::min(20'000, static_cast<int>(20.0 / interval));
    const auto found = seen(2.0, 0.1, interval, true, steps, random);
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(i);
      CHECK(found[i] <= bounds[i]);
      CHECK(found[i] >= 0.2 * (bounds[i] - kNeighbourhood / kRates(static_cast<Eigen::Index>(i))));
    }
  }
}

TEST_CASE("rounding alone, at an interval where it is all there is, grows as the interval gets shorter") {
  test::Random random(283);
  double before = 0.0;
  for (const double interval : {1e-4, 1e-5}) {
    CAPTURE(interval);
    const auto bounds = proved(question_of(1.0, 1.0, BoundedDisturbance{Interval(0.3)}, interval));
    const auto found = seen(1.0, 0.3, interval, false, 20'000, random);
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(i);
      const double rate = kRates(static_cast<Eigen::Index>(i));
      const double straight = 9.0 * interval * interval / 8.0 / rate + kNeighbourhood / rate;
      CHECK(found[i] <= (bounds[i] - straight) / 16.0 * 1.01);
    }
    CHECK(found[0] > before);
    before = found[0];
  }
}

TEST_CASE(
    "without an interval the deviation is the one of the sentence, with room; none for a sinusoid's "
    "samples") {
  KklRobustnessQuestion question =
      question_of(1.0, 2.0, SinusoidalDisturbance{Interval(0.1), Interval(50.0)}, 1e-3);
  CHECK(proved(question)[0] == HUGE_VAL);
  question.disturbance = NoDisturbance{};
  CHECK(proved(question)[0] < 2e-6);
  question.interval.reset();
  for (const Disturbance& any :
       {Disturbance(NoDisturbance{}), question.disturbance, Disturbance(BoundedDisturbance{Interval(0.1)})}) {
    question.disturbance = any;
    const auto allowed = proved(question);
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      CHECK(allowed[i] * kRates(static_cast<Eigen::Index>(i)) >= 1e-9 + kNeighbourhood);
    }
  }
}

TEST_CASE("no bound where the signal may over- or underflow, or where the steps lose everything") {
  CHECK(std::isfinite(proved(question_of(1.0, 1.0, NoDisturbance{}, 1e-3))[0]));
  CHECK(proved(question_of(1.0, 0x1p250, NoDisturbance{}, 1e-3))[0] == HUGE_VAL);
  CHECK(proved(question_of(0x1p-250, 0x1p-249, NoDisturbance{}, 1e-3))[0] == HUGE_VAL);
  CHECK(proved(question_of(1.0, 1.0, NoDisturbance{}, 1e-17))[0] == HUGE_VAL);
  // A sum of roundings of the size of the filters themselves, beyond the states that it is about.
  CHECK(proved(question_of(1.0, 1.0, NoDisturbance{}, 1e-8))[0] == HUGE_VAL);
}

}  // namespace
}  // namespace veritrack::kkl_observer

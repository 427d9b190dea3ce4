// Angles, quotients and roots of waves, against complex numbers and the functions of <cmath>.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr double kTurnedLength = 1.5, kTurnedTone = 0.25;
constexpr double kHalfTurn = std::numbers::pi;

/// A sample of two channels seen from an angle that is `ahead` of its phase in the steady state.
struct TurnedSample {
  Frame frame{Interval(kTurnedLength), Interval(kTurnedTone), 2};
  FrameValue theta, w, factor, y1, y2, real, imaginary;

  explicit TurnedSample(double ahead)
      : theta(frame.state(0, true, 1, ahead, 1.0)),
        w(frame.state(1, false, 0, 0.5, 2.0)),  // 1 in the steady state
        factor(frame.constant(0, Interval(-0.3))),
        y1(frame.sample(0)),
        y2(frame.sample(1)),
        real(y1 * cos(theta) + y2 * sin(theta)),
        imaginary(y2 * cos(theta) - y1 * sin(theta)) {}
};

/// The bounds of forms and the sizes of inputs where states deviate by these, with this noise.
struct TurnedSizes {
  std::vector<double> inputs, forms;

  TurnedSizes(const Frame& frame, const std::vector<double>& deviation, double noise) {
    for (const FrameInput& input : frame.inputs()) {
      inputs.resize(static_cast<std::size_t>(input.first + input.components), 0.0);
    }
    for (std::size_t round = 0; round <= inputs.size(); ++round) {
      forms.clear();
      for (const FrameLine& form : frame.forms()) {
        forms.push_back(std::fabs(linear(form, deviation)) + room(form));
      }
      for (const FrameInput& input : frame.inputs()) {
        std::fill_n(inputs.begin() + input.first, input.components,
                    input.is_remainder ? input.at_bounds(forms) : input.at_noise(noise));
      }
    }
  }
  [[nodiscard]] static double linear(const FrameLine& line, const std::vector<double>& deviation) {
    double sum = 0.0;
    for (std::size_t i = 0; i < line.states.size(); ++i) {
      sum += rigor::midpoint(line.states[i]) * deviation[i];
    }
    return sum;
  }
  [[nodiscard]] double room(const FrameLine& line) const {
    double sum = 0.0;
    for (const auto& [component, weight] : line.inputs) {
      sum += rigor::magnitude(weight) * inputs.at(static_cast<std::size_t>(component));
    }
    return sum;
  }
  [[nodiscard]] bool keeps(const std::vector<FrameLimit>& limits) const {
    return std::all_of(limits.begin(), limits.end(), [&](const FrameLimit& limit) {
      return forms[static_cast<std::size_t>(limit.form)] < limit.room;
    });
  }
};

using TurnedFormula = std::function<FrameValue(const TurnedSample&)>;
using TurnedTruth = std::function<double(std::complex<double> turned, double w)>;

/// How often a value was bounded; each time it is within its line and remainders.
std::int64_t attack_turned(const TurnedFormula& formula, const TurnedTruth& truth, double largest_ahead,
                           std::uint64_t stream) {
  const rigor::UpwardRounding upward;
  test::Random random(stream);
  std::int64_t bounded = 0;
  for (std::int64_t trial = 0; trial < test::effort(600); ++trial) {
    const double ahead = random.uniform(-largest_ahead, largest_ahead);
    TurnedSample values(ahead);
    FrameLine line;
    try {
      line = values.frame.line_of(formula(values));
    } catch (const NoFrame&) {
      continue;
    }
    const std::vector<double> off{random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.5)};
    const double noise = random.below(2) == 0 ? 0.0 : kTurnedLength * random.uniform();
    const TurnedSizes sizes(values.frame, off, noise);
    const double room = sizes.room(line);
    if (!sizes.keeps(values.frame.limits()) || !(room < 1e3)) {
      continue;
    }
    ++bounded;
    const std::complex<double> turned =
        std::polar(kTurnedLength, -ahead - off[0]) + std::polar(noise, random.uniform(-kHalfTurn, kHalfTurn));
    const double middle = rigor::midpoint(line.constant) + rigor::midpoint(line.per_frequency) * kTurnedTone;
    const double far = std::fabs(truth(turned, 1.0 + off[1]) - middle - TurnedSizes::linear(line, off));
    CAPTURE(ahead);
    REQUIRE(far <= room + 1e-12);
  }
  return bounded;
}

TEST_CASE("the angle of a wave, of its conjugate and a quarter turn on, is that of the complex number") {
  const std::complex<double> quarter(0.0, 1.0);
  const std::int64_t few = test::effort(600) / 10;
  for (int quarters = 0; quarters < 4; ++quarters) {
    for (const bool is_conjugate : {false, true}) {
      const auto of = [&](const TurnedSample& v, bool is_real) {
        const FrameValue x = v.real;
        const FrameValue y = is_conjugate ? -v.imaginary : v.imaginary;
        const bool takes_x = is_real == (quarters % 2 == 0);
        const bool is_negative = is_real ? quarters == 1 || quarters == 2 : quarters >= 2;
        const FrameValue part = takes_x ? x : y;
        return is_negative ? -part : part;
      };
      const auto number = [&](std::complex<double> z) {
        return (is_conjugate ? std::conj(z) : z) * std::pow(quarter, quarters);
      };
      const std::uint64_t stream = 910 + static_cast<std::uint64_t>(quarters);
      CHECK(attack_turned([&](const auto& v) { return atan2(of(v, false), of(v, true)); },
                          [&](auto z, double) { return std::arg(number(z)); }, 7.0, stream) > few);
      CHECK(attack_turned([&](const auto& v) { return atan(of(v, false) / of(v, true)); },
                          [&](auto z, double) { return std::atan(number(z).imag() / number(z).real()); }, 7.0,
                          stream) > few);
    }
  }
}

TEST_CASE("a factor that is below 0 turns an angle by half a turn") {
  CHECK(attack_turned([](const auto& v) { return atan2(v.factor * v.imaginary, v.factor * v.real); },
                      [](auto z, double) { return std::arg(-0.3 * z); }, 7.0, 915) > test::effort(600) / 10);
}

TEST_CASE("an angle has its limit where the arc tangent jumps, and no steady state is there") {
  const rigor::UpwardRounding upward;
  for (const double ahead : {0.0, 0.4, -1.2, 2.9, 4.0}) {
    TurnedSample values(ahead);
    (void)atan2(values.imaginary, values.real);
    (void)atan(values.imaginary / values.real);
    REQUIRE(values.frame.limits().size() == 2);
    CHECK(values.frame.limits()[0].room ==
          doctest::Approx(kHalfTurn - std::fabs(std::remainder(ahead, 2.0 * kHalfTurn))));
    CHECK(values.frame.limits()[1].room ==
          doctest::Approx(0.5 * kHalfTurn - std::fabs(std::remainder(ahead, kHalfTurn))));
  }
  TurnedSample back(kHalfTurn);
  CHECK_THROWS_AS((void)atan2(back.imaginary, back.real), NoFrame);
  CHECK_NOTHROW((void)atan(back.imaginary / back.real));
  TurnedSample across(0.5 * kHalfTurn);
  CHECK_THROWS_AS((void)atan(across.imaginary / across.real), NoFrame);
}

TEST_CASE("the arc sine of a sine is the angle near 0, and falls half a turn away") {
  const std::int64_t few = test::effort(600) / 10;
  const auto angle = [](const TurnedSample& v) { return v.theta - atan2(v.y2, v.y1); };
  CHECK(attack_turned([&](const auto& v) { return asin(sin(angle(v))); },
                      [](auto z, double) { return std::asin(std::sin(-std::arg(z))); }, 7.0, 920) > few);
  CHECK(attack_turned([&](const auto& v) { return asin(-sin(angle(v))); },
                      [](auto z, double) { return std::asin(std::sin(std::arg(z))); }, 7.0, 921) > few);
}

TEST_CASE("quotients by constants, lengths and linear values, and roots of squares, are within their lines") {
  const std::int64_t few = test::effort(600) / 10;
  const auto square_of = [](const TurnedSample& v) { return v.real * v.real + v.imaginary * v.imaginary; };
  CHECK(attack_turned([](const auto& v) { return v.imaginary / FrameValue(8); },
                      [](auto z, double) { return z.imag() / 8.0; }, 1.0, 930) > few);
  CHECK(attack_turned([](const auto& v) { return v.imaginary / FrameValue(-3); },
                      [](auto z, double) { return z.imag() / -3.0; }, 1.0, 931) > few);
  CHECK(attack_turned([](const auto& v) { return v.real / (v.w * FrameValue(3)); },
                      [](auto z, double w) { return z.real() / (3.0 * w); }, 1.0, 932) > few);
  CHECK(attack_turned([&](const auto& v) { return v.real / sqrt(square_of(v)); },
                      [](auto z, double) { return z.real() / std::abs(z); }, 1.0, 933) > few);
  CHECK(attack_turned([&](const auto& v) { return sqrt(square_of(v) / FrameValue(4)); },
                      [](auto z, double) { return 0.5 * std::abs(z); }, 1.0, 934) > few);
  CHECK(attack_turned([&](const auto& v) { return sqrt(square_of(v) + square_of(v)); },
                      [](auto z, double) { return std::sqrt(2.0) * std::abs(z); }, 1.0, 935) > few);
  CHECK(attack_turned([&](const auto& v) { return tan(v.w) - v.w / FrameValue(-1); },
                      [](auto, double w) { return std::tan(w) + w; }, 1.0, 936) > few);
}

TEST_CASE("a value that stays within limits has the smaller distance as its room over the band") {
  const rigor::UpwardRounding upward;
  Frame frame(Interval(1.0), Interval::from_bounds(0.25, 0.5), 1);
  const FrameValue w = frame.state(0, false, 0, 0.0, 2.0);  // 0.5 to 1
  const auto number = [&](int place, double value) { return frame.constant(place, Interval(value)); };
  (void)stays_within(w, number(0, 0.375), number(1, 4.0));
  (void)stays_within(w, number(2, -4.0), number(3, 1.25));
  REQUIRE(frame.limits().size() == 2);
  CHECK(frame.limits()[0].room == 0.125);
  CHECK(frame.limits()[1].room == 0.25);
  CHECK_THROWS_AS((void)stays_within(w, number(4, 0.5), number(1, 4.0)), NoFrame);
  CHECK_THROWS_AS((void)stays_within(w, number(0, 0.375), w), NoFrame);
  CHECK_THROWS_AS((void)stays_within(frame.state(0, true, 1, 0.0, 1.0), number(2, -4.0), number(1, 4.0)),
                  NoFrame);
}

}  // namespace
}  // namespace veritrack::model

#include "analysis/model/gain/frame_value.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "trackers/model/piecewise.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using std::acos, std::asin, std::atan, std::atan2, std::cos, std::exp, std::log, std::sin, std::sqrt,
    std::tan;

/// The operands of a formula: two states (an angle, a number), two samples and two constants.
template <typename Scalar>
struct Operands {
  Scalar theta, w, y1, y2, k, l;
};

constexpr double kK = 0.3;
constexpr double kL = 0.7;
constexpr double kAmplitude = 1.25;

/// A frame at some frequencies, with the steady state theta = phi + omega, w = 2 omega.
struct Setting {
  Interval band = Interval::from_bounds(0.2, 0.2000001);
  Frame frame{Interval(kAmplitude), band, 2};
  Operands<FrameValue> values{
      frame.state(0, true, 1, 0.0, 1.0), frame.state(1, false, 0, 0.0, 2.0), frame.sample(0), frame.sample(1),
      frame.constant(0, Interval(kK)),   frame.constant(1, Interval(kL))};
};

/// Of the components, for deviations of this size: of noise first, because forms depend on it.
std::vector<double> sizes_of(const Frame& frame, double deviation, double noise) {
  std::vector<double> sizes(64, 0.0);
  for (const bool is_remainder : {false, true}) {
    for (const FrameInput& input : frame.inputs()) {
      if (input.is_remainder != is_remainder) {
        continue;
      }
      std::vector<double> bounds;
      for (const FrameLine& form : frame.forms()) {
        bounds.push_back(0.0);
        for (const Interval& each : form.states) {
          bounds.back() += rigor::magnitude(each) * deviation;
        }
        for (const auto& [component, each] : form.inputs) {
          bounds.back() += rigor::magnitude(each) * sizes[static_cast<std::size_t>(component)];
        }
      }
      const double size = is_remainder ? input.at_bounds(bounds) : input.at_noise(noise);
      std::fill_n(sizes.begin() + input.first, input.components, size);
    }
  }
  return sizes;
}

/// Each deviation and each noise stays within the linear form and the sizes of its inputs.
template <typename Formula>
void check(const Formula& formula, double deviation, double noise) {
  const rigor::UpwardRounding upward;
  Setting setting;
  const FrameLine line = setting.frame.line_of(formula(setting.values));
  CHECK(line.turns == 0);
  const std::vector<double> sizes = sizes_of(setting.frame, deviation, noise);
  test::Random random(37004);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    const double omega = setting.band.lower();
    const double phi = random.uniform(0.0, 6.0);
    const double off_theta = deviation * random.uniform(-1.0, 1.0);
    const double off_w = deviation * random.uniform(-1.0, 1.0);
    const std::complex<double> sample =
        std::polar(kAmplitude, phi + omega) +
        std::polar(noise * std::sqrt(random.uniform()), random.uniform(0.0, 7.0));
    const double value = formula(
        Operands<double>{phi + omega + off_theta, 2.0 * omega + off_w, sample.real(), sample.imag(), kK, kL});
    const auto weight = [&](std::size_t state) {
      return line.states.empty() ? 0.0 : rigor::midpoint(line.states[state]);
    };
    const double linear = rigor::midpoint(line.constant) + rigor::midpoint(line.per_frequency) * omega +
                          weight(0) * off_theta + weight(1) * off_w;
    double room = 1e-9;
    for (const auto& [component, each] : line.inputs) {
      room += rigor::magnitude(each) * sizes[static_cast<std::size_t>(component)];
    }
    CAPTURE(off_theta);
    CHECK(std::fabs(value - linear) <= room);
  }
}

const auto in_phase = [](const auto& v) { return v.y1 * cos(v.theta) + v.y2 * sin(v.theta); };
const auto quadrature = [](const auto& v) { return v.y2 * cos(v.theta) - v.y1 * sin(v.theta); };

TEST_CASE("every formula stays within its line, its noise and its remainders") {
  check([](const auto& v) { return quadrature(v); }, 0.5, 0.4);
  check([](const auto& v) { return v.k * quadrature(v) + v.l * in_phase(v); }, 0.5, 0.4);
  check([](const auto& v) { return atan2(quadrature(v), in_phase(v)); }, 1.0, 0.9);
  check([](const auto& v) { return atan2(v.k * quadrature(v), v.k * in_phase(v)); }, 1.0, 0.9);
  check([](const auto& v) { return atan(quadrature(v) / in_phase(v)); }, 0.5, 0.5);
  check([](const auto& v) { return quadrature(v) / in_phase(v); }, 0.4, 0.2);
  check(
      [](const auto& v) {
        return quadrature(v) / sqrt(in_phase(v) * in_phase(v) + quadrature(v) * quadrature(v));
      },
      0.5, 0.4);
  check([](const auto& v) { return in_phase(v) * quadrature(v); }, 0.5, 0.3);
  check([](const auto& v) { return v.y1 * v.y1 + v.y2 * v.y2; }, 0.5, 0.3);
  check([](const auto& v) { return v.w * quadrature(v); }, 0.3, 0.3);
  check([](const auto& v) { return v.w * v.w + v.k; }, 0.3, 0.0);
  check([](const auto& v) { return exp(v.w) / (v.l + v.w); }, 0.2, 0.0);
  check([](const auto& v) { return sqrt(v.w) + log(v.w) + atan(v.w) + tan(v.w); }, 0.1, 0.0);
  check([](const auto& v) { return asin(v.w) - acos(v.w) + sin(v.w) * v.k; }, 0.1, 0.0);
  check(
      [](const auto& v) { return atan2(sin(atan2(v.y2, v.y1) - v.theta), cos(atan2(v.y2, v.y1) - v.theta)); },
      1.0, 0.5);
  check([](const auto& v) { return atan2(quadrature(v), v.k * in_phase(v)); }, 0.2, 0.1);
  check([](const auto& v) { return atan2(v.w, v.l) - atan2(-v.w, v.k - v.l); }, 0.2, 0.0);
  check([](const auto& v) { return atan2(v.l * v.w, v.w - v.k); }, 0.05, 0.0);
}

// Of numbers, and of values by argument-dependent lookup.
using trackers::detail::minimum, trackers::detail::maximum, trackers::detail::absolute,
    trackers::detail::sign_of, trackers::detail::clamped, trackers::detail::chosen;

TEST_CASE("functions with kinks stay within their remainders, idle or not") {
  for (const double size : {0.01, 0.1, 0.3, 0.6, 1.5}) {
    CAPTURE(size);
    // w is 0.4, theta is theta, k is 0.3 and l 0.7.
    check([](const auto& v) { return clamped(v.w, v.k, v.l); }, size, 0.0);
    check([](const auto& v) { return clamped(v.w, -v.l, v.k); }, size, 0.0);
    check([](const auto& v) { return clamped(v.w, v.l, v.l + v.l); }, size, 0.0);
    check([](const auto& v) { return clamped(v.w - v.l, -v.k, v.k); }, size, 0.0);
    check([](const auto& v) { return clamped(quadrature(v), -v.k, v.l); }, 0.5 * size, 0.5 * size);
    check([](const auto& v) { return v.k * clamped(v.l * quadrature(v), -v.w, v.w + v.w); }, 0.5 * size,
          0.4 * size);
    check([](const auto& v) { return minimum(v.w, v.l) + maximum(v.w, v.k); }, size, 0.0);
    check([](const auto& v) { return minimum(v.w, v.k) - maximum(v.w, v.l); }, size, 0.0);
    check([](const auto& v) { return minimum(v.w, in_phase(v)); }, 0.5 * size, 0.2 * size);
    check([](const auto& v) { return absolute(v.w) + absolute(v.k - v.w) * v.l; }, size, 0.0);
    check([](const auto& v) { return absolute(quadrature(v)); }, 0.5 * size, 0.5 * size);
    check([](const auto& v) { return absolute(in_phase(v)); }, 0.5 * size, 0.3 * size);
    check([](const auto& v) { return v.w + clamped(v.k + v.l, v.k, v.l) + clamped(v.k - v.l, v.k, v.l); },
          size, 0.0);
  }
  // Signs and conditions: as long as their limits are kept.
  check([](const auto& v) { return sign_of(in_phase(v)) * quadrature(v); }, 0.3, 0.3);
  check([](const auto& v) { return chosen(v.k - v.w, exp(v.w), v.w * v.w); }, 0.05, 0.0);
}

TEST_CASE("a sign or a condition is a limit, and none at its jump or of what turns") {
  const rigor::UpwardRounding upward;
  Setting setting;
  const auto& v = setting.values;
  (void)sign_of(in_phase(v));
  REQUIRE(setting.frame.limits().size() == 1);
  CHECK(setting.frame.limits()[0].room == doctest::Approx(kAmplitude));
  (void)chosen(v.w - v.k, v.k, v.w);
  REQUIRE(setting.frame.limits().size() == 2);
  CHECK(setting.frame.limits()[1].room == doctest::Approx(0.1));
  CHECK_THROWS_AS((void)sign_of(quadrature(v)), NoFrame);
  CHECK_THROWS_AS((void)sign_of(v.theta), NoFrame);
  CHECK_THROWS_AS((void)absolute(v.y1), NoFrame);
  CHECK_THROWS_AS((void)clamped(v.theta, v.k, v.l), NoFrame);
  CHECK_THROWS_AS((void)chosen(v.theta, v.k, v.l), NoFrame);
  CHECK_THROWS_AS((void)clamped(v.w, v.l, v.k), NoFrame);  // limits upside down
  CHECK_FALSE(setting.frame.may_rest_at_kink());
  (void)absolute(quadrature(v));
  CHECK(setting.frame.may_rest_at_kink());
}

TEST_CASE("at a kink within a wide band the remainder is as large as the steady state is away from it") {
  const rigor::UpwardRounding upward;
  Frame frame(Interval(1.0), Interval::from_bounds(0.1, 0.3), 1);
  const FrameValue w = frame.state(0, false, 0, 0.0, 2.0);
  const FrameLine line = frame.line_of(maximum(w, frame.constant(0, Interval(0.4))));
  CHECK(frame.may_rest_at_kink());
  REQUIRE(line.inputs.size() == 1);
  REQUIRE(frame.inputs().size() == 1);
  // 0.4 + (w - 0.4)/2 and at most |w - 0.4|/2
  CHECK(line.states[0] == Interval(0.5));
  CHECK(frame.inputs()[0].at_bounds(std::vector<double>(frame.forms().size(), 0.0)) >= 0.1);
}

TEST_CASE("an angle times a factor whose sign is not known is not an angle") {
  const rigor::UpwardRounding upward;
  for (const bool is_known : {true, false}) {
    Setting setting;
    const FrameValue factor = setting.frame.constant(
        2, is_known ? Interval::from_bounds(-0.2, -0.1) : Interval::from_bounds(-0.1, 0.1));
    // A quarter of a turn from the steady state.
    const FrameValue y = factor * in_phase(setting.values);
    const FrameValue x = factor * -quadrature(setting.values);
    if (is_known) {
      CHECK_NOTHROW((void)atan2(y, x));
    } else {
      CHECK_THROWS_AS((void)atan2(y, x), NoFrame);
    }
  }
}

TEST_CASE("an arc tangent of both parts has no remainder, and a limit of half a turn") {
  const rigor::UpwardRounding upward;
  Setting setting;
  const FrameLine line = setting.frame.line_of(atan2(quadrature(setting.values), in_phase(setting.values)));
  CHECK(line.states[0] == Interval(-1.0));
  CHECK(line.states[1] == Interval(0.0));
  REQUIRE(setting.frame.limits().size() == 1);
  CHECK(setting.frame.limits()[0].room <= std::numbers::pi);
  CHECK(setting.frame.limits()[0].room > 3.14159);
  REQUIRE(setting.frame.inputs().size() == 1);
  CHECK_FALSE(setting.frame.inputs()[0].is_remainder);
  CHECK(setting.frame.inputs()[0].at_noise(0.5 * kAmplitude) >= std::asin(0.5));
  CHECK(setting.frame.inputs()[0].at_noise(0.5 * kAmplitude) <= std::asin(0.5) * (1.0 + 1e-15));
  CHECK(std::isinf(setting.frame.inputs()[0].at_noise(kAmplitude)));
}

TEST_CASE("the squared length of both channels does not depend on the angle") {
  const rigor::UpwardRounding upward;
  Setting setting;
  const auto& v = setting.values;
  const FrameValue length = sqrt(in_phase(v) * in_phase(v) + quadrature(v) * quadrature(v));
  REQUIRE(length.kind() == FrameValue::Kind::waves);
  REQUIRE(length.waves().size() == 1);
  CHECK(length.waves().begin()->first == Monomial{1, 0, 0, {}, {}});
  CHECK(length.waves().begin()->second.real == 1.0);
}

template <typename Formula>
void check_refused(const Formula& formula) {
  const rigor::UpwardRounding upward;
  Setting setting;
  CHECK_THROWS_AS((void)setting.frame.line_of(formula(setting.values)), NoFrame);
}

TEST_CASE("what depends on the phase, or on the turns of an angle, is refused") {
  check_refused([](const auto& v) { return v.y1 * cos(v.theta); });
  check_refused([](const auto& v) { return v.y2 * cos(v.theta) - v.k * v.y1 * sin(v.theta); });
  check_refused([](const auto& v) { return v.y1 + v.k; });
  check_refused([](const auto& v) { return sin(v.theta); });
  check_refused([](const auto& v) { return v.k * v.theta; });
  check_refused([](const auto& v) { return v.theta * v.theta; });
  check_refused([](const auto& v) { return exp(v.theta); });
  check_refused([](const auto& v) { return quadrature(v) * v.theta; });
  check_refused([](const auto& v) { return atan2(quadrature(v), v.y1); });
  check_refused([](const auto& v) { return atan2(quadrature(v), quadrature(v)); });  // of the origin
  check_refused([](const auto& v) { return atan(v.y2 / v.y1); });
  check_refused([](const auto& v) { return v.w / (v.w - v.w); });
  check_refused([](const auto& v) { return stays_within(v.w, v.k + v.l, v.l); });
}

TEST_CASE("constants with the same enclosure are not the same number") {
  const rigor::UpwardRounding upward;
  Frame frame(Interval(1.0), Interval(0.2), 1);
  const Interval same = Interval::from_bounds(0.1, 0.1000001);
  const FrameValue theta = frame.state(0, true, 1, 0.0, 1.0);
  const FrameValue k = frame.constant(0, same);
  const FrameValue l = frame.constant(1, same);
  const FrameValue y1 = frame.sample(0);
  const FrameValue y2 = frame.sample(1);
  CHECK_THROWS_AS((void)frame.line_of(k * (y2 * cos(theta)) - l * (y1 * sin(theta))), NoFrame);
  CHECK_NOTHROW((void)frame.line_of(k * (y2 * cos(theta)) - k * (y1 * sin(theta))));
}

/// What the next vector of an observer is: turned by w, and a share of the samples.
template <typename Scalar>
std::array<Scalar, 2> observed(const std::array<Scalar, 2>& p, const Scalar& w, const Scalar& y1,
                               const Scalar& y2, const Scalar& k, const Scalar& one) {
  const Scalar x1 = p[0] * cos(w) - p[1] * sin(w);
  const Scalar x2 = p[0] * sin(w) + p[1] * cos(w);
  const Scalar gain = k / (one + w);  // a factor that is no constant
  return {x1 + gain * (y1 - x1), x2 + gain * (y2 - x2)};
}

TEST_CASE("a vector whose length matters stays within the lines of its angle and its length") {
  const rigor::UpwardRounding upward;
  constexpr double kOmega = 0.2, kDeviation = 0.15, kNoise = 0.2;
  Frame frame(Interval(kAmplitude), Interval::from_bounds(kOmega, kOmega + 1e-7), 3);
  const FrameValue length = frame.state(1, false, 0, 1.1, 0.2);
  const FrameValue w = frame.state(2, false, 0, 0.0, 1.0);
  const int kLength = length.name();
  const auto next = observed<FrameValue>(frame.vector(0, 1, 0.1, 0.5, length), w, frame.sample(0),
                                         frame.sample(1), frame.constant(0, Interval(kK)), FrameValue(1));
  const auto lines = frame.polar_of(next[0], next[1], kLength, 1, 0.1, 0.5);
  CHECK(lines[0].turns == 1);
  CHECK(lines[0].is_modular);
  CHECK(lines[1].turns == 0);
  const std::vector<double> sizes = sizes_of(frame, kDeviation, kNoise);
  test::Random random(37005);
  for (std::int64_t trial = 0; trial < test::effort(1000); ++trial) {
    const double phi = random.uniform(0.0, 6.0);
    std::array<double, 3> off{};
    for (double& each : off) {
      each = kDeviation * random.uniform(-1.0, 1.0);
    }
    const std::complex<double> p = std::polar(1.1 + 0.2 * kOmega + off[1], phi + 0.1 + 0.5 * kOmega + off[0]);
    const std::complex<double> y = std::polar(kAmplitude, phi + kOmega) +
                                   std::polar(kNoise * std::sqrt(random.uniform()), random.uniform(0.0, 7.0));
    const auto after = observed<double>({p.real(), p.imag()}, kOmega + off[2], y.real(), y.imag(), kK, 1.0);
    const std::complex<double> made(after[0], after[1]);
    for (std::size_t part = 0; part < 2; ++part) {
      const FrameLine& line = lines[part];
      double linear =
          line.turns * phi + rigor::midpoint(line.constant) + rigor::midpoint(line.per_frequency) * kOmega;
      for (std::size_t i = 0; i < 3; ++i) {
        linear += rigor::midpoint(line.states[i]) * off[i];
      }
      double room = 1e-6;
      for (const auto& [component, each] : line.inputs) {
        room += rigor::magnitude(each) * sizes[static_cast<std::size_t>(component)];
      }
      const double error = part == 0 ? std::remainder(std::arg(made) - linear, 2.0 * std::numbers::pi)
                                     : std::abs(made) - linear;
      CHECK(std::fabs(error) <= room);
      CHECK(room < 1.0);  // or nothing was shown
    }
  }
  CHECK_THROWS_AS(
      (void)frame.polar_of(frame.sample(0), FrameValue(-1) * frame.sample(1), kLength, 1, 0.1, 0.5), NoFrame);
  CHECK_THROWS_AS((void)frame.polar_of(next[0], next[1], kLength, 0, 0.1, 0.5), NoFrame);  // it turns
  CHECK_THROWS_AS((void)frame.polar_of(frame.sample(0), frame.sample(1), kLength, 1, 3.1, 0.5),
                  NoFrame);  // it points backwards
}

TEST_CASE("a factor that may be 0 is not divided by, and its root is not taken") {
  const auto is_known = [](double least) {
    const rigor::UpwardRounding upward;
    Frame frame(Interval(kAmplitude), Interval(0.2), 1);
    const FrameValue g = frame.state(0, false, 0, least, 0.0);
    const FrameValue y1 = g * frame.sample(0);
    const FrameValue y2 = g * frame.sample(1);
    try {
      (void)frame.line_of(sqrt(y1 * y1 + y2 * y2));
      return frame.limits().size() == 1 && frame.limits()[0].room <= least;
    } catch (const NoFrame&) {
      return false;
    }
  };
  CHECK(is_known(0.5));
  CHECK_FALSE(is_known(0.0));
  CHECK_FALSE(is_known(-0.5));
}

TEST_CASE("of a vector of states the angle is known, up to whole turns, and its length nowhere") {
  const rigor::UpwardRounding upward;
  Frame frame(Interval(kAmplitude), Interval::from_bounds(0.2, 0.3), 3);
  const auto [p, r] = frame.vector(1, 1, 0.5, 0.0, FrameValue(1));
  const FrameValue y1 = frame.sample(0);
  const FrameValue y2 = frame.sample(1);
  // arg(y conj p) = omega - 0.5 - xi + the angle of noise
  const FrameLine turn = atan2(y2 * p - y1 * r, y1 * p + y2 * r).line();
  CHECK(turn.turns == 0);
  CHECK_FALSE(turn.is_modular);
  CHECK(turn.constant == Interval(-0.5));
  CHECK(turn.per_frequency == Interval(1.0));
  CHECK(turn.states[1] == Interval(-1.0));
  CHECK(turn.inputs.size() == 1);
  // The direction that follows: the samples, times any length.
  const FrameLine direction = frame.direction_of(FrameValue(-2) * y2, FrameValue(2) * y1);
  CHECK(direction.turns == 1);
  CHECK(direction.is_modular);
  CHECK(rigor::contains(direction.constant, 0.5 * std::numbers::pi));
  CHECK(direction.per_frequency == Interval(1.0));
  CHECK(direction.states.empty());
  for (const auto& refused : {std::pair(p, r), std::pair(y1 * p, y2 * p), std::pair(y1, y1),
                              std::pair(y1, FrameValue(2) * y2), std::pair(y1 + p, y2 + r)}) {
    CHECK_THROWS_AS((void)frame.direction_of(refused.first, refused.second), NoFrame);
  }
  CHECK_THROWS_AS((void)frame.line_of(y1 * p + y2 * r), NoFrame);
  CHECK_THROWS_AS((void)frame.line_of(p * p + r * r), NoFrame);
  CHECK_THROWS_AS((void)frame.line_of(y1 * p + y2 * r / sqrt(p * p + r * r)), NoFrame);
  CHECK_THROWS_AS((void)asin(p), NoFrame);
}

}  // namespace
}  // namespace veritrack::model

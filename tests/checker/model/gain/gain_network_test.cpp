// The network of a loop against the loop itself, which these tests write out in doubles: a step from any
// state near the steady one differs from the linear step by no more than the inputs, at their sizes.
#include "checker/model/gain/gain_network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

#include "checker/model/gain/detector_loop.hpp"
#include "tests/checker/model/gain/gain_loops.hpp"

namespace veritrack::checker {
namespace {

using test::Json;
using test::Loop;
using State = std::vector<double>;
constexpr double kPi = 3.14159265358979323846;

double turned(double angle) {
  return std::remainder(angle, 2.0 * kPi);
}

/// Whether a step of the loop is what the network says, with noise up to `noise` and deviations up to `size`.
template <typename Step>
bool covers(const Loop& loop, const Step& step, double noise, const State& size) {
  const GainNetwork network = loop.network();
  const std::size_t n = network.states();
  std::mt19937 random(7);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int trial = 0; trial < 2'000; ++trial) {
    const double phase = draw(-4.0, 4.0);
    const double omega = draw(loop.lowest, loop.highest);
    const double slew = draw(-1e-4, 1e-4);
    const std::complex<double> y =
        std::polar(draw(loop.least_amplitude, loop.largest_amplitude), phase + omega) +
        std::polar(noise * std::sqrt(draw(0.0, 1.0)), draw(-4.0, 4.0));
    State xi(n);
    State state(n);
    const auto steady = [&](std::size_t i, double at, double frequency) {
      return static_cast<double>(loop.steady[i].turns) * at + loop.steady[i].constant.near() +
             loop.steady[i].per_frequency.near() * frequency;
    };
    for (std::size_t i = 0; i < n; ++i) {
      xi[i] = draw(-size[i], size[i]);
      state[i] = steady(i, phase, omega) + xi[i];
    }
    const State next = step(state, y);
    // Bounds on the forms here, in their order.
    std::vector<double> sizes(network.inputs.size());
    std::vector<Ball> bounds;
    std::size_t known = 0;
    const auto learn = [&](std::size_t to) {
      for (; known < to; ++known) {
        const GainInput& input = network.inputs[known];
        std::vector<Ball> about;
        for (const std::size_t form : input.about) {
          about.push_back(bounds.at(form));
        }
        sizes[known] = (input.is_remainder() ? input.at_bounds(about) : input.size(Ball(noise), Ball(1e-4)))
                           .upper_double();
      }
    };
    for (const GainForm& form : network.forms) {
      double bound = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        bound += form.row[i].near() * xi[i];
      }
      bound = std::abs(bound);
      for (std::size_t i = 0; i < n; ++i) {
        bound += form.row[i].radius().upper_double() * std::abs(xi[i]);  // of the amplitudes
      }
      for (const auto& [input, factor] : form.direct) {
        learn(input + 1);
        bound +=
            std::hypot(abs(factor.first).upper_double(), abs(factor.second).upper_double()) * sizes[input];
      }
      bounds.emplace_back(bound + 1e-12);
    }
    learn(network.inputs.size());
    for (std::size_t i = 0; i < n; ++i) {
      double deviation = next[i] - steady(i, phase + omega, omega + slew);
      double spread = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        deviation -= network.matrix[i][j].near() * xi[j];
        spread += network.matrix[i][j].radius().upper_double() * std::abs(xi[j]);
      }
      for (std::size_t l = 0; l < network.inputs.size(); ++l) {
        const InputFactor& factor = network.inputs[l].column[i];
        spread += std::hypot(abs(factor.first).upper_double(), abs(factor.second).upper_double()) * sizes[l];
      }
      if (i == 0) {
        deviation = turned(deviation);  // the angle
      }
      if (!(std::abs(deviation) <= spread + 1e-9)) {
        MESSAGE(i << ": " << deviation << " above " << spread);
        return false;
      }
    }
  }
  return true;
}

/// The angle of the sample from that of the state.
double detector(const State& x, const std::complex<double>& y) {
  return std::arg(y * std::polar(1.0, -x[0]));
}

TEST_CASE("the network of a loop covers its steps") {
  CHECK(covers(test::motor_loop(),
               [](const State& x, std::complex<double> y) {
                 const double d = detector(x, y);
                 return State{x[0] + (x[1] + 2000 * d) / 12500, x[1] + 30000 * d / 12500};
               },
               0.5, {1.0, 3.0}));
  CHECK(covers(test::output_loop(),
               [](const State& x, std::complex<double> y) {
                 const double d = std::imag(y * std::polar(1.0, -x[0]));
                 const double f = x[1] + 0.001 * d;
                 return State{x[0] + f + 0.05 * d, f, f + 0.05 * d};
               },
               0.3, {2.0, 0.1, 0.1}));
}

/// A loop of two states with this detector, and k times it as the correction.
Loop loop_with(const std::string& detector_lines) {
  return {{"phase", "freq"},
          {{"a", "0.1"}, {"b", "0.1"}},
          detector_lines + "\nphase' = phase + freq + 0.1*d\nfreq' = freq + 0.01*d\n",
          "freq",
          {{1, 0.0, 1.0}, {0, 0.0, 1.0}}};
}

template <typename Detector>
bool covers_detector(Loop loop, const std::string& lines, const Detector& value, double noise = 0.2,
                     double size = 0.3) {
  const Loop named = loop_with(lines);
  loop.states = named.states;
  loop.parameters = named.parameters;
  loop.step = named.step;
  loop.frequency = named.frequency;
  loop.steady = named.steady;
  return covers(loop,
                [&](const State& x, std::complex<double> y) {
                  const double d = value(std::abs(y), detector(x, y), x);
                  return State{x[0] + x[1] + 0.1 * d, x[1] + 0.01 * d};
                },
                noise, {size, 0.05});
}

TEST_CASE("detectors of many kinds are covered, with amplitudes in a range") {
  Loop range = loop_with("");
  range.least_amplitude = 0.8;
  range.largest_amplitude = 1.3;
  Loop one_noise = loop_with("");
  one_noise.has_one_noise = true;
  Loop one_noise_in_range = range;
  one_noise_in_range.has_one_noise = true;
  const std::string parts = "s = q*cos(phase) - i*sin(phase)\nc = i*cos(phase) + q*sin(phase)\n";
  for (const Loop& loop : {loop_with(""), range, one_noise, one_noise_in_range}) {
    CHECK(covers_detector(loop, parts + "d = s",
                          [](double r, double t, const State&) { return r * std::sin(t); }));
    CHECK(covers_detector(loop, parts + "d = s/sqrt(i^2 + q^2)",
                          [](double, double t, const State&) { return std::sin(t); }));
    CHECK(covers_detector(loop, parts + "d = s/(i*i + q*q)",
                          [](double r, double t, const State&) { return std::sin(t) / r; }));
    CHECK(covers_detector(loop, parts + "d = s*c", [](double r, double t, const State&) {
      return r * r * std::sin(t) * std::cos(t);
    }));
    CHECK(
        covers_detector(loop, parts + "d = s/c", [](double, double t, const State&) { return std::tan(t); }));
    CHECK(covers_detector(loop, parts + "d = atan(s/c)", [](double, double t, const State&) { return t; }));
    CHECK(
        covers_detector(loop, parts + "d = -atan2(-s, c)", [](double, double t, const State&) { return t; }));
    CHECK(covers_detector(loop, parts + "d = atan2(-c, s) + pi/2",
                          [](double, double t, const State&) { return t; }));
    CHECK(covers_detector(loop, parts + "d = atan2(0.3*s, 0.3*c)",
                          [](double, double t, const State&) { return t; }));
    CHECK(covers_detector(
        loop, parts + "d = atan2(s, 0.9*c) + atan2(freq - 1, 0.5*c) - atan2(freq - 1, 0.5)",
        [](double r, double t, const State& x) {
          return std::atan2(r * std::sin(t), 0.9 * r * std::cos(t)) +
                 std::atan2(x[1] - 1, 0.5 * r * std::cos(t)) - std::atan2(x[1] - 1, 0.5);
        },
        0.1, 0.1));
    CHECK(covers_detector(loop, "d = sin(atan2(q, i) - phase)",
                          [](double, double t, const State&) { return std::sin(t); }));
    CHECK(covers_detector(loop, parts + "d = s*sqrt(1.5 + c)*exp(freq)",
                          [](double r, double t, const State& x) {
                            return r * std::sin(t) * std::sqrt(1.5 + r * std::cos(t)) * std::exp(x[1]);
                          }));
    CHECK(covers_detector(
        loop, parts + "e = stays_within(s, -2, 2)\nd = asin(e/4) + atan(e) - log(2 + e)/3 + log(2)/3",
        [](double r, double t, const State&) {
          const double e = r * std::sin(t);
          return std::asin(e / 4) + std::atan(e) - std::log(2 + e) / 3 + std::log(2.0) / 3;
        }));
    CHECK(covers_detector(loop, parts + "d = s/(1 + freq^2) + tan(s/3) - acos(s/5) + pi/2",
                          [](double r, double t, const State& x) {
                            const double e = r * std::sin(t);
                            return e / (1 + x[1] * x[1]) + std::tan(e / 3) - std::acos(e / 5) + kPi / 2;
                          }));
  }
}

TEST_CASE("functions with kinks are covered, idle or not, and with limits that move") {
  const std::string parts = "s = q*cos(phase) - i*sin(phase)\nc = i*cos(phase) + q*sin(phase)\n";
  Loop range = loop_with("");
  range.least_amplitude = 0.8;
  range.largest_amplitude = 1.3;
  for (const Loop& loop : {loop_with(""), range}) {
    for (const double size : {0.05, 0.2, 0.5}) {
      CAPTURE(size);
      const auto is_covered = [&](const std::string& lines, const auto& value) {
        CAPTURE(lines);
        CHECK(covers_detector(loop, parts + lines, value, size, size));
      };
      is_covered("d = clamp(s, -0.3, 0.4)",
                 [](double r, double t, const State&) { return std::clamp(r * std::sin(t), -0.3, 0.4); });
      is_covered("d = clamp(c, -0.3, 0.4) - 0.4", [](double r, double t, const State&) {
        return std::clamp(r * std::cos(t), -0.3, 0.4) - 0.4;
      });
      is_covered("d = clamp(s + c, 1, 3) - 1", [](double r, double t, const State&) {
        return std::clamp(r * (std::sin(t) + std::cos(t)), 1.0, 3.0) - 1;
      });
      is_covered("d = clamp(s, -c, c/2)", [](double r, double t, const State&) {
        const double s = r * std::sin(t);
        const double c = r * std::cos(t);
        return s < -c ? -c : c / 2 < s ? c / 2 : s;
      });
      is_covered("d = max(s, 0.1) + min(c, s) - 0.1", [](double r, double t, const State&) {
        const double s = r * std::sin(t);
        return std::max(s, 0.1) + std::min(r * std::cos(t), s) - 0.1;
      });
      is_covered("d = abs(c) - abs(s - 0.2) - 0.8*abs(s)", [](double r, double t, const State&) {
        const double s = r * std::sin(t);
        return std::abs(r * std::cos(t)) - std::abs(s - 0.2) - 0.8 * std::abs(s);
      });
    }
    CHECK(covers_detector(loop, parts + "d = sign(c)*s + if(c <= 0.1, 1, 0) - if(0.2 < c, 0, s)",
                          [](double r, double t, const State&) { return r * std::sin(t); }));
  }
  for (const char* lines : {"d = sign(s)", "d = if(s > 0, 0.1, -0.1)", "d = clamp(s, 0.1, -0.1)",
                            "d = abs(i)", "d = clamp(s, s, 2*s)", "d = if(phase > 0, s, c)"}) {
    CAPTURE(lines);
    CHECK_FALSE(loop_with(parts + lines).is_covered());
  }
  const auto is_at_rest = [&](const std::string& lines) {
    return loop_with(parts + lines).network().is_at_rest;
  };
  CHECK(is_at_rest("d = clamp(s, -0.1, 0.1)"));
  CHECK_FALSE(is_at_rest("d = max(s, 0) - max(-s, 0)"));
  // So near a kink that rounding of the steady state might decide its side.
  for (const char* lines : {"d = clamp(s, -%, 1)", "d = clamp(s, -1, %)", "d = max(s, -%)"}) {
    CAPTURE(lines);
    const auto with_distance = [&](const char* distance) {
      std::string text = lines;
      return text.replace(text.find('%'), 1, distance);
    };
    CHECK(is_at_rest(with_distance("0.000001")));
    CHECK_FALSE(is_at_rest(with_distance("0.0000009")));
  }
}

TEST_CASE("an arc tangent of two values is known off its cut") {
  const GainNetwork network = loop_with("d = atan2(freq - 1, -1 - freq) + 3*pi/4").network();
  const GainInput& input = network.inputs.at(0);
  REQUIRE(input.about.size() == 2);
  const auto size = [&](double along, double across) {
    return input.at_bounds({Ball(along), Ball(across)}).upper_double();
  };
  CHECK(size(0.2, 0.2) >= std::atan(0.2 / 0.8) - 0.2);
  CHECK(size(0.2, 0.2) <= 1.001 * (std::atan(0.2 / 0.8) - 0.2));
  CHECK(size(0.0, 0.3) >= 0.3 - std::atan(0.3));
  CHECK_FALSE(std::isfinite(size(1.0, 0.3)));
  // At freq = 0.5 the direction is 0.32 rad from the cut.
  CHECK(std::isfinite(size(0.2, 0.25)));
  CHECK_FALSE(std::isfinite(size(0.2, 0.27)));
}

TEST_CASE("a constant is clamped to limits on either side of which it is") {
  const std::string s = "s = q*cos(phase) - i*sin(phase)\n";
  const auto is_scaled = [&](const std::string& factor, double value) {
    CAPTURE(factor);
    CHECK(covers_detector(loop_with(""), s + "d = s*" + factor,
                          [&](double r, double t, const State&) { return value * r * std::sin(t); }));
  };
  is_scaled("clamp(a, 0.5, 2)", 0.5);
  is_scaled("clamp(a, 0.05, 2)", 0.1);
  is_scaled("clamp(a, -2, 0.05)", 0.05);
}

TEST_CASE(
    "the angle of a vector is half a turn off where its factor is negative, and unknown where it may be 0") {
  const auto with_factor = [](const std::string& factor) {
    Loop loop = loop_with(
        "s = a*(q*cos(phase) - i*sin(phase))\nc = a*(i*cos(phase) + q*sin(phase))\n"
        "d = atan2(s, c)");
    loop.parameters = {{"a", factor}, {"b", "0.1"}};
    return loop;
  };
  const auto steps_by = [](double sign) {
    return [sign](const State& x, std::complex<double> y) {
      const double d = std::arg(sign * y * std::polar(1.0, -x[0]));
      return State{x[0] + x[1] + 0.1 * d, x[1] + 0.01 * d};
    };
  };
  CHECK(covers(with_factor("0.1"), steps_by(1.0), 0.2, {0.3, 0.05}));
  // Half a turn off the phase is where the angle is 0.
  Loop negative = with_factor("-0.1");
  negative.steady[0].constant = pi();
  CHECK(covers(negative, steps_by(-1.0), 0.2, {0.3, 0.05}));
  CHECK_FALSE(with_factor("0.1 - 0.1").is_covered());
}

TEST_CASE("without noise the remainders alone cover a step") {
  const std::string parts = "s = q*cos(phase) - i*sin(phase)\nc = i*cos(phase) + q*sin(phase)\n";
  const auto covers_silent = [&](const std::string& lines, const auto& value) {
    return covers_detector(loop_with(""), lines, value, 0.0, 1.0);
  };
  CHECK(covers_silent(parts + "d = s", [](double, double t, const State&) { return std::sin(t); }));
  CHECK(covers_silent(parts + "d = c - 1", [](double, double t, const State&) { return std::cos(t) - 1.0; }));
  CHECK(covers_silent(parts + "d = 0.3*s - 0.7*c + 0.7", [](double, double t, const State&) {
    return 0.3 * std::sin(t) - 0.7 * std::cos(t) + 0.7;
  }));
  CHECK(covers_silent(parts + "e = stays_within(s, -9, 9)\nd = e*e",
                      [](double, double t, const State&) { return std::sin(t) * std::sin(t); }));
}

TEST_CASE("a loop of frequency alone, by the angle between two samples") {
  const Loop loop{
      {"phase", "freq"},
      Json::object(),
      "a = atan2(q, i)\ne = a - phase - freq\nphase' = a\nfreq' = freq + 0.1*atan2(sin(e), cos(e))\n",
      "freq",
      {{1, 0.0, 0.0}, {0, 0.0, 1.0}},
      -0.5,
      0.5};
  CHECK(covers(loop,
               [](const State& x, std::complex<double> y) {
                 const double a = std::arg(y);
                 return State{a, x[1] + 0.1 * std::remainder(a - x[0] - x[1], 2.0 * kPi)};
               },
               0.3, {1.0, 0.5}));
}

TEST_CASE("what the rules do not cover says nothing") {
  const auto is_covered = [](const std::string& lines) { return loop_with(lines).is_covered(); };
  const std::string parts = "s = q*cos(phase) - i*sin(phase)\nc = i*cos(phase) + q*sin(phase)\n";
  CHECK(is_covered(parts + "d = s"));
  CHECK_FALSE(is_covered("d = q*cos(phase)"));                     // twice the phase is left
  CHECK_FALSE(is_covered("d = q*cos(phase) - 0.9*i*sin(phase)"));  // one channel is stronger
  CHECK_FALSE(is_covered("d = q*cos(2*phase) - i*sin(2*phase)"));  // not the phase of the signal
  CHECK_FALSE(is_covered("d = q - phase"));                        // an angle as a number
  CHECK_FALSE(is_covered("d = 0.5*phase"));
  CHECK_FALSE(is_covered("d = atan2(q, i)/2 - phase/2"));  // halves of angles known modulo 2 pi
  CHECK_FALSE(is_covered(parts + "d = atan2(s, i)"));
  CHECK_FALSE(is_covered(parts + "d = atan2(s, s)"));  // of the origin
  CHECK_FALSE(is_covered(parts + "d = stays_within(phase, -9, 9)"));
  CHECK_FALSE(is_covered(parts + "d = sqrt(s - 2)"));
  CHECK_FALSE(is_covered("d = atan2(q, i) - phase"));  // a state known modulo 2 pi
  Loop other = loop_with(parts + "d = s");
  other.frequency = "freq + 0*phase";
  CHECK_FALSE(other.is_covered());
  other = loop_with(parts + "d = s");
  other.steady[0].turns = 2;
  CHECK_FALSE(other.is_covered());
  other.steady[0].turns = 0;
  CHECK_FALSE(other.is_covered());
}

TEST_CASE("a state turns as its steady state does, and is an angle if it is known modulo a turn") {
  const auto with_extra = [](const std::string& line, long turns, const std::vector<std::string>& angles) {
    Loop loop = loop_with("d = q*cos(phase) - i*sin(phase)\nextra' = " + line);
    loop.states = {"phase", "freq", "extra"};
    loop.steady.push_back({turns, 0.0, Ball(static_cast<double>(turns))});
    loop.angles = angles;
    return loop.is_covered();
  };
  CHECK(with_extra("atan2(q, i)", 1, {"phase", "extra"}));
  CHECK_FALSE(with_extra("atan2(q, i)", 0, {"phase", "extra"}));
  CHECK_FALSE(with_extra("atan2(q, i)", 2, {"phase", "extra"}));
  CHECK_FALSE(with_extra("atan2(q, i)", 1, {"phase"}));
  CHECK(with_extra("atan2(q, i) - phase", 0, {"phase", "extra"}));
  CHECK_FALSE(with_extra("atan2(q, i) - phase", 0, {"phase"}));
  CHECK_FALSE(with_extra("q", 0, {"phase"}));
}

TEST_CASE("constants are the same by their place, not by their balls") {
  // a and b are both 0.1: each is the decimal or the double, and they may differ.
  CHECK(loop_with("d = a*q*cos(phase) - a*i*sin(phase)").is_covered());
  CHECK(loop_with("d = q*cos(phase)*a*b - sin(phase)*(b*i)*a").is_covered());
  CHECK_FALSE(loop_with("d = a*q*cos(phase) - b*i*sin(phase)").is_covered());
  // 0.5 is one number.
  Loop exact = loop_with("d = a*q*cos(phase) - b*i*sin(phase)");
  exact.parameters = {{"a", "0.5"}, {"b", "0.50"}};
  CHECK(exact.is_covered());
}

TEST_CASE("remainders are about what is computed before") {
  for (const Loop& loop :
       {test::motor_loop(), test::output_loop(), test::third_order_loop(), test::gnss_loop()}) {
    const GainNetwork network = loop.network();
    for (std::size_t input = 0; input < network.inputs.size(); ++input) {
      for (const std::size_t form : network.inputs[input].about) {
        for (const auto& direct : network.forms[form].direct) {
          CHECK(direct.first < input);
        }
      }
    }
  }
}

/// The turn from the last pair of samples to this one, smoothed; what is kept of the samples by these lines.
Loop turn_loop(const std::string& kept = "p' = i\nr' = q") {
  Loop loop{{"p", "r", "w"},
            {{"g", "0.2"}},
            "e = atan2(q*p - i*r, i*p + q*r) - w\nw' = w + g*e\n" + kept + "\n",
            "w",
            {{1, 0.0, 0.0, 1}, {0, 0.0, 0.0}, {0, 0.0, 1.0}}};
  loop.angles = {};
  return loop;
}

TEST_CASE("of a vector of states the direction alone is in the network, whatever its length") {
  std::mt19937 random(11);
  const auto step = [&](const State& x, std::complex<double> y) {
    const double length = std::exp(std::uniform_real_distribution<>(-6.0, 6.0)(random));
    const double e = std::arg(y * std::conj(std::polar(length, x[0]))) - x[2];
    return State{std::arg(y), 0.0, x[2] + 0.2 * e};
  };
  CHECK(covers(turn_loop(), step, 0.4, {0.5, 0.0, 0.1}));
  CHECK(covers(turn_loop("n = sqrt(i^2 + q^2)\np' = 3*i/n\nr' = 3*q/n"), step, 0.4, {0.5, 0.0, 0.1}));
  Loop off = turn_loop("p' = -q\nr' = i");  // a quarter of a turn further
  off.steady[0].constant = pi() * half;
  CHECK(off.is_covered());
  const GainNetwork network = turn_loop().network();
  for (std::size_t j = 0; j < 3; ++j) {
    CHECK(certainly_equal(network.matrix[0][j], zero));
    CHECK(certainly_equal(network.matrix[1][j], zero));
    CHECK(certainly_equal(network.matrix[2][1], zero));
  }
  CHECK(network.is_at_rest);
  CHECK_FALSE(detector_loop(network).has_value());  // its gain is not that of an angle that is kept
}

/// An observer of both parts of the signal: angle, length, frequency.
Loop observer_loop() {
  Loop loop{{"p", "r", "w"},
            {{"k", "0.3"}, {"g", "0.05"}},
            "x = p*cos(w) - r*sin(w)\nz = p*sin(w) + r*cos(w)\n"
            "p' = x + k*(i - x)\nr' = z + k*(q - z)\nw' = w + g*(q*x - i*z)/(1 + w^2)\n",
            "w",
            {{1, 0.0, 0.0, 1}, {0, 1.0, 0.0}, {0, 0.0, 1.0}}};
  loop.angles = {};
  return loop;
}

TEST_CASE("a vector whose length matters is an angle and a length") {
  const auto step = [](const State& x, std::complex<double> y) {
    const std::complex<double> p = std::polar(x[1], x[0] + x[2]);
    const std::complex<double> next = p + 0.3 * (y - p);
    return State{std::arg(next), std::abs(next),
                 x[2] + 0.05 * std::imag(y * std::conj(p)) / (1 + x[2] * x[2])};
  };
  CHECK(covers(observer_loop(), step, 0.3, {0.2, 0.2, 0.1}));
  CHECK(covers(observer_loop(), step, 0.0, {0.5, 0.3, 0.2}));
  CHECK(covers(observer_loop(), step, 0.5, {0.0, 0.0, 0.0}));
  const GainNetwork network = observer_loop().network();
  CHECK(network.is_at_rest);
  CHECK(network.matrix[0][0].near() == doctest::Approx(0.7));
  CHECK(network.matrix[1][1].near() == doctest::Approx(0.7));
  CHECK(network.matrix[0][2].near() == doctest::Approx(0.7));
  CHECK_FALSE(detector_loop(network).has_value());
  Loop other = observer_loop();
  other.steady[1].constant = Ball(0.5);  // another length is no steady state
  CHECK_FALSE(other.network().is_at_rest);
  other = observer_loop();
  other.steady[0].turns = 2;
  CHECK_FALSE(other.is_covered());
  other = observer_loop();
  other.steady[0].constant = pi();  // against the samples
  CHECK_FALSE(other.network().is_at_rest);
}

TEST_CASE("with amplitudes in a range no factor is wider than the quotient of its ends") {
  // The last sample as a vector, seen along its direction: x/x^2 times the noise, for 0.95 <= x <= 1.05.
  Loop loop = test::product_loop();
  loop.least_amplitude = 0.95;
  loop.largest_amplitude = 1.05;
  double most = 0.0;
  for (const GainForm& form : loop.network().forms) {
    const bool is_direct = std::all_of(form.row.begin(), form.row.end(),
                                       [](const Ball& factor) { return certainly_equal(factor, zero); });
    for (const auto& [input, factor] : form.direct) {
      for (const Ball& part : {factor.first, factor.second}) {
        most = std::max(most, is_direct && input == 0 ? abs(part).upper_double() : 0.0);
      }
    }
  }
  CHECK(most == doctest::Approx(1.05 / (0.95 * 0.95)).epsilon(1e-7));
}

TEST_CASE("a vector at rest is seen from its own direction, whatever else has its length as a factor") {
  Loop loop{{"p", "r", "phase", "freq"},
            {{"a", "0.1"}},
            "m = i*cos(phase) + q*sin(phase)\ns = q*cos(phase) - i*sin(phase)\n"
            "p' = 0.25*sqrt(p^2 + r^2) + 0.25*p + 0.5*m\nr' = 0.25*r + 0.5*s\n"
            "d = atan2(r, p)\nphase' = phase + freq + 0.1*d\nfreq' = freq + 0.01*d\n",
            "freq",
            {{0, 0.0, 0.0, 1}, {0, 1.0, 0.0}, {1, 0.0, 1.0}, {0, 0.0, 1.0}}};
  const auto step = [](const State& x, std::complex<double> y) {
    const std::complex<double> next =
        0.25 * x[1] + 0.25 * std::polar(x[1], x[0]) + 0.5 * y * std::polar(1.0, -x[2]);
    return State{std::arg(next), std::abs(next), x[2] + x[3] + 0.1 * x[0], x[3] + 0.01 * x[0]};
  };
  CHECK(covers(loop, step, 0.1, {0.1, 0.1, 0.1, 0.05}));
  CHECK(covers(loop, step, 0.0, {0.2, 0.1, 0.2, 0.05}));
  CHECK(loop.network().is_at_rest);
}

TEST_CASE("a value that is no constant is a factor of what turns with the signal") {
  Loop loop =
      loop_with("n = sqrt((freq*i)^2 + (freq*q)^2)\nd = freq*q*cos(phase) - freq*i*sin(phase) + n - freq");
  loop.frequency = "freq";
  CHECK(covers(loop,
               [](const State& x, std::complex<double> y) {
                 const double d = x[1] * std::imag(y * std::polar(1.0, -x[0])) + x[1] * std::abs(y) - x[1];
                 return State{x[0] + x[1] + 0.1 * d, x[1] + 0.01 * d};
               },
               0.2, {0.3, 0.05}));
  loop.lowest = -0.5;  // freq may be 0: the root is not known
  CHECK_FALSE(loop.is_covered());
}

TEST_CASE("a vector that matters by its length, or does not follow the samples, is not covered") {
  CHECK(turn_loop().is_covered());
  CHECK_FALSE(turn_loop("p' = p\nr' = r").is_covered());
  CHECK_FALSE(turn_loop("p' = i + p/2\nr' = q + r/2").is_covered());
  CHECK_FALSE(turn_loop("p' = i\nr' = 2*q").is_covered());
  CHECK_FALSE(turn_loop("p' = q\nr' = i").is_covered());  // turns the other way
  CHECK_FALSE(turn_loop("p' = 1\nr' = 0").is_covered());  // does not turn
  CHECK_FALSE(turn_loop("m = sqrt(p^2 + r^2)\np' = m*i\nr' = m*q").is_covered());
  Loop product = turn_loop();
  product.step = "w' = w + g*(q*p - i*r)\np' = i\nr' = q\n";
  CHECK_FALSE(product.is_covered());
  Loop read = turn_loop();
  read.frequency = "w + g*p";
  CHECK_FALSE(read.is_covered());
}

TEST_CASE("the parts of a vector are two states of one vector, at the start in their steady state") {
  const auto with = [](const auto& change) {
    Loop loop = turn_loop();
    change(loop);
    return loop.is_covered();
  };
  CHECK_FALSE(with([](Loop& loop) { loop.steady[0].imaginary = 0; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[0].imaginary = 3; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[0].imaginary = 2; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[0].imaginary = std::nullopt; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[1].imaginary = 0; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[1].constant = -one; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[1].per_frequency = -one; }));
  CHECK_FALSE(with([](Loop& loop) { loop.steady[1].turns = 1; }));
  CHECK_FALSE(with([](Loop& loop) { loop.angles = {"p"}; }));
  CHECK_FALSE(with([](Loop& loop) { loop.angles = {"r"}; }));
  const auto from = [](const Ball& p, const Ball& r, const Ball& w) {
    const Loop loop = turn_loop();
    ModelDesign design = loop.design();
    design.start_within = {p, r, w};
    const ModelRecursion recursion(read_json(loop.model().dump()));
    try {
      (void)gain_network(recursion, design, loop.steady);
      return true;
    } catch (const NotCovered&) {
      return false;
    }
  };
  CHECK(from(zero, zero, one));
  CHECK_FALSE(from(half, zero, one));
  CHECK_FALSE(from(zero, half, zero));
}

}  // namespace
}  // namespace veritrack::checker

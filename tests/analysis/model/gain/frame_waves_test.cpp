// Sizes of discs and of what a sine misses in the frame of the signal, against the largest values on fine
// grids.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/function_remainder.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using Complex = std::complex<double>;

/// A frame with an angle that is that of the samples, and both samples turned back by it.
struct TurnedFrame {
  explicit TurnedFrame(const Interval& amplitude) : frame(amplitude, Interval::from_bounds(0.2, 0.3), 1) {}

  Frame frame;
  FrameValue theta = frame.state(0, true, 1, 0.0, 1.0);
  FrameValue y1 = frame.sample(0), y2 = frame.sample(1);
  FrameValue in_phase = y1 * cos(theta) + y2 * sin(theta);
  FrameValue quadrature = y2 * cos(theta) - y1 * sin(theta);
  FrameValue length = sqrt(y1 * y1 + y2 * y2);
};

/// The size of the only disc of noise in this value.
double disc_of(const std::function<FrameValue(TurnedFrame&)>& formula, const Interval& amplitude,
               double noise) {
  TurnedFrame turned(amplitude);
  (void)turned.frame.line_of(formula(turned));
  double size = NAN;
  int discs = 0;
  for (const FrameInput& each : turned.frame.inputs()) {
    if (!each.is_remainder) {
      size = each.at_noise(noise);
      ++discs;
    }
  }
  CHECK(discs == 1);
  return size;
}

/// The largest distance of |y|^s e^(i m arg y) from A^s, y = A + v, |v| <= noise.
double farthest(int s, int m, const Interval& amplitudes, double noise) {
  double most = 0.0;
  for (const double amplitude : {amplitudes.lower(), rigor::midpoint(amplitudes), amplitudes.upper()}) {
    for (int i = 0; i < 720; ++i) {
      for (const double share : {0.5, 0.9, 1.0}) {
        const Complex y = amplitude + std::polar(share * noise, std::numbers::pi * i / 360.0);
        const Complex value = std::pow(std::abs(y), s) * std::polar(1.0, m * std::arg(y));
        most = std::max(most, std::abs(value - std::pow(amplitude, s)));
      }
    }
  }
  return most;
}

void check_disc(const std::function<FrameValue(TurnedFrame&)>& formula, int s, int m, double loose) {
  CAPTURE(s);
  CAPTURE(m);
  for (const Interval& amplitude : {Interval(1.1), Interval::from_bounds(0.8, 1.2)}) {
    for (const double noise : {0.01, 0.2, 0.5, 0.79}) {
      CAPTURE(noise);
      const double size = disc_of(formula, amplitude, noise);
      const double least = farthest(s, m, amplitude, noise);
      CHECK(size >= least * (1.0 - 1e-12));
      if (noise < 0.3 && rigor::width(amplitude) == 0.0) {
        CHECK(size <= loose * least);
      }
    }
  }
}

}  // namespace

TEST_CASE("discs of noise are as large as noise makes what is in them") {
  const rigor::UpwardRounding upward;
  check_disc([](TurnedFrame& of) { return of.quadrature; }, 1, 1, 1.000001);
  check_disc([](TurnedFrame& of) { return of.in_phase * of.quadrature; }, 2, 2, 1.000001);
  check_disc([](TurnedFrame& of) { return of.y1 * of.y1 + of.y2 * of.y2; }, 2, 0, 1.000001);
  check_disc([](TurnedFrame& of) { return of.quadrature / of.length; }, 0, 1, 2.5);
  check_disc([](TurnedFrame& of) { return of.in_phase * of.quadrature / of.length; }, 1, 2, 2.5);
  check_disc([](TurnedFrame& of) { return of.quadrature * of.length; }, 2, 1, 2.5);
  check_disc([](TurnedFrame& of) { return of.quadrature / of.length / of.length; }, -1, 1, 2.5);
  CHECK_FALSE(disc_of([](TurnedFrame& of) { return of.quadrature / of.length; }, Interval(0.8), 0.8) <
              INFINITY);
}

TEST_CASE("remainders of sines and cosines are as large as what they stand for") {
  const rigor::UpwardRounding upward;
  test::check_remainder([](const auto& x) { return sin(x); }, [](double x) { return std::sin(x); },
                        [](double x) { return std::cos(x); });
  test::check_remainder([](const auto& x) { return cos(x); }, [](double x) { return std::cos(x); },
                        [](double x) { return -std::sin(x); });
}

}  // namespace veritrack::model

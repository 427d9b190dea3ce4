// Noise that is one input, in waves and angles of a sample, against the values themselves.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using ComplexNoise = std::complex<double>;
using WaveFormula =
    std::function<FrameValue(const FrameValue& y1, const FrameValue& y2, const FrameValue& theta)>;

/// |y|^s times the cosine or sine of m times the angle of y from the loop's.
struct NoiseWave {
  WaveFormula formula;
  int s, m;
  bool is_sine;
};

FrameValue along_angle(const FrameValue& y1, const FrameValue& y2, const FrameValue& theta) {
  return y1 * cos(theta) + y2 * sin(theta);
}
FrameValue across_angle(const FrameValue& y1, const FrameValue& y2, const FrameValue& theta) {
  return y2 * cos(theta) - y1 * sin(theta);
}
FrameValue length_of_sample(const FrameValue& y1, const FrameValue& y2) {
  return sqrt(y1 * y1 + y2 * y2);
}

using FormulaValue = const FrameValue&;
const std::vector<NoiseWave> kNoiseWaves{
    {[](FormulaValue a, FormulaValue b, FormulaValue t) { return across_angle(a, b, t); }, 1, 1, true},
    {[](FormulaValue a, FormulaValue b, FormulaValue t) { return along_angle(a, b, t); }, 1, 1, false},
    {[](FormulaValue a, FormulaValue b, FormulaValue t) {
       return FrameValue(2) * along_angle(a, b, t) * across_angle(a, b, t);
     },
     2, 2, true},
    {[](FormulaValue a, FormulaValue b, FormulaValue) { return a * a + b * b; }, 2, 0, false},
    {[](FormulaValue a, FormulaValue b, FormulaValue) { return length_of_sample(a, b); }, 1, 0, false},
    {[](FormulaValue a, FormulaValue b, FormulaValue t) {
       return across_angle(a, b, t) / length_of_sample(a, b);
     },
     0, 1, true},
    {[](FormulaValue a, FormulaValue b, FormulaValue t) {
       return along_angle(a, b, t) * length_of_sample(a, b);
     },
     2, 1, false},
    {[](FormulaValue a, FormulaValue b, FormulaValue t) { return across_angle(a, b, t) / (a * a + b * b); },
     -1, 1, true},
};

/// A value as a line, with an angle of the loop that is that of the samples, `turned` from it in the steady
/// state.
struct LinedWave {
  LinedWave(const WaveFormula& formula, const Interval& amplitude, double turned)
      : frame(amplitude, Interval(0.25), 1, 2, true) {
    const FrameValue theta = frame.state(0, true, 1, turned, 1.0);
    line = frame.line_of(formula(frame.sample(0), frame.sample(1), theta));
  }

  /// Of all inputs but the noise, times their weights, where the error of the angle and the noise are these.
  [[nodiscard]] double room(double error, double noise) const {
    std::vector<double> sizes;  // by component
    for (const FrameInput& input : frame.inputs()) {
      std::vector<double> bounds;
      for (const FrameLine& form : frame.forms()) {
        double bound = form.states.empty() ? 0.0 : rigor::magnitude(form.states[0]) * std::fabs(error);
        for (const auto& [component, weight] : form.inputs) {
          const auto place = static_cast<std::size_t>(component);
          bound += place < sizes.size() ? rigor::magnitude(weight) * sizes[place] : 0.0;
        }
        bounds.push_back(bound);
      }
      sizes.resize(sizes.size() + static_cast<std::size_t>(input.components),
                   input.is_remainder ? input.at_bounds(bounds) : input.at_noise(noise));
    }
    double sum = 0.0;
    for (const auto& [component, weight] : line.inputs) {
      sum += component >= 2 ? rigor::magnitude(weight) * sizes.at(static_cast<std::size_t>(component)) : 0.0;
    }
    return sum;
  }
  /// How far a value is from the line, at these errors.
  [[nodiscard]] double distance(double value, double error, const ComplexNoise& noise) const {
    const auto weight = [&](int component) {
      const auto found = line.inputs.find(component);
      return found == line.inputs.end() ? Interval(0.0) : found->second;
    };
    const Interval state = line.states.empty() ? Interval(0.0) : line.states[0];
    const Interval at = line.constant + line.per_frequency * Interval(0.25) + state * Interval(error) +
                        weight(0) * Interval(noise.real()) + weight(1) * Interval(noise.imag());
    return std::max({0.0, value - at.upper(), at.lower() - value});
  }

  Frame frame;
  FrameLine line;
};

}  // namespace

TEST_CASE("a wave is its linear part in the noise itself, up to what is stated") {
  const rigor::UpwardRounding upward;
  test::Random random(8101);
  for (const Interval& amplitude : {Interval(1.25), Interval::from_bounds(0.8, 1.3)}) {
    for (const NoiseWave& wave : kNoiseWaves) {
      CAPTURE(wave.s);
      CAPTURE(wave.m);
      for (const double turned : {0.0, 0.7}) {
        const LinedWave lined(wave.formula, amplitude, turned);
        for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
          const double noise = random.below(3) == 0 ? 0.01 : random.uniform(0.0, 0.7);
          const ComplexNoise n = std::polar(noise, random.uniform(-4.0, 4.0));
          const double error = random.below(4) == 0 ? 0.0 : random.uniform(-3.5, 3.5);
          const ComplexNoise y = random.uniform(amplitude.lower(), amplitude.upper()) + n;
          const double angle = wave.m * (std::arg(y) - turned - error);
          const double value =
              std::pow(std::abs(y), wave.s) * (wave.is_sine ? std::sin(angle) : std::cos(angle));
          CHECK(lined.distance(value, error, n) <= lined.room(error, noise) + 1e-12);
        }
      }
    }
  }
}

TEST_CASE("what is not linear in the noise is of the second order, and nothing of a sample by itself") {
  const rigor::UpwardRounding upward;
  for (const NoiseWave& wave : kNoiseWaves) {
    CAPTURE(wave.s);
    CAPTURE(wave.m);
    const LinedWave lined(wave.formula, Interval(1.0), 0.0);
    const double order = std::max(std::abs(wave.s), std::abs(wave.m)) + 1.0;
    CHECK(lined.room(0.0, 0.01) <= 0.5 * order * order * 1e-4);
    // The noise of 1e-3 at a phase that is off by 1e-3.
    CHECK(lined.room(1e-3, 1e-3) <= 1e-6 * order * order);
  }
  CHECK(LinedWave(kNoiseWaves[0].formula, Interval(1.0), 0.0).room(0.0, 0.5) == 0.0);
  CHECK(std::isinf(LinedWave(kNoiseWaves[5].formula, Interval(0.8), 0.0).room(0.0, 0.8)));
  CHECK_FALSE(LinedWave(kNoiseWaves[5].formula, Interval(0.8), 0.0).room(NAN, 0.1) < INFINITY);
}

TEST_CASE("the angle of a sample is that of its noise, up to the second order") {
  const rigor::UpwardRounding upward;
  test::Random random(8102);
  const WaveFormula angle = [](FormulaValue a, FormulaValue b, FormulaValue t) {
    return atan2(across_angle(a, b, t), along_angle(a, b, t));
  };
  const LinedWave lined(angle, Interval::from_bounds(0.8, 1.3), 0.2);
  for (std::int64_t trial = 0; trial < test::effort(1000); ++trial) {
    const double noise = random.uniform(0.0, 0.7);
    const ComplexNoise n = std::polar(noise, random.uniform(-4.0, 4.0));
    const double error = random.uniform(-0.5, 0.5);
    const double value = std::arg(random.uniform(0.8, 1.3) + n) - 0.2 - error;
    CHECK(lined.distance(value, error, n) <= lined.room(error, noise) + 1e-12);
  }
  CHECK(LinedWave(angle, Interval(1.0), 0.0).room(0.0, 0.01) <= 0.6e-4);
}

}  // namespace veritrack::model

// Loops with phases for tests, with evidence that needs no search.
#pragma once

#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "checker/model/gain/phase_evidence.hpp"
#include "tests/checker/model/gain/gain_certificates.hpp"

namespace veritrack::test {

inline std::string exactly(double x) {
  std::array<char, 64> written{};
  (void)std::snprintf(written.data(), written.size(), "%a", x);
  return written.data();
}

/// c_0 + c_1 z + ...
inline Json harmonic(const std::vector<std::complex<double>>& powers) {
  Json list = Json::array();
  for (const std::complex<double>& each : powers) {
    list.push_back({exactly(each.real()), exactly(each.imag())});
  }
  return list;
}

constexpr double kMeanFrequency = 0.3;
constexpr double kHalfBand = 1e-3;

/// One channel: w' = 0.9 w + 0.1 y^2. Its steady state is 0.5 + 0.05 Re e^(2 j phi)/(1 - 0.9 e^(-2 j omega)).
inline Json smoothing_model() {
  return {{"samples", {"y"}},        {"parameters", Json::array()},      {"angles", Json::array()},
          {"states", {"w"}},         {"step", "w' = 0.9*w + 0.1*y*y\n"}, {"frequency", "w"},
          {"signal", {"A*cos(phi)"}}};
}

inline Json smoothing_gains() {
  const std::complex<double> j(0.0, 1.0);
  const std::complex<double> e = 0.9 * std::exp(-2.0 * j * kMeanFrequency);
  const std::complex<double> u = 1.0 / (1.0 - e);
  const std::complex<double> slope = -2.0 * j * e * u * u;
  const std::complex<double> bend = -4.0 * e * u * u - 8.0 * e * e * u * u * u;
  const Json second = harmonic({0.05 * u, 0.05 * kHalfBand * slope, 0.025 * kHalfBand * kHalfBand * bend});
  const Json unit = Json::array({Json::array({harmonic({1.0})})});
  Json cell;
  cell["frequency"] = exactly(kMeanFrequency);
  cell["half_width"] = exactly(kHalfBand);
  cell["parts"] = 3;
  cell["turns"] = {0};
  cell["curve"] = Json::array({Json::array({harmonic({0.5}), Json::array(), second})});
  cell["basis"] = unit;
  cell["matrix"] = Json::array({Json::array({exactly(0.9)})});
  return {{"phases", 64}, {"horizon", 256}, {"cells", Json::array({cell})}};
}

/// Two channels, a loop of second order at 500 to 502 Hz, in the basis of its states.
inline Json narrow_motor_gains() {
  constexpr double kRate = 12500.0;
  const double middle = 2.0 * 3.14159265358979323846 * 501.0 / kRate;
  const double width = 2.0 * 3.14159265358979323846 * 1.001 / kRate;
  const Json unit = Json::array({harmonic({1.0})});
  Json cell;
  cell["frequency"] = exactly(middle);
  cell["half_width"] = exactly(width);
  cell["parts"] = 2;
  cell["turns"] = {1, 0};
  cell["curve"] = Json::array(
      {Json::array({harmonic({middle, width})}), Json::array({harmonic({middle * kRate, width * kRate})})});
  cell["basis"] = Json::array({unit, Json::array(), Json::array(), unit});
  cell["matrix"] =
      Json::array({Json::array({exactly(1.0 - 2000.0 / kRate)}), Json::array({exactly(1.0 / kRate)}),
                   Json::array({exactly(-30000.0 / kRate)}), Json::array({exactly(1.0)})});
  return {{"phases", 64}, {"horizon", 8192}, {"cells", Json::array({cell})}};
}

/// A design and evidence, read and bounded.
struct PhaseLoopOfTest {
  Json model, gains;
  double lowest = kMeanFrequency - 0.999 * kHalfBand, highest = kMeanFrequency + 0.999 * kHalfBand;
  double slew = 0.0;
  checker::Objections objections;

  [[nodiscard]] checker::ModelDesign design() const {
    checker::ModelDesign result;
    result.amplitude = result.least_amplitude = result.largest_amplitude = checker::one;
    result.lowest = Ball(lowest);
    result.highest = Ball(highest);
    result.slew = Ball(slew);
    return result;
  }
  /// None where the evidence is refused.
  [[nodiscard]] std::unique_ptr<checker::PhaseBounds> bounds() {
    recursion = std::make_unique<checker::ModelRecursion>(checker::read_json(model.dump()));
    objections.clear();
    const checker::TrackedModel tracked{recursion.get(), checker::one, false};
    return checker::read_phase_gains(checker::read_json(gains.dump()), tracked, design(), {}, objections);
  }

  [[nodiscard]] std::string said() const { return objections.empty() ? "" : objections.front(); }

  std::unique_ptr<checker::ModelRecursion> recursion;
};

inline PhaseLoopOfTest smoothing_loop() {
  PhaseLoopOfTest loop;
  loop.model = smoothing_model();
  loop.gains = smoothing_gains();
  return loop;
}

inline PhaseLoopOfTest narrow_motor_loop() {
  PhaseLoopOfTest loop;
  loop.model = motor_loop().model();
  loop.gains = narrow_motor_gains();
  loop.lowest = 2.0 * 3.14159265358979323846 * 500.0 / 12500.0;
  loop.highest = 2.0 * 3.14159265358979323846 * 502.0 / 12500.0;
  return loop;
}

}  // namespace veritrack::test

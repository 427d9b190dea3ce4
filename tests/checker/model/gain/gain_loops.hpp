// Loops for tests, of two channels unless they say so, and their bounds by gains.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "checker/model/gain/gain_bounds.hpp"
#include "checker/model/gain/gain_network.hpp"

namespace veritrack::test {

using checker::Ball;
using checker::SteadyState;
using Json = nlohmann::json;

struct Loop {
  std::vector<std::string> states;
  Json parameters;  ///< names and formulas
  std::string step, frequency;
  std::vector<SteadyState> steady;
  double lowest = 0.1, highest = 0.5;
  double least_amplitude = 1.0, largest_amplitude = 1.0;
  std::vector<std::string> angles{"phase"};
  bool has_one_channel = false;
  bool amplitude_varies = false;
  bool has_one_noise = false;

  [[nodiscard]] Json model() const {
    Json list = Json::array();
    for (const auto& [name, formula] : parameters.items()) {
      list.push_back({{"name", name}, {"formula", formula}});
    }
    const std::vector<std::string> samples =
        has_one_channel ? std::vector<std::string>{"y"} : std::vector<std::string>{"i", "q"};
    const std::vector<std::string> signal = has_one_channel
                                                ? std::vector<std::string>{"A*cos(phi)"}
                                                : std::vector<std::string>{"A*cos(phi)", "A*sin(phi)"};
    return {{"samples", samples}, {"parameters", list},     {"angles", angles}, {"states", states},
            {"step", step},       {"frequency", frequency}, {"signal", signal}};
  }
  [[nodiscard]] checker::ModelDesign design() const {
    checker::ModelDesign result;
    result.least_amplitude = Ball(least_amplitude);
    result.largest_amplitude = Ball(largest_amplitude);
    result.amplitude = Ball::hull(result.least_amplitude, result.largest_amplitude);
    result.lowest = Ball(lowest);
    result.highest = Ball(highest);
    result.amplitude_varies = amplitude_varies;
    return result;
  }
  /// Throws NotCovered.
  [[nodiscard]] checker::GainNetwork network() const {
    const checker::ModelRecursion recursion(checker::read_json(model().dump()));
    return checker::gain_network(recursion, design(), steady, has_one_noise);
  }
  [[nodiscard]] bool is_covered() const {
    try {
      (void)network();
      return true;
    } catch (const checker::NotCovered&) {
      return false;
    }
  }
};

const std::string kDetector = "d = atan2(q*cos(phase) - i*sin(phase), i*cos(phase) + q*sin(phase))\n";

/// The loop of a motor controller at 12.5 kHz, 20 to 1000 Hz.
inline Loop motor_loop() {
  return {{"phase", "speed"},
          {{"dt", "1/12500"}, {"kp", "2000"}, {"ki", "30000"}},
          kDetector + "phase' = phase + (speed + kp*d)*dt\nspeed' = speed + ki*d*dt\n",
          "speed*dt",
          {{1, 0.0, 1.0}, {0, 0.0, 12500.0}},
          0.01,
          0.51};
}

/// With a sine for a detector, and its output kept as a state.
inline Loop output_loop() {
  return {{"phase", "freq", "out"},
          Json::object(),
          "d = q*cos(phase) - i*sin(phase)\nfreq' = freq + 0.001*d\nout' = freq' + 0.05*d\nphase' = phase + "
          "out'\n",
          "out",
          {{1, 0.0, 1.0}, {0, 0.0, 1.0}, {0, 0.0, 1.0}},
          0.1,
          0.3};
}

inline Loop third_order_loop() {
  return {
      {"phase", "freq", "rate"},
      Json::object(),
      kDetector + "rate' = rate + 0.0002*d\nfreq' = freq + rate' + 0.01*d\nphase' = phase + 0.2*d + freq'\n",
      "freq",
      {{1, 0.0, 1.0}, {0, 0.0, 1.0}, {0, 0.0, 0.0}}};
}

/// The turn from the last sample to this one by products; two states are the last sample.
inline Loop product_loop() {
  Loop loop{{"p", "r", "freq"},
            {{"g", "0.02"}},
            "p' = i\nr' = q\nfreq' = freq + g*((q*p - i*r)*cos(freq) - (i*p + q*r)*sin(freq))\n",
            "freq",
            {{1, 0.0, 0.0, 1}, {0, 1.0, 0.0}, {0, 0.0, 1.0}}};
  loop.angles = {};
  loop.has_one_noise = true;
  return loop;
}

inline Loop gnss_loop() {
  return {{"phase", "nco", "d"},
          {{"a", "0.7"}, {"bandwidth", "0.02"}},
          "ahead = phase + nco\nin_phase = i*cos(ahead) + q*sin(ahead)\nquadrature = q*cos(ahead) - "
          "i*sin(ahead)\n"
          "d' = atan(quadrature/in_phase)\n"
          "nco' = nco + 0.0533*(d' - d) + (d' + d)*0.00072\nphase' = ahead\n",
          "nco",
          {{1, 0.0, 0.0}, {0, 0.0, 1.0}, {0, 0.0, 0.0}}};
}

/// The loop of type 2 with a multiplying phase detector, of one channel (designs/models/type-2-pll.toml).
inline Loop type_2_loop(const std::string& wn) {
  Loop loop{{"theta", "w"},
            {{"a_wn", wn}, {"b_zeta", "0.7071"}, {"c_ki", "a_wn^2"}, {"d_kp", "2*b_zeta*a_wn"}},
            "e = -2*y*sin(theta + w)\nw' = w + c_ki*e\ntheta' = theta + w + d_kp*e\n",
            "w",
            {{1, 0.0, 0.0}, {0, 0.0, 1.0}},
            0.2,
            0.5};
  loop.angles = {"theta"};
  loop.has_one_channel = true;
  return loop;
}

/// The largest noise, to three digits, at which the errors are certain from the steady state.
inline double tolerated_noise(const checker::GainBounds& bounds, std::size_t states) {
  double low = 0.0;
  double high = 1.0;
  while (high - low > 1e-3) {
    const double middle = (low + high) / 2.0;
    (bounds.errors(Ball(middle), checker::zero, std::vector<Ball>(states)) ? low : high) = middle;
  }
  return low;
}

}  // namespace veritrack::test

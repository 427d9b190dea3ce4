// A phase-locked loop as a design file, and its certificate.
#pragma once

#include <string>

#include "certificates/design/design_reader.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::test {

inline constexpr const char* kLoopText = R"(name = "a loop"
tracker = "model"
source = "our own"

[model]
samples = 'y'
parameters = { wn = 0.02, zeta = 0.7071, ki = 'wn^2', kp = '2*zeta*wn' }
states = ['theta', 'w']
angles = ['theta']
units = { theta = 'rad', w = 'rad/sample' }
step = '''
e      = -2*y*sin(theta + w)
w'     = w + ki*e
theta' = theta + w + kp*e
'''
frequency = 'w'
start = { theta = 0, w = 'omega' }

[assume]
amplitude = 1
sample_rate = 1000
frequency = [0.3, 0.32]
noise = 0.02
start_within = { w = 0.001 }

[require]
frequency_error_below = 0.02
)";

inline certificates::Design loop_design(const std::string& text = kLoopText) {
  return certificates::read_design(text, "loop.toml");
}

/// Of what is required, certified once in each test program.
inline const certificates::Certificate& loop_certificate() {
  static const certificates::Certificate certificate =
      certificates::certify(loop_design(), "loop.toml", kLoopText, {}, certificates::Extent::requirements);
  return certificate;
}

/// A loop of two channels, which is certified by gains. `parameters`: kp and ki at least; `rest`: what else
/// is assumed and required.
inline std::string two_channel_text(const std::string& parameters, const std::string& rest) {
  return R"(name = "a loop"
tracker = "model"

[model]
samples = ['i', 'q']
parameters = { )" +
         parameters + R"( }
states = ['theta', 'w']
angles = ['theta']
step = '''
e      = q*cos(theta) - i*sin(theta)
theta' = theta + w + kp*e
w'     = w + ki*e
'''
frequency = 'w'
start = { theta = 'omega', w = 'omega' }

[assume]
amplitude = 1
frequency = [-0.5, 0.5]
)" + rest;
}

/// Of that loop. `gains`: "kp = 0.06, ki = 0.001" or others.
inline certificates::Certificate two_channel_certificate(const std::string& gains = "kp = 0.06, ki = 0.001") {
  const std::string text = two_channel_text(gains, R"(sample_rate = 1000
noise = 0.1
slew = { hz_per_second = 0.1 }

[require]
frequency_error_below = 0.01
)");
  return certificates::certify(loop_design(text), "loop.toml", text, {}, certificates::Extent::everything);
}

/// The turn from the last pair of samples to this one, smoothed by a gain g.
inline certificates::Certificate turn_certificate(const std::string& gain) {
  const std::string text = R"(name = "a turn"
tracker = "model"

[model]
samples = ['i', 'q']
parameters = { g = )" + gain +
                           R"( }
states = ['p', 'r', 'w']
step = '''
w' = w + g*(atan2(q*p - i*r, i*p + q*r) - w)
p' = i
r' = q
'''
frequency = 'w'
start = { p = 'A', r = 0, w = 'omega' }

[assume]
amplitude = 1
frequency = [-0.5, 0.5]
noise = 0.1
)";
  return certificates::certify(loop_design(text), "turn.toml", text, {}, certificates::Extent::everything);
}

}  // namespace veritrack::test

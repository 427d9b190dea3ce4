// A design for the tests of this folder, and variations of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "certificates/design/design_reader.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::test {

inline constexpr const char* kDesignText = R"(name    = "a design"
tracker = "quadrature-ekf"
source  = "our own"

[design]
q1 = 0.0023
q2 = 0.0023
r = 0.05
epsilon = 0.0

[assume]
amplitude = 1.0
frequency = [0.05, 3.0]
noise = 0.001
slew = 0.0
initial_frequency_error = 0.005
initial_phase_error = 0.005
initial_amplitude_error = 0.005

[require]

[simulate]
samples = 60
)";

/// kDesignText with each first string replaced by the second. The text must hold the first.
inline std::string design_text(const std::vector<std::pair<std::string, std::string>>& replacements = {}) {
  std::string text = kDesignText;
  for (const auto& [from, to] : replacements) {
    text.replace(text.find(from), from.size(), to);
  }
  return text;
}

inline certificates::Design design(
    const std::vector<std::pair<std::string, std::string>>& replacements = {}) {
  return certificates::read_design(design_text(replacements), "design.toml");
}

inline certificates::Certificate certificate(
    const std::vector<std::pair<std::string, std::string>>& replacements = {}) {
  return certificates::certify(design(replacements), "design.toml", design_text(replacements));
}

}  // namespace veritrack::test

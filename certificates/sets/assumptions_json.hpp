// [assume], [require] and [simulate] in certificate.json.
#pragma once

#include "certificates/document/number_json.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// A bound, or Gaussian noise.
[[nodiscard]] Json noise_json(const Number& bound, const std::optional<GaussianNoise>& gaussian);
[[nodiscard]] Json assume_json(const Assumptions& assume);
[[nodiscard]] Json require_json(const Requirements& require);
[[nodiscard]] Json simulate_json(const SimulationSettings& simulate);

}  // namespace veritrack::certificates

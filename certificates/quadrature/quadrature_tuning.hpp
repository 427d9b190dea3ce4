// q1 and q2 of the quadrature tracker, chosen for the best certified value.
#pragma once

#include <span>
#include <string_view>

#include "certificates/document/tuning.hpp"

namespace veritrack::certificates {

/// "long-run", "for-ever", "radius", "noise", "slew": of what `tune_quadrature` makes the best.
[[nodiscard]] std::span<const std::string_view> quadrature_tuning_objectives();

/// Only the ratios of q1, q2, r and P(0) matter to the estimate; r is left as it is. Noise must have a bound.
/// A local search over certified values, from the given design and from the steady-state Kalman filter for
/// the assumed noise and slew. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune_quadrature(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates

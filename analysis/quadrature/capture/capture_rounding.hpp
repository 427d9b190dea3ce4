// The effect of the program's rounding on a step of followed starts (docs/rounding.md).
#pragma once

#include "analysis/quadrature/capture/capture.hpp"

namespace veritrack::quadrature {

/// Bounds on |program's step - exact step| of each coordinate of the rotating frame, from every state of the
/// box; infinite when there is none. Needs the upward mode.
[[nodiscard]] StateVector followed_rounding(const CaptureProblem& problem, const StateBox& states);

}  // namespace veritrack::quadrature

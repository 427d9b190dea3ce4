// Are the bounds that the thesis takes from Deyst and Price true for a design of the quadrature tracker?
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// id "riccati-bounds": the naive bounds P(k|k) <= O^-1 + C, p = 1/b1 + a1 and q = 1/a2 + b2 (thesis, section
/// 2.4.3) against the sound ones (riccati_bounds.hpp) for the window N = 1, each decided for the design: as a
/// matrix inequality, with the exact Gramians at |z| = 1, and with the b1 and b2 of either reading over the
/// band of |z| that its epsilon_r allows. Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_riccati_bounds(const TrackerInput& input);

}  // namespace veritrack::theorems

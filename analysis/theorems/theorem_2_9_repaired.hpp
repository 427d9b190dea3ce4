// Theorem 2.9 repaired: a statement of the same form, |e(0)| < epsilon_z (pq)^(-1/2) and noise below a bound
// imply that the error stays bounded, with every gap of the printed proof closed. The proof is
// docs/repaired-theorem.md; its constants are those of error_recursion.hpp.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// The derivation "theorem-2.9/repaired" for a signal of amplitude 1 that obeys (3.1) with |w3(k)| and |v(k)|
/// bounded by `input`'s process_noise and measurement_noise. The published theorem's free parameters are not
/// used: tube and window are chosen by a search, separately for the largest start, the largest noise and the
/// assumed start.
///
/// Quantities: the published names where they have a meaning here (epsilon_r, rho_1, delta_1, delta_2, p, q,
/// s, beta, one_minus_alpha, epsilon_z, initial_error_bound), and initial_frequency_error_bound (rad/sample,
/// phase and amplitude exact, no noise), noise_bound (on |v|, exact start, w = 0), process_noise_bound (on
/// |w3|, rad/sample, v = 0), rate (of W(k) per sample, in the long run); frequency_error_bound and
/// ultimate_frequency_error (rad/sample) for the assumed start and noise. Conditions: "Q", "epsilon",
/// "invariance", "P(0|0)" and "2.45". Without an initial_covariance P(0|0) is the filter's steady state along
/// exact estimates. Opens its own UpwardRounding scope. Does not throw for unusual numbers: inputs that are
/// not finite prove nothing.
[[nodiscard]] Derivation derive_repaired_theorem(const TrackerInput& input);

}  // namespace veritrack::theorems

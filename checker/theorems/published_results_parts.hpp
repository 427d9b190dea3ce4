// The published results by subject, for published_results.cpp: each evaluated for a design, given the
// certificate's claim about it.
#pragma once

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

// About the model, the filter's covariance, and the continuous-time tracker.
Derivation riccati_bounds(const Design& design, const Tree& claimed);
Derivation baras_bensoussan_james(const Design& design, const Tree& claimed);
Derivation song_grizzle(const Design& design, const Tree& claimed);
Derivation theorem_2_7_printed(const Design& design, const Tree& claimed);
Derivation theorem_3_1(const Design& design, const Tree& claimed);
Derivation theorem_3_1_to_the_letter(const Design& design, const Tree& claimed);
Derivation theorem_3_2(const Design& design, const Tree& claimed);
Derivation theorem_3_2_any_start(const Design& design, const Tree& claimed);
Derivation lemma_3_1(const Design& design, const Tree& claimed);

// About the error equation within the radius that the certificate chose.
Derivation song_grizzle_local(const Design& design, const Tree& claimed);
Derivation total_stability(const Design& design, const Tree& claimed);
Derivation total_stability_corollary(const Design& design, const Tree& claimed);
Derivation theorem_2_7_corrected(const Design& design, const Tree& claimed);
Derivation reif(const Design& design, const Tree& claimed);
Derivation reif_two_step(const Design& design, const Tree& claimed);

}  // namespace veritrack::checker

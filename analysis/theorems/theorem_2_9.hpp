// Theorem 2.9 (EKF stability; La Scala, thesis 1994) for a design of the quadrature tracker: every constant,
// every condition, and the error bound when the conditions are satisfied.
#pragma once

#include <optional>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/error_bound.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems {

/// Theorem 2.9 evaluated for a design.
struct Theorem29 {
  /// id "theorem-2.9/printed" or "theorem-2.9/errata"; its quantities are named as in certificate.json, its
  /// conditions by the thesis's equation numbers ("2.24", "2.25", "2.26", "2.28", "2.29", "2.43", "2.44",
  /// "2.45") or by the parameter whose range they state ("sigma", "gamma", "epsilon_r", "epsilon").
  Derivation derivation;
  Theorem29Constants constants;
  /// The theorem's bound on |e(k|k)|: only when every condition is PROVED and its last term is not negative
  /// (R_x >= beta epsilon_z, which Theorem 2.7 needs and Theorem 2.9 does not mention).
  std::optional<ErrorBound> error_bound;
};

/// Evaluates the theorem in one reading of its text. Inadmissible parameters (sigma, gamma_fraction, epsilon,
/// q1 > q2) refute a condition; the formulas are then still evaluated as written. Where q1 may be zero the
/// quantities that divide by it are not applicable, and conditions that use them are undecided. Empty or
/// unbounded inputs never prove anything. Opens its own UpwardRounding scope. Throws std::invalid_argument
/// when q2 or r may be zero or negative, or q1 negative.
[[nodiscard]] Theorem29 evaluate_theorem_2_9(Theorem29Variant variant, const Theorem29Input& input);

}  // namespace veritrack::theorems

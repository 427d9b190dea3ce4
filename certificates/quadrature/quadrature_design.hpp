// The design file of the tracker "quadrature-ekf".
#pragma once

#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// [design] of the quadrature tracker: Q = diag(q1, q1, q2), R = r I (signal units squared, q2 in
/// (rad/sample)^2).
struct QuadratureDesignTable {
  Number q1, q2, r, epsilon;

  /// True only when epsilon is certainly zero: the one choice between the two contraction certificates.
  [[nodiscard]] bool without_leak() const { return epsilon.value == rigor::Interval(0.0); }
};

/// [theorem_2_9]: the free parameters of the published theorem.
struct Theorem29Parameters {
  Number state_bound;     ///< R_x, signal units and rad/sample mixed, as in the thesis
  Number sigma;           ///< the thesis's "arbitrarily small" number
  Number gamma_fraction;  ///< gamma = gamma_fraction / (s p^2), in (0, 1)
  Number c1;              ///< |w| <= c1 sqrt(q2)
  Number c2;              ///< |v| <= c2 sqrt(r)
};

/// The tables of a design file for the tracker "quadrature-ekf".
struct QuadratureEkfTables {
  QuadratureDesignTable design;
  Assumptions assume;
  Requirements require;
  SimulationSettings simulate;
  Theorem29Parameters theorem_2_9;
};

/// The tables of a design of this tracker. Throws std::logic_error for another.
[[nodiscard]] inline const QuadratureEkfTables& quadrature_tables(const Design& design) {
  return tables_of<QuadratureEkfTables>(design);
}

}  // namespace veritrack::certificates

// Theorem 3.1 of the thesis (Nijmeijer 1982) for the quadrature signal model: rank of the map from the state
// to the first three outputs, and the Gram matrix of its derivative printed in section 3.2.1.
#pragma once

#include "analysis/rigor/matrix.hpp"
#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// The Gram matrix J'J, J the derivative of (h(x), h(f(x)), h(f(f(x)))), by automatic differentiation.
/// Signal units and rad/sample mixed, as in the thesis. Needs the upward rounding mode.
[[nodiscard]] rigor::IntervalMatrix<3> observability_gram(const rigor::IntervalVector<3>& state,
                                                          const rigor::Interval& epsilon);

/// The printed one, its "1 - epsilon x" read as (1 - epsilon) x. Needs the upward rounding mode.
[[nodiscard]] rigor::IntervalMatrix<3> printed_gram(const rigor::IntervalVector<3>& state,
                                                    const rigor::Interval& epsilon);

/// id "theorem-3.1": full rank at |z| = 1, and the printed matrix as an identity. Opens its own
/// UpwardRounding scope.
[[nodiscard]] Derivation evaluate_observability_rank(const TrackerInput& input);

/// id "theorem-3.1/to-the-letter": the statements printed with it that fail. Opens its own UpwardRounding
/// scope.
[[nodiscard]] Derivation evaluate_observability_to_the_letter(const TrackerInput& input);

}  // namespace veritrack::theorems

// Lemma 3.1 of the thesis (after Jazwinski 1970): the contribution of the second-order terms of f to the
// covariance of the prediction, for the quadrature signal model.
#pragma once

#include "analysis/rigor/matrix.hpp"
#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// Second-order terms of the prediction of z (2x2, in the frame of the predicted phase: amplitude first) for
/// a Gaussian error of covariance P in the frame of the estimated phase, |z| = m, H_i the Hessians:
///     printed(i, j) = (1/4) tr(P H_i) tr(P H_j)        the lemma's: the square of the second-order bias
///     covariance(i, j) = (1/2) tr(H_i P H_j P)         their contribution to the covariance
/// With f(m + d, x3 + nu) = e^{i x3} e^{i nu} (m + d), the second-order part is i nu d - m nu^2 / 2. The
/// frequency has none. Needs the upward rounding mode.
struct SecondOrderTerms {
  rigor::IntervalMatrix<2> printed, covariance;
};
[[nodiscard]] SecondOrderTerms second_order_terms(const rigor::IntervalMatrix<3>& p,
                                                  const rigor::Interval& m);

/// id "lemma-3.1", for the steady state of the filter. Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_lemma_3_1(const TrackerInput& input);

}  // namespace veritrack::theorems

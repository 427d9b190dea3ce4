// The constant ell of the KKL observer (trackers/kkl_observer/kkl_observer.hpp): problem (10) of its paper,
// solved as stated, solved in its reduced form, and enclosed.
#pragma once

#include "analysis/rigor/matrix.hpp"
#include "analysis/search/branch_and_bound.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::kkl_observer {

/// M filters and the frequencies that the signal may have.
template <int M>
struct KklRangeOf {
  rigor::IntervalVector<M> lambda;  ///< filter rates, 1/s; certainly positive and distinct
  rigor::Interval frequency;        ///< rad/s; certainly positive
};
/// The paper's four filters.
using KklRange = KklRangeOf<4>;

/// Encloses the infimum of |M T(x)|^2 over |T(x)| = 1 and the frequencies of the range, (10), by branch and
/// bound over the frequency; `where` are the frequencies (rad/s) that can attain it. Opens its own rounding
/// scope. For four to eight filters.
template <int M>
[[nodiscard]] search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<M>& range);

/// The derivation "kkl-ell" from the result of enclose_ell for the range: quantities ell, ell_ipopt,
/// ell_nlopt, ell_nlopt_global, argmin_omega, of which only ell and argmin_omega are proved; conditions that
/// ell is enclosed to 1e-9 and is positive. The notes compare each solver's value with the enclosure. Opens
/// its own rounding scopes. For four to eight filters.
template <int M>
[[nodiscard]] theorems::Derivation derive_kkl_ell(const KklRangeOf<M>& range,
                                                  const search::VerifiedMinimum<1>& minimum);

}  // namespace veritrack::kkl_observer

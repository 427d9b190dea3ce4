// The loop that a constant controller u = -K y closes around a plant with unit delay: whether it is stable,
// for which plant gains, and the share of a disturbance of each frequency that reaches the output.
//
// Plant A_1 x_k = B_1 u_{k-1}, output y = x + v, controller K = N/D, all polynomials in q^-1. Then
//     (A_1 D + g q^-1 B_1 N) y = A_1 D v,   so S = A_1 D/(A_1 D + g q^-1 B_1 N) with the plant gain g = 1.
#pragma once

#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::regulator {

/// Coefficients of q^0, q^-1, q^-2, ...
using Polynomial = std::vector<rigor::Interval>;

/// Needs the upward mode.
[[nodiscard]] Polynomial product(const Polynomial& a, const Polynomial& b);
/// |p(e^{-j frequency})|, frequency in rad/sample. Needs the upward mode.
[[nodiscard]] rigor::Interval size_at(const Polynomial& p, const rigor::Interval& frequency);

/// Have all polynomials in `p`, whose first coefficient is not 0, their zeros in z within |z| < radius?
/// PROVED: all have. REFUTED: none has. By the recursion of Schur and Cohn (the table of Jury): p_0 z^n + ...
/// + p_n is Schur if and only if |p_n/p_0| < 1 and (p - (p_n/p_0) p reversed)/z is. Needs the upward mode.
[[nodiscard]] rigor::Verdict has_zeros_within(const Polynomial& p, const rigor::Interval& radius);

/// One loop.
struct FrozenLoop {
  Polynomial plant_denominator;  ///< A_1
  Polynomial plant_numerator;    ///< B_1, without the delay
  Polynomial numerator;          ///< N
  Polynomial denominator;        ///< D

  /// A_1 D + gain q^-1 B_1 N. Needs the upward mode.
  [[nodiscard]] Polynomial characteristic(const rigor::Interval& gain) const;
  /// Are all poles within |z| < radius when the plant's gain is `gain` times the present one? Needs the
  /// upward mode.
  [[nodiscard]] rigor::Verdict has_poles_within(const rigor::Interval& radius,
                                                const rigor::Interval& gain) const;
  /// Is it stable for every gain in `gains`? The range is halved until each part is decided, or until the
  /// parts are 2^-16 of it. Needs the upward mode.
  [[nodiscard]] rigor::Verdict is_stable_for_gains(const rigor::Interval& gains) const;
  /// |S| at a frequency, rad/sample. Needs the upward mode.
  [[nodiscard]] rigor::Interval sensitivity(const rigor::Interval& frequency) const;
  /// The largest |S| over all frequencies, by branch and bound: when the coefficients are wide, it encloses
  /// the largest of the lower ends, and no |S| is above its upper end. Opens its own rounding scope.
  [[nodiscard]] rigor::Interval peak_sensitivity() const;
};

}  // namespace veritrack::regulator

// Whether the powers of a matrix of intervals decay: by its characteristic polynomial and the test of Schur
// and Cohn, in interval arithmetic.
#pragma once

#include <optional>
#include <vector>

#include "analysis/linear/worst_case_gains.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::linear {

/// The coefficients of det(z I - A), from the constant one to the leading 1: by the method of Faddeev and
/// Leverrier. Needs the upward rounding mode.
[[nodiscard]] std::vector<rigor::Interval> characteristic_polynomial(const std::vector<Row>& a);

/// Whether all eigenvalues of every matrix in `a` are smaller than `radius` in size: proved, refuted (one is
/// larger, of every matrix) or undecided. Needs the upward rounding mode; radius > 0.
[[nodiscard]] rigor::Verdict are_within(const std::vector<Row>& a, double radius);

/// lower < upper: the largest eigenvalue of every matrix is between them.
struct RadiusBounds {
  double lower = 0.0;
  double upper = 0.0;
};
/// Empty where none was proved. Needs the upward rounding mode.
[[nodiscard]] std::optional<RadiusBounds> spectral_radius_bounds(const std::vector<Row>& a);

/// Looser bounds, for a program whose own are cruder. They stay on their side of 1. Needs the upward rounding
/// mode.
[[nodiscard]] RadiusBounds with_room(const RadiusBounds& bounds);
/// The same with wider entries.
[[nodiscard]] Row with_room(const Row& row);
[[nodiscard]] std::vector<Row> with_room(const std::vector<Row>& rows);

}  // namespace veritrack::linear

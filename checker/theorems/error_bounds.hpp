// The tubes of the repaired theorem (docs/repaired-theorem.md), in which the filter's covariance and the
// error recursion are bounded.
#pragma once

#include <optional>
#include <string>

#include "checker/numbers/matrix3.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Bounds on the errors with their recursion, as the evidence gives it. In use only when it is verified.
struct ErrorBounds {
  Ball plane, frequency;  ///< |z(k|k) - z(k)| and |x3(k|k) - x3(k)| at most
  Ball one_minus_alpha, curvature, process_gain, measurement_gain, s, radius;
  Matrix3 upper, information;  ///< P(k|k) <= upper, P(k|k)^-1 <= information
  int window = 0;              ///< true after this many steps whatever P(0|0) was; 0: the filter keeps them
  [[nodiscard]] Ball plane_gain() const {
    return sqrt(larger_eigenvalue(upper[0][0], upper[1][0], upper[1][1]));
  }
  [[nodiscard]] Ball frequency_gain() const { return sqrt(upper[2][2]); }
  [[nodiscard]] Ball p() const { return extreme_eigenvalues(upper).high; }
  [[nodiscard]] Ball q() const { return extreme_eigenvalues(information).high; }
  [[nodiscard]] Ball disturbance(const Ball& w, const Ball& v) const {
    return process_gain * w + measurement_gain * v;
  }
  /// alpha R + c R^2 + d <= R, and R keeps the estimate within them.
  [[nodiscard]] bool invariant(const Ball& disturbance) const {
    return certainly_positive(radius) && certainly_at_most(radius, plane / plane_gain()) &&
           certainly_at_most(radius, frequency / frequency_gain()) &&
           certainly_at_most(curvature * square(radius) + disturbance, one_minus_alpha * radius);
  }
  /// The largest disturbance that its radius tolerates.
  [[nodiscard]] Ball tolerated() const { return one_minus_alpha * radius - curvature * square(radius); }
};

/// The verified bounds of this name; empty when the evidence has none, or some statement in it is not proved.
std::optional<ErrorBounds> verified_error_bounds(const Tree& derivation, const std::string& name,
                                                 const Design& design, Objections& objections);

}  // namespace veritrack::checker

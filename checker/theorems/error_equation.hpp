// The error equation of the tracker within a radius of the signal, e(k+1) = (I - KH)F e(k) + curvature +
// noise, and bounds on its parts (docs/published-results.md).
#pragma once

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

struct ErrorEquation {
  Ball radius;             ///< |e| <= radius
  Ball transition;         ///< sup ||F||
  Ball curvature;          ///< sup ||D^2 f||
  Ball smallest, largest;  ///< smallest I <= P(k|k) <= largest I
  Ball process;            ///< min(q1, q2)
  Ball one_minus_alpha, beta;
  Ball correction;  ///< sup ||I - KH||
  Ball gain;        ///< sup ||K||
};

ErrorEquation error_equation(const Design& design, const Ball& radius);

/// The radius that the certificate chose, as the quantity of this name; a ball of everything unless in (0,
/// 1/2].
Ball claimed_radius(const Tree& derivation, const std::string& name);

/// The statements about the equation in every derivation that uses it.
std::vector<Quantity> quantities_of(const ErrorEquation& equation);
Condition start_covariance(const ErrorEquation& equation, const Design& design);

}  // namespace veritrack::checker

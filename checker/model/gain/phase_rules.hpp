// The rules of docs/gain-proof.md, section 10, for one operation over a cell of phases and frequencies.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"
#include "checker/model/gain/phase_graph.hpp"
#include "checker/model/gain/phase_range.hpp"

namespace veritrack::checker {

/// The data that the remainder of an operation depends on besides the bounds of its operands: ranges of their
/// bases, outward.
struct RuleRange {
  double low = 0.0, high = 0.0;              ///< of the (first) operand
  double other_low = 0.0, other_high = 0.0;  ///< of the second one
  double value = 0.0, slope = 0.0;           ///< of sine and cosine: suprema of function and derivative
};

/// The base of a result and its derivatives by the operands.
struct RuleResult {
  BallPolynomial base, by_first, by_second;
  RuleRange range;
};

/// For operations with operands. `second` is not used where there is one.
RuleResult base_of(const PhaseNode& node, const BallPolynomial& first, const BallPolynomial& second);

/// A bound of the remainder where the operands deviate by at most these; infinite where the condition of the
/// rule is not certain. 0 for `within`, where it is a condition alone, and for what is exact.
double remainder_size(const PhaseNode& node, const RuleRange& range, double first, double second);

}  // namespace veritrack::checker

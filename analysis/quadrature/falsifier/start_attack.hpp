// Attacks on the claims about the assumed starts, with the plain tracker: does a start covariance of the
// claimed range, with start errors, noise and slew within their limits, exceed the bound? Proves nothing.
#pragma once

#include <cstdint>

#include "analysis/quadrature/falsifier/falsifier.hpp"
#include "analysis/sets/contraction_question.hpp"

namespace veritrack::quadrature {

struct StartAttackOptions {
  std::int64_t starts = 60;
  int steps = 60;    ///< length of a run
  int refined = 20;  ///< the first samples, whose noise and slew are turned one at a time where that helps
  std::uint64_t seed = 20261121;
};

/// The result.
struct StartAttack {
  double frequency_error = 0.0;  ///< the largest absolute value after the start, rad/sample
  double at_start = 0.0;         ///< the largest of a start
  Attack attack;                 ///< that led to the first
  std::int64_t runs = 0, steps = 0;
};

/// Starts on the boundary of the box of assumed errors, mostly in its corners. P(0|0) is an end X or Y of the
/// range of the question's start covariances, or differs from one of them by a singular matrix of random
/// directions, or lies between; the noise is constant or flips, across and along the predicted phase, or
/// pushes the frequency error outward, always of full size, and so is the slew. The true frequency is drawn
/// from the band, rad/sample. Deterministic. Opens its own NearestRounding scope. Throws
/// std::invalid_argument when the question names no start covariance, or its range contains nothing.
[[nodiscard]] StartAttack attack_starts(const sets::ContractionQuestion& question,
                                        const rigor::Interval& band, const StartAttackOptions& options = {});

}  // namespace veritrack::quadrature

// A linear recursion that is closed by a phase detector: x+ = A x + b p with the phase p of the samples,
// which the detector compares with c x (docs/gain-proof.md, section 7).
#pragma once

#include <optional>
#include <vector>

#include "analysis/linear/worst_case_gains.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::linear {

struct DetectorLoop {
  std::vector<Row> a;  ///< with the loop closed
  Row effect;          ///< b
  Row phase;           ///< c; c (I - A)^-1 b = 1
};

/// pi times the sum of squares of c A^k b, rad/sample, of every loop in the intervals; empty where it is not
/// known. Needs the upward rounding mode.
[[nodiscard]] std::optional<rigor::Interval> noise_bandwidth(const DetectorLoop& loop);

/// Whether A - (f - 1) b c is stable for all factors f from 1 to each in `factor`: proved, refuted or
/// undecided. factor >= 1. Needs the upward rounding mode.
[[nodiscard]] rigor::Verdict is_stable_up_to(const DetectorLoop& loop, const rigor::Interval& factor);

}  // namespace veritrack::linear

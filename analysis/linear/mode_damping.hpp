// The damping of the modes of a linear recursion, enclosed: its multipliers are in discs about approximate
// ones (docs/gain-proof.md, section 7).
#pragma once

#include <vector>

#include "analysis/linear/worst_case_gains.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::linear {

/// Whether -Re s >= least |s| with s = ln z for every eigenvalue z but 0, of every matrix in `a`: proved,
/// refuted (one of every matrix has less) or undecided. 0 < least < 1. Needs the upward rounding mode.
[[nodiscard]] rigor::Verdict has_damping(const std::vector<Row>& a, const rigor::Interval& least);

}  // namespace veritrack::linear

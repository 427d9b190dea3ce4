// The claims, decided, of two papers of which we have one page each: on subset averaged median filters, and
// on a pendulum that is driven and calmed by impulses.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// Is every extended self-dual threshold Boolean filter of this window (1 to 12 inputs) a subset averaged
/// median filter, in one way? PROVED: the medians of the 2^(N-1) odd subsets are linearly independent, over a
/// prime field and so over the rationals, in a space of that dimension. UNDECIDED otherwise. Throws
/// std::invalid_argument for another window.
[[nodiscard]] rigor::Verdict medians_are_a_basis(std::size_t window);

/// The ids begin with "sam/" and "pendulum/". Needs the upward rounding mode; some tenths of a second.
[[nodiscard]] std::vector<Statement> spill_over_claims();

}  // namespace veritrack::theorems

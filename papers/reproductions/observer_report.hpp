// Figures 7 to 9 of Praly, Marconi and Isidori: Hou's adaptive observer beside theirs.
#pragma once

#include "papers/reproductions/reproduction.hpp"

namespace veritrack::reports {

/// `starts`: of each search for Hou's parameters; there is no noise.
[[nodiscard]] Findings reproduce_figures_7_9(int starts, const ReproductionProgress& progress);

}  // namespace veritrack::reports

// Figures 1 to 6 of Praly, Marconi and Isidori: the means and deviations of their captions.
#pragma once

#include "papers/reproductions/reproduction.hpp"

namespace veritrack::reports {

/// `choices`: how many windows and phases are drawn beside the one that a search found; there is no noise.
[[nodiscard]] Findings reproduce_figures_1_6(int choices, const ReproductionProgress& progress);

}  // namespace veritrack::reports

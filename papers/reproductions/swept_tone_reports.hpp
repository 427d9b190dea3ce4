// Table 3.2 and Figures 3.1 to 3.5 of La Scala's thesis, and Table I of the 1996 paper: the quadrature
// tracker and an adaptive notch filter on a tone whose frequency rises.
#pragma once

#include "papers/reproductions/reproduction.hpp"

namespace veritrack::reports {

[[nodiscard]] Findings reproduce_table_1(int runs, const ReproductionProgress& progress);
[[nodiscard]] Findings reproduce_table_3_2(int runs, const ReproductionProgress& progress);

}  // namespace veritrack::reports

// Chapter 5 of La Scala's thesis: Tables 5.1 and 5.2, Figures 5.3 to 5.11, and the numbers of section 5.4.
#pragma once

#include "papers/reproductions/reproduction.hpp"

namespace veritrack::reports {

[[nodiscard]] Findings reproduce_tables_5(int runs, const ReproductionProgress& progress);

}  // namespace veritrack::reports

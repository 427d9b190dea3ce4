// Tables 4.1 and 4.2 and Figures 4.4 to 4.12 of La Scala's thesis: the tracker of weak tones by blocks.
#pragma once

#include "papers/reproductions/reproduction.hpp"

namespace veritrack::reports {

[[nodiscard]] Findings reproduce_tables_4(int runs, const ReproductionProgress& progress);

}  // namespace veritrack::reports

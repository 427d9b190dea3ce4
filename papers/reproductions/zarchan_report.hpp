// P. Zarchan's slides "Tracking a Sine Wave": what their titles say of single runs, over many.
#pragma once

#include "papers/reproductions/reproduction.hpp"

namespace veritrack::reports {

[[nodiscard]] Findings reproduce_zarchan(int runs, const ReproductionProgress& progress);

}  // namespace veritrack::reports

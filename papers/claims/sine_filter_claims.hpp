// The findings of P. Zarchan's slides "Tracking a Sine Wave" in single runs, and properties of their four
// filters in every run: symmetries, the lack of a steady state without process noise, and runs with any noise
// of a bounded size.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// The ids begin with "zarchan/". Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> sine_filter_claims();

}  // namespace veritrack::theorems

// What P. Zarchan's slides "Tracking a Sine Wave" show in single runs and what is true of their four filters
// in every run: symmetries, that without process noise nothing settles, and runs with any noise of a bounded
// size.
#pragma once

#include <vector>

#include "analysis/theorems/statement.hpp"

namespace veritrack::theorems {

/// The ids begin with "zarchan/". Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> sine_filter_claims();

}  // namespace veritrack::theorems

// A search for the best tube and window: proposals for error_recursion.hpp, each of them verified.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "analysis/theorems/error_recursion.hpp"

namespace veritrack::theorems {

/// The recursions of a sequence of tubes, for several windows. Needs the upward rounding mode.
[[nodiscard]] std::vector<ErrorRecursion> recursion_ladder(const IntervalDesign& design);

/// The recursion with the largest score; nothing when none has a positive one. NaN counts as no score.
[[nodiscard]] std::optional<ErrorRecursion> best_recursion(
    const std::vector<ErrorRecursion>& ladder, const std::function<double(const ErrorRecursion&)>& score);

}  // namespace veritrack::theorems

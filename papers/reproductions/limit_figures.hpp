// The figures of the report on limits.
#pragma once

#include <vector>

#include "papers/limits/limit_study.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Error and posterior bound over the signal-to-noise ratio, a panel a tracker. Not drawn yet.
[[nodiscard]] Figure draw_random_walks(const std::vector<limits::RandomWalkSeries>& study);

/// Error and bound over the number of samples of a constant frequency, a panel a tracker. Not drawn yet.
[[nodiscard]] Figure draw_errors_over_time(const std::vector<limits::ErrorOverTime>& study);

}  // namespace veritrack::reports

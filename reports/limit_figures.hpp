// The figures of the report on limits.
#pragma once

#include <string>
#include <vector>

#include "analysis/limits/limit_study.hpp"

namespace veritrack::reports {

/// Error and posterior bound over the signal-to-noise ratio, a panel a tracker: SVG. Throws FigureError.
[[nodiscard]] std::string draw_random_walks(const std::vector<limits::RandomWalkSeries>& study);

/// Error and bound over the number of samples of a constant frequency, a panel a tracker: SVG. Throws
/// FigureError.
[[nodiscard]] std::string draw_errors_over_time(const std::vector<limits::ErrorOverTime>& study);

}  // namespace veritrack::reports

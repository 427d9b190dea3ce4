// Figures 5.3 to 5.11 of the thesis.
#pragma once

#include "reports/figures.hpp"

namespace veritrack::reports::vibration {

/// Figures 5.3 to 5.5; `limit`: Lambda of the monitored estimator. Not drawn yet.
[[nodiscard]] Figure draw_example_1(double limit);
/// Figures 5.8 and 5.9.
[[nodiscard]] Figure draw_example_2();
/// Figures 5.6, 5.7, 5.10 and 5.11.
[[nodiscard]] Figure draw_responses();

}  // namespace veritrack::reports::vibration

// The figures of a single-channel tracker's certificate.
#pragma once

#include <vector>

#include "reports/figures.hpp"

namespace veritrack::reports {

/// The bias against the frequency, and the response of the frozen filter. Not drawn yet.
[[nodiscard]] std::vector<Figure> draw_single_channel_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

// The probability of losing lock in Gaussian noise, certified and simulated, as figures.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Over the signal-to-noise ratio and over the number of samples; none when no set is certified for the
/// lowest ratio. Not drawn yet.
[[nodiscard]] std::vector<Figure> draw_lock_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

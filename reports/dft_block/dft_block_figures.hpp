// The figures of a block tracker's certificate: simulated offset errors below the proved bounds, and false
// locks.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

[[nodiscard]] std::vector<Figure> draw_dft_block_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

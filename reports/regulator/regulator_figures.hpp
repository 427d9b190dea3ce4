// The figure of a regulator's certificate: the simulated closed loop below the proved bounds.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Output over the samples, simulated, and its proved bounds; empty where there are none. Not drawn yet.
[[nodiscard]] std::vector<Figure> draw_regulator_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

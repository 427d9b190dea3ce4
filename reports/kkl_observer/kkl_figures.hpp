// The figures of a KKL observer's certificate: the simulations of the paper's section V.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// The estimates of the KKL observer, and of the adaptive one beside it, under the three disturbances of
/// section V; none for a design with other rates. Not drawn yet.
[[nodiscard]] std::vector<Figure> draw_kkl_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

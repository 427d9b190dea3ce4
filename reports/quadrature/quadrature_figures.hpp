// The figures of the quadrature tracker's certificate.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// The tracker's frequency beside the true one, and the error beside the bounds that were certified or
/// claimed, along the certificate's simulated run; the certified tube; the followed starts. Empty when there
/// was no run. Not drawn yet.
[[nodiscard]] std::vector<Figure> draw_quadrature_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

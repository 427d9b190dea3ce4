// The figures of a model's certificate.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// How far the certified sets reach, the noise and the slew that each cell tolerates, a tube with simulated
/// errors in it, and bias and ripple, over the frequency; those about which something is proved. Values that
/// the certificate does not have are computed again. Not drawn yet.
[[nodiscard]] std::vector<Figure> draw_model_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports

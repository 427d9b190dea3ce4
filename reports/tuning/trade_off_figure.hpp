// The figure of a tuning: the objective against the speed of the tracker.
#pragma once

#include "certificates/document/tuning.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Over the samples until a step of the frequency is followed to within a tenth; what has no value, or no
/// such response, is counted in the caption. Throws FigureError.
[[nodiscard]] Figure draw_trade_off(const certificates::TradeOff& trade_off);

}  // namespace veritrack::reports

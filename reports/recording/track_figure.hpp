// A run over a recording as a picture.
#pragma once

#include <string>

#include "reports/recording/track_document.hpp"

namespace veritrack::reports {

/// SVG: the estimate with two deviations on either side, the normalised innovation squared with its band, and
/// the lock indicator, over the recording. Throws FigureError.
[[nodiscard]] std::string draw_track(const TrackReport& report);

}  // namespace veritrack::reports

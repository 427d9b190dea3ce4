// The quadrature tracker in its steady state, to first order: a linear recursion of its errors. Not proved.
#pragma once

#include <optional>
#include <string>

#include "analysis/linear/detector_loop.hpp"
#include "analysis/linear/loop_response.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Errors along the signal, across it (signal units) and of the frequency, in the frame that turns with the
/// signal: e+ = (I - K H)(F e) + K v.
struct LinearFilter {
  linear::LinearLoop loop;
  linear::DetectorLoop detector;  ///< the errors across the signal and of the frequency
};

/// At a constant frequency in the middle of the band. Empty for a design with a leak, whose steady state is
/// biased, or which does not settle.
[[nodiscard]] std::optional<LinearFilter> linear_filter(const Design& design);

/// "## The linear filter", or nothing.
[[nodiscard]] std::string linear_filter_section(const Certificate& certificate);

}  // namespace veritrack::certificates

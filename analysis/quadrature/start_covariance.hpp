// A covariance with which to start the quadrature tracker: that in which it would stand still.
#pragma once

#include "analysis/sets/contraction_question.hpp"

namespace veritrack::quadrature {

/// P of the exact estimate of a noise-free tone of amplitude 1 and this frequency (rad/sample), in the frame
/// of the estimated phase, followed until it hardly changes: a proposal. Needs round-to-nearest.
[[nodiscard]] rigor::Matrix<3> near_steady_covariance(const trackers::ToneModel<double>& design,
                                                      double frequency);

/// The question with a start covariance where it has none: the matrix above, and all within one part in a
/// million of it. Sets its own rounding mode.
[[nodiscard]] sets::ContractionQuestion with_start_covariance(sets::ContractionQuestion question,
                                                              double frequency);

}  // namespace veritrack::quadrature

// The question for contraction under the assumptions of a design, and the basis of its claims.
#pragma once

#include <optional>

#include "analysis/sets/contraction_question.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// P(0|0) as given, scaled to amplitude 1; none where the start is the filter's steady state. Needs the
/// upward mode.
[[nodiscard]] std::optional<rigor::IntervalMatrix<3>> covariance_at_unit_amplitude(const Assumptions& assume);
[[nodiscard]] rigor::IntervalMatrix<3> covariance_at_unit_amplitude(const CovarianceArray& covariance,
                                                                    const Number& amplitude);

/// The question for a model at amplitude 1 under the assumptions, with the given start covariance. Needs the
/// upward mode.
[[nodiscard]] sets::ContractionQuestion contraction_question(
    const trackers::ToneModel<rigor::Interval>& model, const Assumptions& assume,
    const Requirements& require);

/// The proved bound on |frequency error|, rad/sample, at every sample from the start on; empty when the
/// contraction certificate does not cover the assumed start, noise and slew.
[[nodiscard]] std::optional<rigor::Interval> proved_frequency_bound(const Certificate& certificate);

}  // namespace veritrack::certificates

// The linear loop of a certificate by gains: a step of the frequency, and the noise that passes.
#pragma once

#include "analysis/model/question/proved_sets.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Needs proof.gains. Not proved. Sets its own rounding mode.
[[nodiscard]] Figure response_figure(const model::GainProof& proof, const certificates::FrequencyUnits& units,
                                     double sample_rate);

}  // namespace veritrack::reports

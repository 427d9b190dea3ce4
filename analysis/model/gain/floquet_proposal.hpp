// A basis in which the errors about a steady state have constant coefficients: a proposal, in floating point.
#pragma once

#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "analysis/model/gain/floquet_modes.hpp"
#include "analysis/model/gain/phase_step.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"

namespace veritrack::model {

/// Over the frequencies low to high, rad/sample. Empty where there is no steady state that is right in the
/// mean up to `largest_mean_error`, rad/sample, or no basis. Holds round-to-nearest.
[[nodiscard]] std::optional<FloquetCell> propose_floquet_cell(const TrackedTone& tone, FloquetGauge gauge,
                                                              double low, double high,
                                                              double largest_mean_error = INFINITY);

/// The multipliers of the modes in the middle of the cell's frequencies, the largest first; of a pair the one
/// with the positive imaginary part first. Rounding is the caller's.
[[nodiscard]] std::vector<std::complex<double>> floquet_multipliers(const FloquetCell& cell);

}  // namespace veritrack::model

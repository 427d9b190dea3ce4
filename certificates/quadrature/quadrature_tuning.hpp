// q1, q2, r and the leak of the quadrature tracker, chosen for the best certified value.
#pragma once

#include <span>
#include <string_view>

#include "certificates/document/tuning.hpp"

namespace veritrack::certificates {

/// The objectives of `tune_quadrature`: all of certificates/tuning/objective.hpp.
[[nodiscard]] std::span<const std::string_view> quadrature_tuning_objectives();

/// For noise with a bound the search is over certified values; for Gaussian noise over the slack of the
/// inequality at sampled points of a proposed set, from which the ratio and the mean square that can be
/// certified are estimated. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune_quadrature(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates

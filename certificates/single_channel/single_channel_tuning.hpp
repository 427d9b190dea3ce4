// q1, q2, r and the leak of the single-channel tracker, chosen for the best certified value.
#pragma once

#include <span>
#include <string_view>

#include "certificates/document/tuning.hpp"

namespace veritrack::certificates {

/// The objectives of `tune_single_channel`: those of certificates/tuning/objective.hpp for noise with a
/// bound.
[[nodiscard]] std::span<const std::string_view> single_channel_tuning_objectives();

/// The result has process_noise = { q1 = ..., q2 = ... } and r, whatever keys the design had. A search over
/// certified values: without a leak, which the certificate over all phases does not cover; with one only
/// simulations can be compared, unless the leak is free. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune_single_channel(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates

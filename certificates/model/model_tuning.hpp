// Parameters of a model, chosen for the best guarantee.
#pragma once

#include <span>
#include <string_view>

#include "certificates/document/tuning.hpp"

namespace veritrack::certificates {

/// The objectives of `tune_model`, by name.
[[nodiscard]] std::span<const std::string_view> model_tuning_objectives();

/// Searches the ranges of the request, from the values of the design on, with Sbplx: the requirements come
/// first. Only certified values are compared. Throws RequestError for a parameter that the design does not
/// have, for one that is given outside of its range, and for Gaussian noise. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune_model(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates

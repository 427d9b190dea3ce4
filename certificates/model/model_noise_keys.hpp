// What Gaussian noise and bounded noise of a model go with.
#pragma once

#include <optional>

#include "certificates/design/design_format.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// Objects to what is assumed or required of the other kind of noise.
[[nodiscard]] std::optional<TableObjection> objection_to_noise(const ModelAssumptions& assume,
                                                               const ModelRequirements& require);

}  // namespace veritrack::certificates

// The keys that go with Gaussian noise, and those that go with bounded noise, of a model.
#pragma once

#include <optional>

#include "certificates/design/design_format.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// Objects to assumptions and requirements that belong to the other kind of noise.
[[nodiscard]] std::optional<TableObjection> objection_to_noise(const ModelAssumptions& assume,
                                                               const ModelRequirements& require);

}  // namespace veritrack::certificates

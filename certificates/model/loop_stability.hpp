// The values of parameters at which an unstable loop becomes stable. Not proved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/model/gain/steady_proposal.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// A parameter alone, the others as they are: the loop is stable on one side of a value, or at it.
struct StabilityLimit {
  enum class Stable { below, above, at };

  std::string parameter;
  double value = 0.0;  ///< of the design
  double limit = 0.0;  ///< nearest to it
  Stable stable = Stable::below;
};

/// For each parameter that is a number or a formula of its own: with the other sign (unless the estimated
/// frequency depends on it directly, as on the time between samples), or within a factor of 1000. Parameters
/// without a limit are left out. `vector`: that of the loop's steady state. Needs the upward rounding mode.
[[nodiscard]] std::vector<StabilityLimit> stability_limits(
    const ModelTables& tables, const std::optional<model::ProposedVector>& vector = std::nullopt);

}  // namespace veritrack::certificates

// A part of the assumed band, in the words of a sentence.
#pragma once

#include <optional>
#include <string>

#include "analysis/model/set/tube_set.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// Decimals in the unit of the band, rounded inward; an end of the band as the design file writes it.
struct BandPart {
  std::string from;
  std::string to;
};

/// `range` in rad/sample, inside the band. Empty when nothing is left between the decimals. Needs the upward
/// rounding mode.
[[nodiscard]] std::optional<BandPart> band_part(const ModelAssumptions& assume,
                                                const model::FrequencyRange& range);

}  // namespace veritrack::certificates

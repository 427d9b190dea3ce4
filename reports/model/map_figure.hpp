// The map of a model's region of attraction, as SVG, to be read in grey.
#pragma once

#include <string>
#include <vector>

#include "certificates/model/model_map.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Up to this many samples have their own shade of grey, the darkest one first.
[[nodiscard]] std::vector<std::size_t> capture_steps(const certificates::ModelMap& map);

/// "theta, rad".
[[nodiscard]] std::string labelled(const certificates::MappedState& state);

/// Proved cells by the number of samples after which they are captured, cells that lock in simulation only,
/// and those that do not; with the edge of the certified set. Not drawn yet.
[[nodiscard]] Figure draw_model_map(const certificates::ModelMap& map);

}  // namespace veritrack::reports

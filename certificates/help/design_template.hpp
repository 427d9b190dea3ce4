// Template design files, one for each tracker.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace veritrack::certificates {

/// The trackers that have one, in the order of certificates/trackers.def.
[[nodiscard]] std::vector<std::string> templates_for();

/// The commented design file for the tracker of that name. Throws std::out_of_range when there is none.
[[nodiscard]] std::string_view design_template(std::string_view tracker);

}  // namespace veritrack::certificates

// The section of the report on the published examples about the time index of F, which the paper prints one
// sample late.
#pragma once

#include <string>

namespace veritrack::reports {

/// Example 1 with F as printed and at the latest estimate, over 20 noise seeds, for every start and either Q:
/// how many runs lock on both frequencies. Markdown, with its heading.
[[nodiscard]] std::string linearization_section();

}  // namespace veritrack::reports

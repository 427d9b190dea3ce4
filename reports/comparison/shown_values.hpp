// Two values of a key of a design, for a reader.
#pragma once

#include <string>

#include "reports/comparison/measured_number.hpp"

namespace veritrack::reports {

/// The two values as the design files have them, "40 Hz -> 400 Hz", one line; "not given" for a missing
/// value. Where only one of them is in Hz, its number in rad/sample follows it, rounded outward; of a text of
/// many lines the first line that differs. Needs the upward rounding mode.
[[nodiscard]] std::string shown_values(const ContractValue& before, const ContractValue& after,
                                       certificates::Measure measure);

}  // namespace veritrack::reports

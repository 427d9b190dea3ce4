// The formats that the operations of a listing take and give.
#pragma once

#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

/// Whether the formats of an operation's operands, its predicate and its table fit to it. Operands are
/// registers of the listing.
[[nodiscard]] bool has_fitting_formats(const trackers::code::Listing& listing,
                                       const trackers::code::Instruction& instruction);

}  // namespace veritrack::certificates::code

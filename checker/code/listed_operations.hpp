// The operations that a listing may have, and the formats of their operands.
#pragma once

#include <vector>

#include "checker/code/listing.hpp"

namespace veritrack::checker {

/// What is wrong with an operation on operands of these formats, or nullptr. `written`: the format that
/// stands behind its name, for a comparison that of its operands.
const char* objection_to_operation(const ListedOperation& operation, ListedFormat written,
                                   const std::vector<ListedFormat>& operands);

}  // namespace veritrack::checker

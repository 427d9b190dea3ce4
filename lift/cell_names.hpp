// Names of cells of memory as the user's source has them.
#pragma once

#include <cstdint>
#include <string>

#include "lift/memory.hpp"

namespace veritrack::lift {

/// The name of the cell of an object at an offset: `pll.theta`, `filter.taps[2]`; without debug information
/// the object's name and the offset.
[[nodiscard]] std::string cell_name(const Object& object, std::int64_t offset);

}  // namespace veritrack::lift

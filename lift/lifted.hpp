// From the three functions of a harness to a listing.
#pragma once

#include <llvm/IR/Module.h>

#include "lift/executor.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::lift {

/// The listing of `step` and `frequency`, after `setup`. States are found: the cells that a step changes, and
/// of them those on which the frequency, another state or a condition depends. Throws LiftError, whose place
/// is `executor.graph().place()`.
[[nodiscard]] trackers::code::Listing lifted(Executor& executor);

}  // namespace veritrack::lift

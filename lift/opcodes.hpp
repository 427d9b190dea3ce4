// The operations of LLVM as those of a listing.
#pragma once

#include <llvm/IR/InstrTypes.h>
#include <llvm/IR/Instruction.h>

#include "lift/graph.hpp"

namespace veritrack::lift {

/// Throws LiftError for one that listings do not have.
[[nodiscard]] Operation operation_of(unsigned opcode);
[[nodiscard]] Predicate predicate_of(llvm::CmpInst::Predicate predicate);
/// Throws LiftError for an operation that compilers may compute in another way. Contraction alone is allowed:
/// it is bounded by the unfused operation.
void refuse_fast_math(const llvm::Instruction& instruction);

}  // namespace veritrack::lift

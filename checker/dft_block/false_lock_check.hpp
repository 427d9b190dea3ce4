// False locks: sets of starts of the block tracker that are never left, and stay more than half a bin off.
#pragma once

#include <optional>
#include <string>

#include "checker/dft_block/lock_check.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// The tone of a false lock, as the evidence writes it.
struct FalseLockTone {
  std::string amplitude, offset;
};

/// Whether this is the id of such a derivation.
bool is_false_lock(const std::string& id);

/// The derivation as the checker computes it from the evidence "false-lock". The tone must be one of those
/// that the problem assumes. Objects to invalid evidence.
Derivation false_lock(const Tree& derivation, const BlockProblem& problem, Objections& objections);

/// The tone of a derivation that was read.
FalseLockTone false_lock_tone(const Tree& derivation);

}  // namespace veritrack::checker

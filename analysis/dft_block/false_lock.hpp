// False locks of a design as derivations: sets of starts that stay about a number of bins off for ever.
#pragma once

#include <array>
#include <string>

#include "analysis/dft_block/block_lock.hpp"
#include "analysis/dft_block/lock_set.hpp"
#include "analysis/theorems/derivation.hpp"

namespace veritrack::dft_block {

/// The tone of which a set is proved, a decimal within what is assumed of the tones.
struct WitnessTone {
  std::string amplitude;  ///< signal units
  std::string offset;     ///< bins
};

/// The map of the design for that tone. Needs the upward mode.
[[nodiscard]] BlockProblem<rigor::Interval> block_problem(const LockProblem& problem,
                                                          const WitnessTone& tone);

/// The derivations "false-lock-below" and "false-lock-above": the nearest fixed points that are at least half
/// a bin too low, and too high, that runs ended in, with the evidence "false-lock", for the lowest amplitude
/// and some offset of the band. Conditions: "set", it is mapped into itself and contracted, and "away", its
/// offset errors are more than half a bin. UNDECIDED where none was found. Opens its own rounding scopes.
[[nodiscard]] std::array<theorems::Derivation, 2> derive_false_locks(const LockProblem& problem);

}  // namespace veritrack::dft_block

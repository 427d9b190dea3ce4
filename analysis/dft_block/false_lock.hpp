// False locks of a design as derivations: sets of starts that stay biased by about a whole number of bins for
// ever.
#pragma once

#include <array>
#include <string>

#include "analysis/dft_block/block_lock.hpp"
#include "analysis/dft_block/lock_set.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::dft_block {

/// The tone for which a set is proved, as decimals within the assumptions on the tones.
struct WitnessTone {
  std::string amplitude;  ///< signal units
  std::string offset;     ///< bins
};

/// The map of the design for that tone. Needs the upward mode.
[[nodiscard]] BlockProblem<rigor::Interval> block_problem(const LockProblem& problem,
                                                          const WitnessTone& tone);

/// The derivations "false-lock-below" and "false-lock-above": the nearest fixed points in which runs ended
/// that are at least half a bin too low, and too high, with the evidence "false-lock", for the lowest
/// amplitude and some offset of the band. Conditions: "set", it is mapped into itself and contracted, and
/// "away", its offset errors are more than half a bin. UNDECIDED where none was found. Opens its own rounding
/// scopes.
[[nodiscard]] std::array<theorems::Derivation, 2> derive_false_locks(const LockProblem& problem);

}  // namespace veritrack::dft_block

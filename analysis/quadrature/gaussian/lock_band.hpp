// Lock sets for a band of frequencies: with a leak the errors at which the tracker settles depend on the
// frequency, so that each piece of the band has a set of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/quadrature/gaussian/lock_search.hpp"
#include "analysis/quadrature/gaussian/lock_verification.hpp"

namespace veritrack::quadrature {

/// The result for a band.
struct LockBand {
  /// Proved sets whose frequencies adjoin and cover the band that is needed, from its lowest on; empty when
  /// there are none.
  std::vector<LockSet> sets;
  std::int64_t cells = 0;  ///< examined; of the proofs of these sets
  std::string reason;      ///< why there are none, as the end of a sentence
};

/// Searches and verifies, for the frequencies of the request: pieces are halved, five times at most, until
/// the set of a piece is hardly worse than one for its middle alone, and proved. The request may be for more
/// than the frequencies that are needed: pieces beyond those are left out. Needs the upward mode.
[[nodiscard]] LockBand prove_lock_band(const trackers::ToneModel<rigor::Interval>& design,
                                       const LockRequest& request, const rigor::Interval& needed);

}  // namespace veritrack::quadrature

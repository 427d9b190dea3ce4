// A band of frequencies, divided into cells that have a tube each: proposals.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

struct BandSettings {
  TubeSettings tube;
  double widest = 0.2;        ///< cell, rad/sample
  double narrowest = 1.0e-6;  ///< cell that is tried, as a share of the band at least 1/1024
  /// One shape's parameters for all cells, those of the cell in the middle: tubes of neighbouring cells then
  /// fit together, for a frequency that moves.
  bool one_shape = false;
  search::Deadline deadline = {};  ///< cells that are tried later are not proposed: `time_limit`
  /// Called with each cell when it is proposed, or is not, so that it can be proved before the next one is
  /// tried. Where `may_be_halved`, the answer false makes the search halve the cell, as if it had not been
  /// proposed.
  std::function<bool(TubeProposal& cell, bool may_be_halved)> decided = {};
};

/// low <= omega <= high, rad/sample.
struct BandProposal {
  /// From low frequencies to high ones, without gaps, of equal turns where they are proposed. A cell that is
  /// not proposed says why.
  std::vector<TubeProposal> cells;
  bool is_complete = false;  ///< all cells are proposed, and there is one
};

/// Halves cells until each has a tube or is too narrow to be divided. This limit grows with the distance from
/// the last tube, so that a part of the band without tubes is passed in a few steps. Deterministic up to the
/// deadline; holds round-to-nearest. Throws std::invalid_argument unless 0 < low < high < pi.
[[nodiscard]] BandProposal propose_band(const TrackedTone& tone, double low, double high,
                                        const BandSettings& settings);

/// The parts of the band without a tube, for a message: "no steady state: ..., between 0.1 and 0.2
/// rad/sample", one for each run of neighbouring cells that failed alike.
[[nodiscard]] std::vector<std::string> reasons_of(const BandProposal& band);

}  // namespace veritrack::model

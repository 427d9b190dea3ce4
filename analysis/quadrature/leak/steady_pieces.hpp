// Sets around the steady state for pieces of a band: a constant frequency stays in its piece, so that each
// piece may have its own. With a leak.
#pragma once

#include <vector>

#include "analysis/quadrature/leak/steady_proposal.hpp"
#include "analysis/sets/contraction_question.hpp"
#include "analysis/sets/fixed_point_bias.hpp"

namespace veritrack::quadrature {

/// A set that is certified over the frequencies [from, to], rad/sample.
struct SteadyPiece {
  double from, to;
  SteadySet set;
};

/// Verified sets of one level, without slew, over pieces that follow each other and cover the branch, in its
/// order: for as much noise as one of them can take, or, with `size` the radius, for the noise of the
/// question and frequency errors as large as one of them can hold. Empty when no such sets are found, or none
/// larger than `known`. The branch must be PROVED. Opens its own rounding scopes; deterministic.
[[nodiscard]] std::vector<SteadyPiece> search_steady_pieces(const sets::ContractionQuestion& question,
                                                            const sets::LockBranch& branch,
                                                            double SteadyRequest::*size, double known);

}  // namespace veritrack::quadrature

// Sets around the steady state that cover the band of frequencies together: a constant frequency stays in its
// piece, so that each piece may have a set of its own (docs/leak.md, section 2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/quadrature/steady_set.hpp"
#include "checker/quadrature/steady_start.hpp"

namespace veritrack::checker {

/// A set, and the part of the branch over which it was checked.
struct SteadyPiece {
  SteadySet set;
  std::vector<SteadyCell> cells;
};

/// Sets of one purpose. When verified, each frequency of the band belongs to a piece whose set is verified
/// there; there are several pieces only without slew.
struct SteadyPieces {
  std::string name;
  std::vector<SteadyPiece> pieces;
  bool verified = false;
};

/// The steady states over the band, in wide cells, and in narrow ones, which enclose them more tightly.
struct SteadyBranches {
  std::vector<SteadyCell> wide, narrow;
};

/// The cells between two frequencies (rad/sample), cut off there: none when `from` is not below `to`.
std::vector<SteadyCell> part_of(const std::vector<SteadyCell>& branch, const Ball& from, const Ball& to);

/// Checks all sets of the evidence. Those with `from` and `to` that follow each other and have the same name
/// are one cover; a set without them is a cover of the whole band. Each failure is an objection.
std::vector<SteadyPieces> check_steady_covers(const Tree& evidence, const Design& design,
                                              const SteadyBranches& branches, std::int64_t& cells,
                                              Objections& objections);

/// The least noise, and the least slew, that a piece tolerates.
Ball noise_of(const SteadyPieces& cover);
Ball slew_of(const SteadyPieces& cover);
/// Every piece holds such errors about its steady states: amplitude, phase (rad), frequency (rad/sample).
std::array<Ball, 3> error_radii(const SteadyPieces& cover);
/// At least s_(j+1)/s_j for all j and all pieces; 1 when a set does not shrink.
Ball slowest(const SteadyPieces& cover);
/// At least |x3 - omega| in the last levels, and in all of the sets, rad/sample.
Ball ultimate_error(const SteadyPieces& cover);
Ball largest_error(const SteadyPieces& cover);
/// As steady_start, over all pieces.
std::optional<SteadyStart> steady_start(const Design& design, const SteadyPieces& cover,
                                        const StartCovariance& covariance, const SteadyStartClaim& claim);

}  // namespace veritrack::checker

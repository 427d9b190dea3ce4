// Tubes of a frequency that moves: how levels of neighbouring cells compare, and which level a state has in
// the next cell when the frequency has crossed the border.
//
// The level r of a state in a cell, relative to R_0 of that cell, falls by shrinking_j in a sample while the
// frequency stays in the cell, and by crossing_j when it crosses, as long as r is between the levels j + 1
// and j. Cells have the same relative levels, up to 2^-38. The statements are shown from a little below
// R_{j+1}, so that a relative level between the least ones of all cells is between the levels of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "checker/model/tube_cover.hpp"

namespace veritrack::checker {

/// For each j, the least of R_j/R_0 over all tubes, rounded down.
std::vector<Ball> common_levels(const TubeSet& set);

/// Objects unless the tubes have the same number of levels, with the same ratios up to 2^-38, and there is a
/// number in (0, 1] for each pair of levels in `crossing`, below 1 where there are pairs.
void check_common_levels(const TubeSet& set, Objections& objections);

/// Whether the frequency can only cross from a cell to its neighbour in a sample, and a state that is at most
/// at the level shrinking_j r in a cell, r from R_{j+1} to R_j, is then at most at level crossing_j r
/// R'_0/R_0 in the neighbour; in both directions, for all phases and all frequencies that can be reached.
/// Cells are in order.
bool crosses_borders(const TubeSet& set, std::size_t states, std::int64_t& cells);

}  // namespace veritrack::checker

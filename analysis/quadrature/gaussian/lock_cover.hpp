// Cells that cover a set, bisected until an inequality is proved in each.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

using CellLook = std::function<CellDrift(const LevelCell&)>;

/// The number of cells that were looked at, when together they cover all (u, s) whose level is at most L and
/// `look` holds in each that is not outside the set; of one of u and -u it may be the other that is covered.
/// Nothing when a part takes more than `most_cells`. Where `every` is more than 1 this looks only at every so
/// many parts, which proves nothing and says how long a proof may take. In parallel; the result does not
/// depend on the number of threads. Needs the upward mode.
[[nodiscard]] std::optional<std::int64_t> cells_of_proof(const LockSet& set, const CellLook& look,
                                                         std::int64_t most_cells, std::size_t every = 1);

}  // namespace veritrack::quadrature

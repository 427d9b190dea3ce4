// Cells that cover a set, bisected until an inequality is proved in each.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

using CellLook = std::function<CellDrift(const LevelCell&)>;

/// True only when the mirror image (e2, nu, P12, P13, v2, w) -> -(...) commutes with the step and maps the
/// set to itself.
[[nodiscard]] bool has_mirror_image(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set);

/// The number of cells that were looked at, when together they cover all (u, s) whose level is at most L and
/// `look` holds in each that is not outside the set. With `half` only those with u3 >= 0, the mirror image being
/// good for the others.
/// Nothing when a part takes more than `most_cells`. Where `every` is more than 1 this looks only at every so
/// many parts, which proves nothing and says how long a proof may take. In parallel; the result does not
/// depend on the number of threads. Needs the upward mode.
[[nodiscard]] std::optional<std::int64_t> cells_of_proof(const LockSet& set, bool half, const CellLook& look,
                                                         std::int64_t most_cells, std::size_t every = 1);

}  // namespace veritrack::quadrature

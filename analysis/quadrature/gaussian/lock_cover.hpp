// Cells that cover a set, bisected until an inequality is proved in each.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

using CellLook = std::function<CellDrift(const LevelCell&)>;

/// True only when the mirror image (e2, nu, P12, P13, v2, w) -> -(...) commutes with the step and maps the
/// set to itself.
[[nodiscard]] bool has_mirror_image(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set);

/// How much is looked at.
struct CoverLimits {
  std::int64_t cells_in_part = 0;  ///< at most, in each of the parts that are looked at by themselves
  std::int64_t cells = std::numeric_limits<std::int64_t>::max();  ///< at most, together
  /// If above 1, only one of this many parts is examined, which proves nothing but estimates the length of a
  /// proof.
  std::size_t every = 1;
};

/// The number of cells that were looked at, when together they cover all (u, s) whose level is at most L and
/// `look` holds in each that is not outside the set. With `half` only those with u3 >= 0, the mirror image
/// being good for the others. Nothing when the limits do not suffice. In parallel; the result does not depend
/// on the number of threads. Needs the upward mode.
[[nodiscard]] std::optional<std::int64_t> cells_of_proof(const LockSet& set, bool half, const CellLook& look,
                                                         const CoverLimits& limits);

}  // namespace veritrack::quadrature

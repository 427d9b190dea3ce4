// A statement proved on every part of a cell, which is bisected until it is.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace veritrack::search {

/// The result for a cell.
template <typename Cell>
struct CellDecision {
  bool holds = false;                             ///< the statement, on the whole cell
  std::optional<std::array<Cell, 2>> parts = {};  ///< whose union is the cell; none: the cover ends here
};

template <typename Cell>
struct BisectionCover {
  bool is_proved = false;      ///< the cells that hold cover the whole
  std::int64_t cells = 0;      ///< that were looked at
  std::optional<Cell> failed;  ///< the one at which the cover ended
};

/// Looks at `whole` and at parts of it, depth first and the first part before the second, at most so many
/// cells. `look(cell)`, a CellDecision, is called once for each cell; a proof rests on nothing but its
/// answers.
template <typename Cell, typename Look>
[[nodiscard]] BisectionCover<Cell> cover_by_bisection(const Cell& whole, std::int64_t most_cells,
                                                      const Look& look) {
  BisectionCover<Cell> cover;
  std::vector<Cell> open{whole};
  while (!open.empty()) {
    const Cell cell = std::move(open.back());
    open.pop_back();
    if (cover.cells >= most_cells) {
      cover.failed = cell;
      return cover;
    }
    ++cover.cells;
    CellDecision<Cell> seen = look(cell);
    if (seen.holds) {
      continue;
    }
    if (!seen.parts) {
      cover.failed = cell;
      return cover;
    }
    open.push_back(std::move((*seen.parts)[1]));
    open.push_back(std::move((*seen.parts)[0]));
  }
  cover.is_proved = true;
  return cover;
}

}  // namespace veritrack::search

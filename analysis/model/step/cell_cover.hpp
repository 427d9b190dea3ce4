// A statement over all phases and a strip of frequencies, proved cell by cell.
#pragma once

#include <cstddef>
#include <functional>

#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

/// The work that a verification may take.
struct VerificationBudget {
  int phases = 32;      ///< parts of a turn to begin with: a power of two
  int frequencies = 1;  ///< parts of the frequencies to begin with: a power of two
  std::size_t most_cells = 20'000;
  search::Deadline deadline = {};  ///< after which nothing more is proved
};

/// The finding on a cell.
struct CellAnswer {
  bool is_proved = false;
  rigor::Interval range;  ///< contributes to the range of the whole: the hull is taken
  /// The shares of the bound from the width of the cell in phase, and in frequency: they show which to halve.
  /// Not evidence.
  double by_phase = 0.0;
  double by_frequency = 0.0;
};

/// The finding on all cells.
struct CoverResult {
  bool is_proved = false;  ///< in every cell of a cover of a turn and z in [-1, 1]
  std::size_t cells = 0;   ///< that were needed
  rigor::Interval range;   ///< PROVED: of all of them
  TubeCell failed;         ///< the first one otherwise
};

/// Asks about the cells of the first grid and halves those that fail, up to the budget, unless the middle of
/// the cell fails, too. Cells are independent, and the result does not depend on the number of threads; `ask`
/// is called by several of them. Throws std::invalid_argument unless the first grid is of powers of two.
[[nodiscard]] CoverResult cover_cells(const std::function<CellAnswer(const TubeCell&)>& ask,
                                      const VerificationBudget& budget);

/// Whether the first grid of the budget is valid.
[[nodiscard]] bool is_grid(const VerificationBudget& budget);

}  // namespace veritrack::model

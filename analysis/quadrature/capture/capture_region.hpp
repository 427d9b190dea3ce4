// The region of attraction, cell by cell: which starts are proved to be captured.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/quadrature/capture/capture.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::quadrature {

/// How the box of starts is cut into cells.
struct RegionOptions {
  /// Equal parts along (amplitude, phase, frequency) to begin with. A direction without width is not cut.
  std::array<int, 3> first_cells = {1, 8, 8};
  int most_halvings = 14;           ///< of a first cell
  std::size_t most_cells = 200000;  ///< propagations in all, beyond which the remaining cells stay undecided
  std::size_t generation_size = 512;  ///< cells handed out between two calls of `progress`
};

/// The start in the middle of the box.
[[nodiscard]] StartBox middle(const StartBox& box);

/// A cell of starts. PROVED: all of them are captured. REFUTED: they all lock elsewhere (or, in a cell that
/// is not halved any further, at least the middle does: `whole` is then false).
struct RegionCell {
  StartBox starts;
  rigor::Verdict verdict = rigor::Verdict::undecided;
  CaptureResult result;
  bool whole = true;
};

/// The cells tile the box of starts: neighbours share their boundary, nothing is left out.
struct Region {
  std::vector<RegionCell> cells;
  std::size_t propagations = 0;  ///< how many boxes were followed
  std::size_t samples = 0;       ///< how many steps of the map that took
  /// Upper bounds on |frequency error|, rad/sample, after 0, 1, ... samples, of the starts of those PROVED
  /// cells that are not captured before: a captured start satisfies the bounds of the target from then on.
  std::vector<double> frequency_errors;
  /// Cells that nobody looked at because `progress` asked to stop; they are the last ones.
  std::size_t unfinished = 0;
};

/// The progress, as a share of the volume of the box of starts (approximate, for display).
struct RegionProgress {
  double proved_share = 0.0;
  double refuted_share = 0.0;
  double undecided_share = 0.0;  ///< given up
  std::size_t propagations = 0;
};

/// Cuts the box of starts until each cell is decided or a limit of the options is reached. Runs on the
/// threads that oneTBB offers; the result depends neither on their number nor on their order. `progress`,
/// when there is one, is called now and then from the calling thread, and stops the work by returning false:
/// open cells stay undecided. Throws std::invalid_argument unless the box is finite and the numbers are
/// positive.
[[nodiscard]] Region prove_region(const CaptureProblem& problem, const CaptureTarget& target,
                                  const StartBox& starts, const RegionOptions& options,
                                  const std::function<bool(const RegionProgress&)>& progress = {});

/// The verdict on "every start of the box is captured": PROVED when every cell is, REFUTED when one is (its
/// middle at least is a witness), else UNDECIDED.
[[nodiscard]] rigor::Verdict verdict(const Region& region) noexcept;

}  // namespace veritrack::quadrature

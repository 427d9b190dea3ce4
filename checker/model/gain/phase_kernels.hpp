// How much of an input of earlier samples there is in a form at each phase, where the matrix, the columns and
// the forms depend on the phase (docs/gain-proof.md, section 10).
#pragma once

#include <cstddef>
#include <vector>

#include "checker/model/gain/grid_function.hpp"

namespace veritrack::checker {

/// The columns of an input of two components, in a disc. `second` has no values where there is one component.
struct PhaseInput {
  GridFunction first;
  GridFunction second;
};

/// A loop at the frequencies of a part, which are constant. Sizes of numbers are those of doubles: all of
/// them have to be finite, or nothing is certain.
struct PhaseLoop {
  std::size_t phases = 0;        ///< N
  std::size_t horizon = 0;       ///< K, at most 2^16
  double low = 0.0, high = 0.0;  ///< enclose the frequencies, in parts of a turn of 2 pi/N per sample
  std::vector<WideRow> columns;  ///< of the matrix, at all phases and frequencies
  std::vector<GridFunction> forms;
  std::vector<PhaseInput> inputs;
};

class PhaseKernels {
 public:
  explicit PhaseKernels(const PhaseLoop& loop);

  /// Whether all sums are bounded, and what starts and early inputs leave dies out. Nothing else is known
  /// where it is not so.
  [[nodiscard]] bool is_certain() const { return is_certain_; }
  /// A bound, by the cell of the phase of the form, of what an input of earlier samples with these sizes
  /// adds, by the cell of the phase of its step. Infinite where it is not known.
  [[nodiscard]] std::vector<double> contribution(std::size_t form, std::size_t input,
                                                 const std::vector<double>& sizes) const;
  /// The part of a bound that is for the largest of the sizes.
  [[nodiscard]] double rest(std::size_t form, std::size_t input) const { return rest_[form][input]; }

 private:
  /// A sum over the lags whose inputs come from 2^level cells from `first` on.
  struct Group {
    std::size_t level = 0;
    std::size_t first = 0;
    double sum = 0.0;
  };
  using Groups = std::vector<Group>;

  void add_corners(const PhaseLoop& loop, const MatrixPowers& powers, std::size_t lag);
  void add_rest(const PhaseLoop& loop, const MatrixPowers& powers, std::size_t lag);
  [[nodiscard]] bool close(const PhaseLoop& loop);
  void collect();
  [[nodiscard]] std::size_t place_of(std::size_t form, std::size_t input, std::size_t cell,
                                     std::size_t corner) const {
    return ((form * inputs_ + input) * phases_ + cell) * 4 + corner;
  }

  std::size_t phases_, forms_, inputs_, levels_ = 0;
  Table sums_;                  ///< by place_of, then level and first cell
  std::vector<Groups> groups_;  ///< the same without those that are 0
  Table rest_;                  ///< by form and input
  Table defect_;                ///< M
  Table totals_;                ///< sum of |G_k| |B|, by input and state
  Table powers_;                ///< sum of |G_k|
  bool is_certain_ = false;
};

}  // namespace veritrack::checker

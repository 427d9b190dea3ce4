// How much of an input of earlier samples there is in a form at each phase, where the matrix, the columns and
// the forms depend on the phase (docs/gain-proof.md, section 10).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "checker/model/gain/grid_function.hpp"

namespace veritrack::checker {

/// Columns of an input of two components, in a disc. `second` is empty where there is one component.
struct PhaseInput {
  GridFunction first;
  GridFunction second;
};

/// Differences to earlier samples, whose frequencies may be in other parts, from a lag on.
struct PhaseStage {
  std::size_t first_lag = 0;
  /// The error of A^(k), from the line between the matrices of the loop.
  Table matrix_error;
  std::vector<std::array<std::vector<double>, 2>> column_errors;  ///< by input and its component
};

/// The lags over which responses are added up.
struct PhaseHorizon {
  std::size_t single = 0;       ///< K, at most 2^16: one by one
  std::size_t late_blocks = 0;  ///< of later lags, which are taken by turns of the phase
  std::size_t late_turns = 0;   ///< of a block, at most 2^16 lags
};

/// A loop at the frequencies of a part. Sizes of numbers are those of doubles: all of them have to be finite,
/// or nothing is valid.
struct PhaseLoop {
  std::size_t phases = 0;  ///< N
  PhaseHorizon horizon;
  double low = 0.0, high = 0.0;  ///< enclose the frequencies, in parts of a turn of 2 pi/N per sample
  double slew = 0.0;             ///< W in the same unit
  /// Those of which powers are taken, at both ends of the frequencies, row by row. With a slew both are the
  /// same, and so are both ends of forms and inputs: earlier samples may be at any frequency.
  std::array<Table, 2> matrix;
  std::vector<GridFunction> forms;
  std::vector<PhaseInput> inputs;
  std::vector<PhaseStage> stages;  ///< from lag 0 on, by lag
  std::vector<bool> has_one_size;  ///< by input: the same size at all phases
};

/// Sizes of an input by cell of phases: the largest of 2^level cells from each one on, twice around.
struct PhaseSizes {
  explicit PhaseSizes(const std::vector<double>& sizes);
  Table most;
  double largest = 0.0;
};

/// Sums over the lags; of cells of phases, by the grid points at both ends.
struct EndSums {
  std::vector<double> left, right;
};

class NearPowers;

class PhaseKernels {
 public:
  explicit PhaseKernels(const PhaseLoop& loop);

  /// Whether the loop is one: nothing else is known where it is not.
  [[nodiscard]] bool is_valid() const { return is_valid_; }
  /// M, by which the bounds T of all sums are closed.
  [[nodiscard]] const Table& defect() const { return defect_; }
  /// sum of |G_k|(|B| + error), of an input.
  [[nodiscard]] const std::vector<double>& total(std::size_t input) const { return totals_[input]; }
  /// sum of |G_k|s.
  [[nodiscard]] std::vector<double> total_of(const std::vector<double>& s) const;
  /// The largest |G_k|s over the lags from `first` on.
  [[nodiscard]] std::vector<double> largest_from(std::size_t first, const std::vector<double>& s) const;

  /// Adds what this input contributes to a form, but for the rest; sizes of as many phases as the loop has.
  void add(std::size_t form, std::size_t input, const PhaseSizes& sizes, EndSums& sums) const;
  /// The factor of the largest of its sizes, where all sums of the input are at most `bound`.
  [[nodiscard]] double rest(std::size_t form, std::size_t input, const std::vector<double>& bound) const;
  /// (|c| + error) bound.
  [[nodiscard]] double of_form(std::size_t form, const std::vector<double>& bound) const;

 private:
  /// 2^level cells from `first` on, counted from the cell of the form.
  struct Source {
    std::size_t level = 0;
    std::size_t first = 0;
  };
  class Lags;
  class LateLags;

  void allocate(const PhaseLoop& loop);
  void sum_up(const PhaseLoop& loop);
  void add_late_lags(const PhaseLoop& loop, const NearPowers& powers, Table& sums);
  void add_late(std::size_t form, std::size_t input, const PhaseSizes& sizes, EndSums& sums) const;
  [[nodiscard]] std::size_t place_of(std::size_t form, std::size_t input) const {
    return form * inputs_ + input;
  }

  std::size_t phases_, states_, horizon_, forms_, inputs_, levels_ = 0;
  std::array<Table, 2> matrix_;
  std::vector<Source> sources_;             ///< of all lags, each once
  std::vector<std::size_t> source_of_lag_;  ///< the number
  std::vector<std::vector<float>> sums_;    ///< by place_of, then source and grid point
  std::vector<std::vector<float>> late_;  ///< by place_of, then grid point and cell; empty without late lags
  std::size_t late_lags_ = 0;
  std::vector<Table> largest_late_;  ///< |G| by block
  double step_ = 0.0;                ///< the highest frequency, in parts of a turn
  Table rest_;                       ///< by form and input
  Table form_sizes_;                 ///< |c| + error, by form and state
  Table power_sum_, defect_, totals_;
  bool is_valid_ = false;
};

}  // namespace veritrack::checker

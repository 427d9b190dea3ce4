// The effect of past inputs of a loop on its forms, by the phases at which they came in (docs/gain-proof.md,
// section 10).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/gain/phase_part.hpp"

namespace veritrack::model {

/// Bounds of sums over all lags, of absolute values of states, for all parts together: of each column (noise,
/// slew, gates), of the residual and rounding, and of 1 in each state.
struct PhaseTotals {
  std::vector<std::vector<double>> of_column;
  std::vector<double> residual, contraction;
};

/// The powers of a part's matrix, and sums with them, in two stages: first over the lags alone, then, once
/// totals for all parts are known, over lags and phases.
class PhaseKernels {
 public:
  static constexpr std::size_t kBlocks = 64;
  static constexpr std::size_t kNoise = 0, kSlew = 1, kFirstGate = 2;  ///< columns

  /// The kernels of part number `index`, with the slew with which `parts` were widened. Needs the upward
  /// rounding mode.
  PhaseKernels(const std::vector<PhasePart>& parts, std::size_t index, const PhaseGridding& gridding,
               double slew);

  /// The least totals for all of these, or empty.
  [[nodiscard]] static std::optional<PhaseTotals> totals_of(const std::vector<PhaseKernels>& all);
  /// The second stage.
  void find(const PhaseTotals& totals);

  /// The effect of deviations of these sizes on states, by blocks of lags from which on, and at last beyond
  /// the horizon. `peak`: for all of `all`.
  [[nodiscard]] static std::optional<std::vector<double>> peak_of(const std::vector<PhaseKernels>& all,
                                                                  const std::vector<double>& start);
  /// By form: a bound of what starts do from this block on.
  [[nodiscard]] std::vector<double> from_start(const std::vector<double>& start,
                                               const std::vector<double>& peak, std::size_t block) const;

  /// Cells of phases, as many as a power of 2.
  struct Window {
    std::size_t offset = 0;  ///< the first cell, from the cell of the form on
    std::size_t exponent = 0;
  };
  [[nodiscard]] const std::vector<Window>& windows() const { return windows_; }
  [[nodiscard]] std::size_t forms() const { return part_->forms.size(); }
  [[nodiscard]] std::size_t columns() const { return columns_.size(); }
  /// The gain from noise or slew, at a point of the grid.
  [[nodiscard]] double gain(std::size_t form, std::size_t column, std::size_t point) const {
    return sums_[form][column][point];
  }
  /// The gains from a gate, at a point of the grid: by windows.
  [[nodiscard]] const double* gains(std::size_t form, std::size_t column, std::size_t point) const {
    return sums_[form][column].data() + point * windows_.size();
  }
  /// The gains from late inputs of a gate, by the cell of phases at which they came in; empty where there are
  /// none.
  [[nodiscard]] const double* late(std::size_t form, std::size_t column, std::size_t point) const {
    return late_[form][column].data() + point * phases_;
  }
  [[nodiscard]] bool has_late() const { return late_blocks_ > 0; }
  /// The sizes of an input by cells of phases, as late inputs may have them (near the ends of a cell, those
  /// of the next one).
  [[nodiscard]] std::vector<double> late_sizes(const std::vector<double>& sizes) const;
  /// The part that the sums on the grid miss, times the largest size of the input.
  [[nodiscard]] double missed(std::size_t form, std::size_t column) const { return missed_[form][column]; }
  [[nodiscard]] double residual(std::size_t form) const { return residual_[form]; }

 private:
  using Vector = std::vector<double>;
  /// A column of the network, with several components where it is noise.
  struct Column {
    std::vector<const GridFunction*> components;
    Vector sizes;     ///< S: sum of |G_k| (|B| + error at lag k)
    Vector bent;      ///< what a form misses in Lemma 2, but for what is with its differences
    Vector leaned;    ///< the same for half of what the form changes over the part
    Vector mistaken;  ///< sum of |G_k| error at lag k
  };
  /// The known bounds of the part and its neighbours.
  struct Neighbours {
    std::size_t reach = 0;
    Vector off;                              ///< of matrices, from the line of the part
    std::vector<std::vector<Vector>> error;  ///< by column, component
  };

  void find_columns();
  void find_windows();
  void find_lags(const std::vector<PhasePart>& parts, std::size_t index);
  void widen(const std::vector<PhasePart>& parts, std::size_t index, std::size_t reach,
             Neighbours& neighbours) const;
  void add_lag(std::size_t lag, const Neighbours& neighbours);
  void add_defect(std::size_t lag, const Neighbours& neighbours);
  /// The larger one of both ends, and half of the difference, of an entry of the power.
  [[nodiscard]] double size_of_power(std::size_t lag, std::size_t entry) const;
  [[nodiscard]] double lean_of_power(std::size_t lag, std::size_t entry) const;
  [[nodiscard]] static std::optional<Vector> least_total(const std::vector<PhaseKernels>& all,
                                                         const std::vector<Vector>& sums);
  [[nodiscard]] double half_width_at(std::size_t lag) const;
  [[nodiscard]] double missed_of(const GridFunction& form, const Column& column, const Vector& total) const;
  void add_sums();
  struct LateTurn;
  [[nodiscard]] LateTurn late_turn() const;
  void find_late();
  struct LateBlock;
  /// The lags of a block; `power`: at both ends of the part, which goes on to the next block.
  [[nodiscard]] LateBlock late_block(std::size_t block, std::array<Vector, 2>& power);
  void add_late_block(const LateBlock& of, bool is_last);
  /// The excess of a product of three functions that are linear in the frequency over its values at both
  /// ends.
  void add_knot(const Vector& size, const Vector& lean);
  /// That of the part, at one of its ends.
  [[nodiscard]] Vector end_matrix(std::size_t end) const;
  /// Of two matrices of the states, row by row.
  [[nodiscard]] Vector product_of(const Vector& a, const Vector& b) const;
  void add_late_sums();
  class LagSums;

  const PhasePart* part_;
  std::size_t states_, phases_, horizon_, late_blocks_, late_every_, lags_, all_lags_;
  double slew_;
  std::vector<Column> columns_;
  /// Powers of the matrix at both ends of the part, by lag, row by row.
  std::array<Vector, 2> powers_;
  std::array<std::vector<Vector>, 2> knots_;  ///< powers where late blocks begin, and at the end
  Vector power_sum_;                          ///< of absolute values
  Vector early_power_sum_;                    ///< of the lags that are taken one by one
  Vector defect_;                             ///< M
  std::vector<Vector> largest_power_;         ///< by block: of absolute values from it on
  std::vector<Window> windows_;
  std::vector<std::size_t> window_of_;  ///< by lag
  std::vector<std::vector<Vector>> sums_;
  std::vector<std::vector<Vector>> late_;  ///< by form, column, point of the grid and cell
  std::vector<Vector> missed_;
  Vector residual_;
};

}  // namespace veritrack::model

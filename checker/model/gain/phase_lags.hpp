// The sums of phase_kernels.hpp, lag by lag.
#pragma once

#include <cmath>

#include "checker/model/gain/phase_kernels.hpp"

namespace veritrack::checker {

/// The rounding of sums of at most 2^17 numbers that are not negative, one after the other, and of what is
/// added to them.
constexpr double kManyRoundings = 1.0 + 0x1p-34;
/// More than all that such sums lose to underflow.
constexpr double kManyUnderflows = 0x1p-900;

/// Not below it.
inline float float_above(double x) {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) < x ? std::nextafter(near, HUGE_VALF) : near;
}

/// Powers of the matrices at both ends of the frequencies in doubles, between which they are linear, and what
/// they differ by from products of matrices near the line between both.
class NearPowers {
 public:
  explicit NearPowers(const std::array<Table, 2>& matrix);
  [[nodiscard]] const Table& power(std::size_t end) const { return power_[end]; }
  /// |row| |G|.
  [[nodiscard]] std::vector<double> through(const std::vector<double>& row) const {
    return row_times(row, size_);
  }
  /// |row| |L|, where L is half of what G differs by between both ends.
  [[nodiscard]] std::vector<double> through_lean(const std::vector<double>& row) const {
    return row_times(row, lean_);
  }
  /// |G| column.
  [[nodiscard]] std::vector<double> times(const std::vector<double>& column) const;
  /// The larger size of both ends, and half of their difference or more.
  [[nodiscard]] const Table& size() const { return size_; }
  [[nodiscard]] const Table& lean() const { return lean_; }
  void advance();
  /// Adds sup |G_(k+1) - G_k A|; the power after the last one is 0.
  void add_defect(const Table& matrix_error, bool is_last, Table& defect) const;
  /// The same for powers of such sizes.
  void add_defect(const Table& sizes, const Table& leans, const Table& matrix_error, bool is_last,
                  Table& defect) const;

 private:
  [[nodiscard]] static std::vector<double> row_times(const std::vector<double>& row, const Table& sizes);
  /// The larger size of both, and half of the difference or more.
  static void compare(const std::array<Table, 2>& ends, Table& size, Table& lean);

  const std::array<Table, 2>* matrix_;
  std::array<Table, 2> power_;
  Table size_, lean_;  ///< of the powers
  Table next_;
  Table matrix_size_, matrix_lean_;
};

/// Where the inputs of a lag come from.
struct LagPlace {
  LagPlace(const PhaseLoop& loop, std::size_t lag);
  double low = 0.0, high = 0.0;  ///< omega_p -+ d_k, in parts of a turn
  double steps = 1.0;            ///< k + 1
  double spread = 0.0;           ///< how many parts of a turn there are between what comes from both ends
  double bend = 0.0;             ///< F_k
  std::size_t first = 0;         ///< the first cell, counted from that of the form
  double cells = 1.0;            ///< from the first cell on
};

/// The values of a column at the phases of all grid points less `steps` times a frequency, by component.
class ShiftedColumn {
 public:
  ShiftedColumn(const GridFunction& column, std::size_t end);
  void shift(double steps, double frequency);
  [[nodiscard]] const std::vector<double>& component(std::size_t i) const { return shifted_[i]; }
  [[nodiscard]] bool is_empty() const { return twice_.empty(); }

 private:
  Table twice_;  ///< the values twice around, by component
  Table shifted_;
};

}  // namespace veritrack::checker

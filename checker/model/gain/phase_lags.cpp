#include "checker/model/gain/phase_lags.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::checker {

NearPowers::NearPowers(const Table& matrix)
    : matrix_(&matrix), power_(matrix.size(), std::vector<double>(matrix.size(), 0.0)) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    power_[i][i] = 1.0;
  }
}

std::vector<double> NearPowers::through(const std::vector<double>& row) const {
  std::vector<double> result(row.size(), 0.0);
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      result[j] += std::abs(row[i]) * std::abs(power_[i][j]);
    }
  }
  return result;
}

std::vector<double> NearPowers::times(const std::vector<double>& column) const {
  std::vector<double> result(column.size(), 0.0);
  for (std::size_t i = 0; i < column.size(); ++i) {
    for (std::size_t j = 0; j < column.size(); ++j) {
      result[i] += std::abs(power_[i][j]) * column[j];
    }
  }
  return result;
}

void NearPowers::advance() {
  spend(static_cast<std::int64_t>(power_.size() * power_.size()));
  Table next(power_.size(), std::vector<double>(power_.size(), 0.0));
  for (std::size_t i = 0; i < power_.size(); ++i) {
    for (std::size_t k = 0; k < power_.size(); ++k) {
      for (std::size_t j = 0; j < power_.size(); ++j) {
        next[i][j] += power_[i][k] * (*matrix_)[k][j];
      }
    }
  }
  power_ = std::move(next);
}

void NearPowers::add_defect(const Table& matrix_error, bool is_last, Table& defect) const {
  constexpr double kOfProducts = 0x1p-45;  // far above 33 roundings
  for (std::size_t i = 0; i < power_.size(); ++i) {
    for (std::size_t k = 0; k < power_.size(); ++k) {
      const double size = std::abs(power_[i][k]);
      for (std::size_t j = 0; j < power_.size(); ++j) {
        const double entry = std::abs((*matrix_)[k][j]);
        defect[i][j] += size * (matrix_error[k][j] + (is_last ? entry : kOfProducts * entry));
      }
    }
  }
}

LagPlace::LagPlace(const PhaseLoop& loop, std::size_t lag) : steps(static_cast<double>(lag + 1)) {
  const double more = up(0.5 * (steps + 1.0) * loop.slew);
  low = loop.low - up(more + 0x1p-40 * std::abs(loop.low));
  high = loop.high + up(more + 0x1p-40 * std::abs(loop.high));
  const double length = up(1.0 + up(steps * up(high - low)));  // L
  const double squares = up((length - 1.0) * (length - 1.0)) + 1.0;
  bend = up(std::min(0.25 * up(length * std::ceil(length)), 0.125 * squares + 0.25 * up(std::sqrt(squares))));
  const double from = std::floor(-steps * high - kPlaceError);
  const double to = std::floor(1.0 - steps * low + kPlaceError);
  first = grid_cell(from, loop.phases);
  cells = to - from + 1.0;
}

ShiftedColumn::ShiftedColumn(const GridFunction& column) {
  if (column.values.empty()) {
    return;
  }
  const std::size_t phases = column.values.size();
  twice_.assign(column.error.size(), std::vector<double>(2 * phases + 1));
  shifted_.assign(column.error.size(), std::vector<double>(phases));
  for (std::size_t i = 0; i < twice_.size(); ++i) {
    for (std::size_t g = 0; g < twice_[i].size(); ++g) {
      twice_[i][g] = column.values[g % phases][i];
    }
  }
}

void ShiftedColumn::shift(double steps, double frequency) {
  const double place = -steps * frequency;
  const double cell = std::floor(place);
  const double share = place - cell;
  for (std::size_t i = 0; i < twice_.size(); ++i) {
    const std::size_t phases = shifted_[i].size();
    const double* const from = twice_[i].data() + grid_cell(cell, phases);
    double* const to = shifted_[i].data();
    for (std::size_t g = 0; g < phases; ++g) {
      to[g] = (1.0 - share) * from[g] + share * from[g + 1];
    }
  }
}

}  // namespace veritrack::checker

#include "checker/model/gain/phase_lags.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

NearPowers::NearPowers(const std::array<Table, 2>& matrix) : matrix_(&matrix) {
  const std::size_t n = matrix[0].size();
  Table identity(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    identity[i][i] = 1.0;
  }
  power_ = {identity, identity};
  next_ = identity;
  compare(power_, size_, lean_);
  compare(*matrix_, matrix_size_, matrix_lean_);
}

void NearPowers::compare(const std::array<Table, 2>& ends, Table& size, Table& lean) {
  size.resize(ends[0].size(), std::vector<double>(ends[0].size()));
  lean.resize(ends[0].size(), std::vector<double>(ends[0].size()));
  for (std::size_t i = 0; i < size.size(); ++i) {
    for (std::size_t j = 0; j < size.size(); ++j) {
      const double low = ends[0][i][j];
      const double high = ends[1][i][j];
      lean[i][j] = up(0.5 * std::abs(high - low));  // no number where one of them is none
      size[i][j] = std::max(std::abs(low), std::abs(high)) + 0.0 * (low + high);
    }
  }
}

std::vector<double> NearPowers::row_times(const std::vector<double>& row, const Table& sizes) {
  std::vector<double> result(row.size(), 0.0);
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      result[j] += std::abs(row[i]) * sizes[i][j];
    }
  }
  return result;
}

std::vector<double> NearPowers::times(const std::vector<double>& column) const {
  std::vector<double> result(column.size(), 0.0);
  for (std::size_t i = 0; i < column.size(); ++i) {
    for (std::size_t j = 0; j < column.size(); ++j) {
      result[i] += size_[i][j] * column[j];
    }
  }
  return result;
}

void NearPowers::advance() {
  const std::size_t n = size_.size();
  spend(static_cast<std::int64_t>(n * n));
  for (const std::size_t end : {0U, 1U}) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        double sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
          sum += power_.at(end)[i][k] * matrix_->at(end)[k][j];
        }
        next_[i][j] = sum;
      }
    }
    std::swap(power_.at(end), next_);
  }
  compare(power_, size_, lean_);
}

// With G = G_0 + z L and A = A_0 + z A_1 + error, |z| <= 1, the next power is that of each end up to
// rounding, and G_(k+1) - G_k A = (1 - z^2) L A_1 + rounding - G error.
void NearPowers::add_defect(const Table& matrix_error, bool is_last, Table& defect) const {
  add_defect(size_, lean_, matrix_error, is_last, defect);
}

void NearPowers::add_defect(const Table& sizes, const Table& leans, const Table& matrix_error, bool is_last,
                            Table& defect) const {
  constexpr double kOfProducts = 0x1p-45;  // far above 33 roundings
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const double size = sizes[i][k];
      const double lean = leans[i][k];
      for (std::size_t j = 0; j < sizes.size(); ++j) {
        const double entry = matrix_size_[k][j];
        defect[i][j] +=
            size * (matrix_error[k][j] + (is_last ? entry : kOfProducts * entry)) + lean * matrix_lean_[k][j];
      }
    }
  }
}

LagPlace::LagPlace(const PhaseLoop& loop, std::size_t lag) : steps(static_cast<double>(lag + 1)) {
  // Without a slew the ends are those of the functions: what comes from there is in between.
  const double more = up(0.5 * (steps + 1.0) * loop.slew);
  low = loop.slew == 0.0 ? loop.low : loop.low - up(more + 0x1p-40 * std::abs(loop.low));
  high = loop.slew == 0.0 ? loop.high : loop.high + up(more + 0x1p-40 * std::abs(loop.high));
  spread = up(steps * up(high - low));
  bend = up(std::min(0.25 * up(spread * std::ceil(spread)), 0.125 * up(spread * spread) + 0.25 * spread));
  const double from = std::floor(-steps * high - kPlaceError);
  const double to = std::floor(1.0 - steps * low + kPlaceError);
  first = grid_cell(from, loop.phases);
  cells = to - from + 1.0;
}

ShiftedColumn::ShiftedColumn(const GridFunction& column, std::size_t end) {
  if (column.is_empty()) {
    return;
  }
  const Table& values = column.values.at(end);
  const std::size_t phases = values.size();
  twice_.assign(column.error.size(), std::vector<double>(2 * phases + 1));
  shifted_.assign(column.error.size(), std::vector<double>(phases));
  for (std::size_t i = 0; i < twice_.size(); ++i) {
    for (std::size_t g = 0; g < twice_[i].size(); ++g) {
      twice_[i][g] = values[g % phases][i];
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

// Differences to earlier samples at other frequencies.
#include "checker/model/gain/phase_group.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

/// A T that is at least N + N T, where the rows of N certainly have sums below 1; or nothing.
std::optional<Table> closed_multiplier(const Table& n) {
  for (const std::vector<double>& row : n) {
    double sum = 0.0;
    for (const double entry : row) {
      sum = up(sum + entry);
    }
    if (!(sum < 1.0)) {
      return std::nullopt;
    }
  }
  Table result(n.size(), std::vector<double>(n.size()));
  for (std::size_t j = 0; j < n.size(); ++j) {
    std::vector<double> column;
    for (const std::vector<double>& row : n) {
      column.push_back(row[j]);
    }
    const std::optional<std::vector<double>> bound = closed_together({&n}, {column});
    if (!bound) {
      return std::nullopt;
    }
    for (std::size_t i = 0; i < n.size(); ++i) {
      result[i][j] = (*bound)[i];
    }
  }
  return result;
}

/// The largest difference at grid points, by component, of functions that do not lean.
std::vector<double> difference_of(const GridFunction& x, const GridFunction& y) {
  std::vector<double> result(x.error.size(), 0.0);
  for (std::size_t g = 0; g < x.values[0].size(); ++g) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = std::max(result[i], up(std::abs(x.values[0][g][i] - y.values[0][g][i])));
    }
  }
  return result;
}

}  // namespace

std::optional<PhaseGroup::Widened> PhaseGroup::widened(const PhasePart& part) const {
  Widened result{Table(part.off.size(), std::vector<double>(part.off.size(), 0.0)),
                 {},
                 part.residual,
                 part.rounding.of_step};
  for (const PhaseInput& input : part.inputs) {
    result.column_errors.push_back({input.first.error, input.second.error});
  }
  if (slew_ == 0.0) {
    return result;
  }
  Table move = product_above(part.inverse, part.basis_bend);
  for (std::size_t i = 0; i < move.size(); ++i) {
    for (std::size_t j = 0; j < move.size(); ++j) {
      const double bend = upward_product(0.5 * slew_, move[i][j]);
      move[i][j] = up(upward_product(slew_, up(part.turned[i][j] + bend)));
    }
  }
  const std::optional<Table> more = closed_multiplier(move);
  if (!more) {
    return std::nullopt;
  }
  Table size = part.off;
  for (std::size_t i = 0; i < size.size(); ++i) {
    for (std::size_t j = 0; j < size.size(); ++j) {
      size[i][j] = largest_in({part.matrix_low[i][j], part.matrix_high[i][j]});
    }
  }
  result.of_matrix = product_above(*more, size);
  std::vector<double> bend = product_above(part.inverse, part.curve_bend);
  for (double& entry : bend) {
    entry = up(upward_product(0.5 * slew_, entry));
  }
  add_to(result.column_errors[PhasePart::kSlew][0], bend);
  for (std::size_t input = 0; input < part.inputs.size(); ++input) {
    for (const std::size_t which : {0U, 1U}) {
      std::vector<double>& error = result.column_errors[input][which];
      std::vector<double> whole =
          grid_sizes(which == 0 ? part.inputs[input].first : part.inputs[input].second).value;
      add_to(whole, error);
      if (!error.empty()) {
        add_to(error, product_above(*more, whole));
      }
    }
  }
  add_to(result.residual, product_above(*more, part.residual));
  add_to(result.rounding, product_above(*more, part.rounding.of_step));
  return result;
}

std::vector<PhaseStage> PhaseGroup::stages(const std::vector<Widened>& all, std::size_t part) const {
  // Where each part comes in: it is at most (k + 1) slew away.
  std::vector<std::pair<double, std::size_t>> arrivals;
  for (std::size_t other = 0; other < parts_.size(); ++other) {
    const Ball gap =
        max(parts_[other]->lowest - parts_[part]->highest, parts_[part]->lowest - parts_[other]->highest);
    const double lag = other == part || slew_ == 0.0 ? 0.0 : (gap / Ball(slew_)).lower_double() - 2.0;
    arrivals.emplace_back(lag > 0.0 ? std::floor(lag) : 0.0, other);
  }
  std::sort(arrivals.begin(), arrivals.end());
  std::vector<PhaseStage> result;
  for (const auto& [lag, other] : arrivals) {
    spend(static_cast<std::int64_t>(phases_));
    PhaseStage stage{static_cast<std::size_t>(std::min(lag, 0x1p20)), all[other].of_matrix,
                     all[other].column_errors};
    for (std::size_t i = 0; i < stage.matrix_error.size(); ++i) {
      for (std::size_t j = 0; j < stage.matrix_error.size(); ++j) {
        if (slew_ == 0.0) {
          stage.matrix_error[i][j] = parts_[part]->off[i][j];
          continue;
        }
        const double middle = parts_[part]->matrix[0][i][j];
        const double distance = std::max(std::abs(parts_[other]->matrix_high[i][j] - middle),
                                         std::abs(parts_[other]->matrix_low[i][j] - middle));
        // Each difference is rounded once.
        stage.matrix_error[i][j] = up(up(distance) + 0x1p-50 * std::abs(middle) + stage.matrix_error[i][j]);
      }
      if (!result.empty()) {
        raise_all(stage.matrix_error[i], result.back().matrix_error[i]);
      }
    }
    for (std::size_t input = 0; input < stage.column_errors.size(); ++input) {
      const PhaseInput& mine = parts_[part]->inputs[input];
      const PhaseInput& theirs = parts_[other]->inputs[input];
      add_to(stage.column_errors[input][0], difference_of(mine.first, theirs.first));
      add_to(stage.column_errors[input][1], difference_of(mine.second, theirs.second));
      for (const std::size_t which : {0U, 1U}) {
        if (!result.empty()) {
          raise_all(stage.column_errors[input][which], result.back().column_errors[input][which]);
        }
      }
    }
    if (!result.empty() && result.back().first_lag == stage.first_lag) {
      result.back() = std::move(stage);
    } else {
      result.push_back(std::move(stage));
    }
  }
  return result;
}

}  // namespace veritrack::checker

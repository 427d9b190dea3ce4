// The kernels of bounds that are resolved over the phases: what a past input does to a form.
#include "analysis/model/gain/phase_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;

namespace {

/// Rounding of a sum of products over the states, and of the place of a phase in the grid, relative to the
/// absolute values of the factors.
constexpr double kRounding = 1e-9;

/// a' G b for vectors of absolute values and a matrix of them.
double product(const std::vector<double>& a, const std::vector<double>& g, const std::vector<double>& b) {
  const std::size_t n = a.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      sum += a[i] * g[i * n + j] * b[j];
    }
  }
  return sum;
}

std::vector<double> plus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> sum = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum[i] += b[i];
  }
  return sum;
}

Interval polynomial(const std::vector<double>& coefficients, const Interval& z) {
  Interval sum(0.0);
  for (std::size_t d = coefficients.size(); d-- > 0;) {
    sum = sum * z + Interval(coefficients[d]);
  }
  return sum;
}

}  // namespace

void PhaseLoop::find_windows(const FloquetCell& cell, const PhaseGridding& gridding, std::size_t part) {
  const std::size_t n = states_;
  const double turn = 2.0 * std::numbers::pi;
  const double points = static_cast<double>(phases_) / turn;
  // Powers of the matrix in the middle: any doubles will do.
  const double z = (2.0 * static_cast<double>(part) + 1.0) / static_cast<double>(gridding.parts) - 1.0;
  rigor::SmallMatrix middle(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n * n; ++i) {
    middle(static_cast<Eigen::Index>(i / n), static_cast<Eigen::Index>(i % n)) =
        rigor::midpoint(polynomial(cell.matrix[i], Interval(z)));
  }
  rigor::SmallMatrix power = rigor::identity(static_cast<Eigen::Index>(n));
  powers_.clear();
  power_sum_.assign(n * n, 0.0);
  power_sum_weighted_.assign(n * n, 0.0);
  defect_.assign(n * n, 0.0);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  for (std::size_t k = 0; k < horizon_; ++k) {
    const double lag = static_cast<double>(k + 1);
    const double length = 1.0 + 2.0 * lag * half_width_ * points * (1.0 + 1e-12);
    const double spread = (length - 1.0) * (length - 1.0) + 1.0;
    const double bend =
        std::min(0.25 * length * std::ceil(length), 0.125 * spread + 0.25 * std::sqrt(spread));
    const rigor::SmallMatrix next =
        k + 1 < horizon_ ? rigor::product(power, middle)
                         : rigor::SmallMatrix(rigor::SmallMatrix::Zero(middle.rows(), middle.cols()));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double entry = power(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        powers_.push_back(entry);
        power_sum_[i * n + j] += std::fabs(entry);
        power_sum_weighted_[i * n + j] += std::fabs(entry) * bend;
        Interval defect(next(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
        for (std::size_t m = 0; m < n; ++m) {
          defect -=
              Interval(power(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m))) * matrix_[m][j];
        }
        defect_[i * n + j] += rigor::magnitude(defect);
      }
    }
    power = next;
    const double low = -lag * (first_ + half_width_) * points - 1e-6;
    const double width = std::ceil(length + 2e-6) + 1.0;
    const double wrapped =
        low - std::floor(low / static_cast<double>(phases_)) * static_cast<double>(phases_);
    Window window;
    window.offset = static_cast<std::size_t>(std::floor(wrapped)) % phases_;
    window.width = width < static_cast<double>(phases_) ? static_cast<std::size_t>(width) : phases_;
    const auto [found, is_new] = known.try_emplace({window.offset, window.width}, windows_.size());
    if (is_new) {
      windows_.push_back(window);
    }
    window_of_.push_back(found->second);
  }
}

std::optional<std::vector<double>> PhaseLoop::total_of(const std::vector<GridFunction>& columns) const {
  const std::size_t n = states_;
  std::vector<double> sum(n, 0.0);
  for (const GridFunction& column : columns) {
    const std::vector<double> sizes = plus(column.largest, column.error);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        sum[i] += power_sum_[i * n + j] * sizes[j];
      }
    }
  }
  const auto after = [&](const std::vector<double>& total) {
    std::vector<double> next = sum;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        next[i] += defect_[i * n + j] * total[j];
      }
    }
    return next;
  };
  std::vector<double> total = sum;
  for (int i = 0; i < 100; ++i) {
    total = after(total);
  }
  for (double& each : total) {
    each = each * (1.0 + 1e-6) + 1e-300;
  }
  const std::vector<double> next = after(total);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(next[i] <= total[i]) || !std::isfinite(total[i])) {
      return std::nullopt;
    }
  }
  return total;
}

double PhaseLoop::missed_of(const GridFunction& form, const GridFunction& column,
                            const std::vector<double>& total) const {
  const std::vector<double> all = plus(form.largest, form.error);
  const double interpolated = product(form.largest, power_sum_weighted_, column.second_difference) +
                              0.25 * product(form.first_difference, power_sum_, column.first_difference);
  const double errors = product(form.error, power_sum_, plus(column.largest, column.error)) +
                        product(form.largest, power_sum_, column.error);
  return interpolated + errors + product(all, defect_, total) +
         kRounding * product(all, power_sum_, plus(column.largest, column.error));
}

void PhaseLoop::add_sums(const GridFunction& form, const std::vector<GridFunction>& columns,
                         std::vector<double>& sums) const {
  const std::size_t n = states_;
  const std::size_t windows = windows_.size();
  const double points = static_cast<double>(phases_) / (2.0 * std::numbers::pi);
  sums.assign(phases_ * 4 * windows, 0.0);
  std::vector<double> row(n);
  for (std::size_t k = 0; k < horizon_; ++k) {
    const double lag = static_cast<double>(k + 1);
    const double* power = powers_.data() + k * n * n;
    for (int side = 0; side < 2; ++side) {
      const double back = lag * (first_ + (side == 0 ? -half_width_ : half_width_)) * points;
      const double whole = std::floor(-back);
      const double share = -back - whole;
      const auto offset = static_cast<std::size_t>(whole - std::floor(whole / static_cast<double>(phases_)) *
                                                               static_cast<double>(phases_));
      for (std::size_t g = 0; g < phases_; ++g) {
        const std::size_t from = (g + offset) % phases_;
        const std::size_t to = (from + 1) % phases_;
        for (std::size_t j = 0; j < n; ++j) {
          row[j] = 0.0;
          for (std::size_t i = 0; i < n; ++i) {
            row[j] += form.values[i][g] * power[i * n + j];
          }
        }
        double squares = 0.0;
        double size = 0.0;
        for (const GridFunction& column : columns) {
          double z = 0.0;
          for (std::size_t j = 0; j < n; ++j) {
            const double here = column.values[j][from];
            z += row[j] * (here + share * (column.values[j][to] - here));
          }
          squares += z * z;
          size = std::fabs(z);
        }
        const double value = columns.size() == 1 ? size : std::sqrt(squares);
        // The point g is the left corner of the cell g, and the right one of the cell before.
        const std::size_t before = (g + phases_ - 1) % phases_;
        const auto right = static_cast<std::size_t>(2 + side);
        sums[(g * 4 + static_cast<std::size_t>(side)) * windows + window_of_[k]] += value;
        sums[(before * 4 + right) * windows + window_of_[k]] += value;
      }
    }
  }
}

bool PhaseLoop::find_kernels() {
  const std::size_t n = states_;
  const PhaseStep& first = steps_.front();
  std::map<int, GridFunction> columns;
  for (const auto& [input, column] : first.columns) {
    columns.emplace(
        input,
        grid_function(n, phases_, [&, input = input](std::size_t g, std::size_t i) -> const BallModel& {
          return steps_[g].columns.at(input)[i];
        }));
  }
  const GridFunction residual = grid_function(
      n, phases_, [&](std::size_t g, std::size_t i) -> const BallModel& { return steps_[g].residual[i]; });
  std::vector<GridFunction> noise;
  for (std::size_t c = 0; c < first.inputs.size() && first.inputs[c].is_noise; ++c) {
    noise.push_back(columns.at(static_cast<int>(c)));
  }
  const auto total_of_noise = total_of(noise);
  const auto total_of_residual = total_of({residual});
  if (!total_of_noise || !total_of_residual) {
    return false;
  }
  for (std::size_t f = 0; f < first.forms.size(); ++f) {
    const GridFunction form = grid_function(
        n, phases_,
        [&](std::size_t g, std::size_t i) -> const BallModel& { return steps_[g].forms[f].states[i]; });
    const std::vector<double> all = plus(form.largest, form.error);
    double from_residual = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      from_residual += all[i] * (*total_of_residual)[i];
    }
    residual_.push_back(from_residual);
    std::vector<double> sums;
    add_sums(form, noise, sums);
    double missed = 0.0;
    for (const GridFunction& each : noise) {
      missed += missed_of(form, each, *total_of_noise);
    }
    std::vector<double> gains(phases_, 0.0);
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t corner = 0; corner < 4; ++corner) {
        double sum = missed;
        for (std::size_t w = 0; w < windows_.size(); ++w) {
          sum += sums[(g * 4 + corner) * windows_.size() + w];
        }
        gains[g] = larger_or_nan(gains[g], sum);
      }
    }
    noise_.push_back(std::move(gains));
    std::vector<Kernel> kernels;
    for (const int gate : first.gates) {
      const auto total = total_of({columns.at(gate)});
      if (!total) {
        return false;
      }
      Kernel kernel;
      add_sums(form, {columns.at(gate)}, kernel.sums);
      kernel.missed = missed_of(form, columns.at(gate), *total);
      kernels.push_back(std::move(kernel));
    }
    kernels_.push_back(std::move(kernels));
  }
  return true;
}

}  // namespace veritrack::model

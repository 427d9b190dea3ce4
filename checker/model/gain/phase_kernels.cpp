#include "checker/model/gain/phase_kernels.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostPhaseStates = 32;
constexpr std::size_t kMostPhases = 512;
constexpr std::size_t kLongestPhaseHorizon = 1U << 16U;
/// Of sums of at most 2^17 numbers that are not negative, one after the other, and of what is added to them.
constexpr double kManyRoundings = 1.0 + 0x1p-34;

double product(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += upward_product(x[i], y[i]);
  }
  return up(sum);
}

/// row |G|.
std::vector<double> through(const std::vector<double>& row, const Table& matrix) {
  std::vector<double> result(row.size());
  for (std::size_t j = 0; j < row.size(); ++j) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      result[j] += upward_product(row[i], matrix[i][j]);
    }
    result[j] = up(result[j]);
  }
  return result;
}

std::vector<double> sum_of(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    result[i] = up(x[i] + y[i]);
  }
  return result;
}

Table sizes_of(const MatrixPowers& powers, std::size_t states) {
  Table result(states);
  for (std::size_t i = 0; i < states; ++i) {
    WideRow unit(states);
    unit[i].middle = 1.0;
    for (const WideNumber& entry : powers.product(unit)) {
      result[i].push_back(largest_size(entry));
    }
  }
  return result;
}

bool is_loop(const PhaseLoop& loop) {
  const std::size_t n = loop.columns.size();
  const std::size_t phases = loop.phases;
  if (n < 1 || n > kMostPhaseStates || phases < 8 || phases > kMostPhases || (phases & (phases - 1)) != 0 ||
      loop.horizon < 1 || loop.horizon > kLongestPhaseHorizon || loop.forms.empty() || loop.inputs.empty()) {
    return false;
  }
  const auto turn = static_cast<double>(phases);
  const bool is_band = std::isfinite(loop.low) && std::isfinite(loop.high) && loop.low <= loop.high &&
                       loop.low >= -turn && loop.high <= turn;
  return is_band &&
         std::all_of(loop.columns.begin(), loop.columns.end(),
                     [&](const WideRow& column) {
                       return column.size() == n &&
                              std::all_of(column.begin(), column.end(), [](const WideNumber& x) {
                                return std::isfinite(x.middle) && std::isfinite(x.radius) && x.radius >= 0.0;
                              });
                     }) &&
         std::all_of(loop.forms.begin(), loop.forms.end(),
                     [&](const GridFunction& f) { return is_grid_function(f, phases, n); }) &&
         std::all_of(loop.inputs.begin(), loop.inputs.end(), [&](const PhaseInput& input) {
           return is_grid_function(input.first, phases, n) &&
                  (input.second.values.empty() || is_grid_function(input.second, phases, n));
         });
}

}  // namespace

PhaseKernels::PhaseKernels(const PhaseLoop& loop)
    : phases_(loop.phases), forms_(loop.forms.size()), inputs_(loop.inputs.size()) {
  if (!is_loop(loop)) {
    return;
  }
  const std::size_t n = loop.columns.size();
  while ((std::size_t{1} << levels_) < phases_) {
    ++levels_;
  }
  sums_.assign(forms_ * inputs_ * phases_ * 4, std::vector<double>((levels_ + 1) * phases_, 0.0));
  rest_.assign(forms_, std::vector<double>(inputs_, 0.0));
  defect_.assign(n, std::vector<double>(n, 0.0));
  totals_.assign(inputs_, std::vector<double>(n, 0.0));
  powers_.assign(n, std::vector<double>(n, 0.0));
  MatrixPowers powers(loop.columns);
  for (std::size_t lag = 0; lag < loop.horizon; ++lag) {
    spend(static_cast<std::int64_t>(forms_ * inputs_ * phases_));
    add_corners(loop, powers, lag);
    add_rest(loop, powers, lag);
    powers.advance(defect_, lag + 1 == loop.horizon);
  }
  is_certain_ = close(loop);
  collect();
}

void PhaseKernels::add_corners(const PhaseLoop& loop, const MatrixPowers& powers, std::size_t lag) {
  const auto steps = static_cast<double>(lag + 1);
  std::vector<std::vector<WideRow>> rows(forms_);  // c G, by form and phase
  for (std::size_t form = 0; form < forms_; ++form) {
    for (const std::vector<double>& value : loop.forms[form].values) {
      WideRow row;
      for (const double entry : value) {
        row.push_back({entry, 0.0});
      }
      rows[form].push_back(powers.product(row));
    }
  }
  std::vector<std::size_t> kept(phases_);  // where in the sums of a place, by cell of the form
  for (std::size_t cell = 0; cell < phases_; ++cell) {
    const auto g = static_cast<double>(cell);
    const double first = std::floor(g - steps * loop.high - kPlaceError);
    const double last = std::floor(g + 1.0 - steps * loop.low + kPlaceError);
    std::size_t level = 0;  // more cells than it is from only make the weight larger
    while (level < levels_ && std::ldexp(1.0, static_cast<int>(level)) < last - first + 1.0) {
      ++level;
    }
    kept[cell] = level * phases_ + grid_cell(first, phases_);
  }
  for (std::size_t input = 0; input < inputs_; ++input) {
    const GridSizes first = grid_sizes(loop.inputs[input].first);
    const GridSizes second = grid_sizes(loop.inputs[input].second);
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t side = 0; side < 2; ++side) {
        const double place = static_cast<double>(g) - steps * (side == 0 ? loop.low : loop.high);
        const WideRow one_column = value_at(loop.inputs[input].first, first, place);
        WideRow other = value_at(loop.inputs[input].second, second, place);
        other.resize(one_column.size());
        for (std::size_t form = 0; form < forms_; ++form) {
          const double size = length(dot(rows[form][g], one_column), dot(rows[form][g], other));
          const std::size_t before = (g + phases_ - 1) % phases_;
          sums_[place_of(form, input, g, side)][kept[g]] += size;
          sums_[place_of(form, input, before, side + 2)][kept[before]] += size;
        }
      }
    }
  }
}

void PhaseKernels::add_rest(const PhaseLoop& loop, const MatrixPowers& powers, std::size_t lag) {
  const Table matrix = sizes_of(powers, loop.columns.size());
  const double cells = up(1.0 + up(static_cast<double>(lag + 1) * up(loop.high - loop.low)));  // L
  const double kinks = up(cells * std::ceil(cells)) / 4.0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    powers_[i] = sum_of(powers_[i], matrix[i]);
  }
  for (std::size_t input = 0; input < inputs_; ++input) {
    for (const GridFunction* column : {&loop.inputs[input].first, &loop.inputs[input].second}) {
      if (column->values.empty()) {
        continue;
      }
      const GridSizes of_column = grid_sizes(*column);
      const std::vector<double> whole = sum_of(of_column.value, column->error);
      for (std::size_t i = 0; i < matrix.size(); ++i) {
        totals_[input][i] = up(totals_[input][i] + product(matrix[i], whole));
      }
      for (std::size_t form = 0; form < forms_; ++form) {
        const GridSizes of_form = grid_sizes(loop.forms[form]);
        const std::vector<double> value = through(of_form.value, matrix);
        rest_[form][input] +=
            upward_product(product(value, of_column.second_difference), kinks) +
            product(through(of_form.first_difference, matrix), of_column.first_difference) / 4.0 +
            product(through(loop.forms[form].error, matrix), whole) + product(value, column->error);
      }
    }
  }
}

bool PhaseKernels::close(const PhaseLoop& loop) {
  std::vector<double> all(defect_.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const double entry : powers_[i]) {
      all[i] = up(all[i] + entry);  // at least 1: the powers begin with the identity
    }
  }
  // Which shows that the spectral radius of the defect is below 1, whatever the columns are.
  if (!closed(defect_, all)) {
    return false;
  }
  for (std::size_t input = 0; input < inputs_; ++input) {
    const std::optional<std::vector<double>> bound = closed(defect_, totals_[input]);
    if (!bound) {
      return false;
    }
    for (std::size_t form = 0; form < forms_; ++form) {
      const std::vector<double> row = sum_of(grid_sizes(loop.forms[form]).value, loop.forms[form].error);
      rest_[form][input] = up(rest_[form][input] * kManyRoundings + product(through(row, defect_), *bound));
    }
  }
  return true;
}

void PhaseKernels::collect() {
  for (std::vector<double>& sums : sums_) {
    groups_.emplace_back();
    for (std::size_t index = 0; index < sums.size(); ++index) {
      if (sums[index] != 0.0) {
        groups_.back().push_back({index / phases_, index % phases_, up(sums[index] * kManyRoundings)});
      }
    }
    sums = {};
  }
}

std::vector<double> PhaseKernels::contribution(std::size_t form, std::size_t input,
                                               const std::vector<double>& sizes) const {
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0.0; };
  if (!is_certain_ || sizes.size() != phases_ || !std::all_of(sizes.begin(), sizes.end(), is_size)) {
    return std::vector<double>(phases_, HUGE_VAL);
  }
  Table most = {sizes};  // the largest of 2^level cells from each one on
  for (std::size_t level = 0; level < levels_; ++level) {
    std::vector<double> wider(phases_);
    for (std::size_t g = 0; g < phases_; ++g) {
      wider[g] = std::max(most[level][g], most[level][(g + (std::size_t{1} << level)) % phases_]);
    }
    most.push_back(std::move(wider));
  }
  const double rest = upward_product(rest_[form][input], *std::max_element(sizes.begin(), sizes.end()));
  std::vector<double> result(phases_);
  for (std::size_t cell = 0; cell < phases_; ++cell) {
    double largest = 0.0;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      double sum = 0.0;
      for (const Group& group : groups_[place_of(form, input, cell, corner)]) {
        sum += upward_product(group.sum, most[group.level][group.first]);
      }
      largest = std::isfinite(sum) ? std::max(largest, sum) : HUGE_VAL;
    }
    const double bound = up(up(largest) * kManyRoundings + rest);
    result[cell] = std::isfinite(bound) ? bound : HUGE_VAL;
  }
  return result;
}

}  // namespace veritrack::checker

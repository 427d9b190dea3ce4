#include "checker/model/gain/phase_group.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

/// matrix times vector, of numbers that are not negative.
std::vector<double> product_above(const Table& matrix, const std::vector<double>& vector) {
  std::vector<double> result(matrix.size(), 0.0);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < vector.size(); ++j) {
      result[i] += upward_product(matrix[i][j], vector[j]);
    }
    result[i] = up(result[i]);
  }
  return result;
}

Table product_above(const Table& x, const Table& y) {
  Table result(x.size(), std::vector<double>(x.size(), 0.0));
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      for (std::size_t k = 0; k < x.size(); ++k) {
        result[i][j] += upward_product(x[i][k], y[k][j]);
      }
      result[i][j] = up(result[i][j]);
    }
  }
  return result;
}

void add_to(std::vector<double>& sum, const std::vector<double>& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = up(sum[i] + more[i]);
  }
}

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

/// The largest difference at grid points, by component.
std::vector<double> difference_of(const GridFunction& x, const GridFunction& y) {
  std::vector<double> result(x.error.size(), 0.0);
  for (std::size_t g = 0; g < x.values.size(); ++g) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = std::max(result[i], up(std::abs(x.values[g][i] - y.values[g][i])));
    }
  }
  return result;
}

double parts_of_turn(const Ball& frequency, std::size_t phases, bool above) {
  const Ball parts = frequency * Ball(static_cast<double>(phases)) / (two * pi());
  return above ? parts.upper_double() : parts.lower_double();
}

void raise_all(std::vector<double>& most, const std::vector<double>& values) {
  for (std::size_t i = 0; i < most.size(); ++i) {
    most[i] = std::max(most[i], values[i]);
  }
}

}  // namespace

std::optional<std::vector<double>> closed_together(const std::vector<const Table*>& defects,
                                                   const std::vector<std::vector<double>>& given) {
  constexpr int kRounds = 200;
  if (defects.empty() || defects.size() != given.size()) {
    return std::nullopt;
  }
  std::vector<double> bound(given.front().size(), 0.0);
  for (const std::vector<double>& each : given) {
    raise_all(bound, each);
  }
  for (int round = 0; round < kRounds; ++round) {
    bool is_closed = true;
    std::vector<double> raised = bound;
    for (std::size_t part = 0; part < given.size(); ++part) {
      std::vector<double> next = product_above(*defects[part], bound);
      add_to(next, given[part]);
      for (std::size_t i = 0; i < bound.size(); ++i) {
        if (!std::isfinite(next[i])) {
          return std::nullopt;
        }
        is_closed = is_closed && next[i] <= bound[i];
        raised[i] = std::max(raised[i], next[i] * kGrowth);
      }
    }
    if (is_closed) {
      return bound;
    }
    bound = std::move(raised);
  }
  return std::nullopt;
}

/// A part with what the move of the frequency after its step multiplies everything by.
struct PhaseGroup::Widened {
  Table of_matrix;  ///< by how much more the matrix may differ
  std::vector<std::array<std::vector<double>, 2>> column_errors;
  std::vector<double> residual;
};

std::optional<PhaseGroup::Widened> PhaseGroup::widened(const PhasePart& part) const {
  Widened result{Table(part.matrix.size(), std::vector<double>(part.matrix.size(), 0.0)), {}, part.residual};
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
  Table size = part.matrix;
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
        const double middle = parts_[part]->matrix[i][j];
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

PhaseGroup::PhaseGroup(std::vector<const PhasePart*> parts, std::size_t phases, std::size_t horizon,
                       double slew)
    : parts_(std::move(parts)), phases_(phases), slew_(slew) {
  if (parts_.empty() || !(slew >= 0.0) || (slew == 0.0 && parts_.size() != 1)) {
    return;
  }
  std::vector<Widened> all;
  for (const PhasePart* part : parts_) {
    std::optional<Widened> wide_part = widened(*part);
    if (!wide_part) {
      return;
    }
    all.push_back(*std::move(wide_part));
  }
  for (std::size_t number = 0; number < parts_.size(); ++number) {
    const PhasePart& part = *parts_[number];
    PhaseLoop loop;
    loop.phases = phases;
    loop.horizon = horizon;
    loop.low = parts_of_turn(part.lowest, phases, false);
    loop.high = parts_of_turn(part.highest, phases, true);
    loop.slew = slew == 0.0 ? 0.0 : parts_of_turn(Ball(slew), phases, true);
    loop.matrix = part.matrix;
    loop.forms = part.forms;
    loop.inputs = part.inputs;
    loop.stages = stages(all, number);
    loop.has_one_size.assign(part.inputs.size(), false);
    loop.has_one_size[PhasePart::kNoise] = loop.has_one_size[PhasePart::kSlew] = true;
    kernels_.emplace_back(loop);
    if (!kernels_.back().is_valid()) {
      return;
    }
  }
  is_certain_ = close(all);
}

std::vector<const Table*> PhaseGroup::defects() const {
  std::vector<const Table*> all;
  for (const PhaseKernels& kernels : kernels_) {
    all.push_back(&kernels.defect());
  }
  return all;
}

bool PhaseGroup::close(const std::vector<Widened>& all) {
  const std::size_t n = parts_.front()->matrix.size();
  std::vector<double> residual(n, 0.0);
  for (const Widened& part : all) {
    raise_all(residual, part.residual);
  }
  Table units;
  Table residuals;
  for (const PhaseKernels& kernels : kernels_) {
    units.push_back(kernels.total_of(std::vector<double>(n, 1.0)));  // at least 1: powers begin with I
    residuals.push_back(kernels.total_of(residual));
  }
  // Which shows that the spectral radius of the defects is below 1, whatever the columns are.
  const std::optional<std::vector<double>> all_die_out = closed_together(defects(), units);
  const std::optional<std::vector<double>> of_residual = closed_together(defects(), residuals);
  if (!all_die_out || !of_residual) {
    return false;
  }
  const std::size_t inputs = parts_.front()->inputs.size();
  const std::size_t forms = parts_.front()->forms.size();
  rests_.assign(kernels_.size(), Table(forms, std::vector<double>(inputs)));
  residuals_.assign(kernels_.size(), std::vector<double>(forms));
  for (std::size_t part = 0; part < kernels_.size(); ++part) {
    for (std::size_t form = 0; form < forms; ++form) {
      residuals_[part][form] = kernels_[part].of_form(form, *of_residual);
    }
  }
  for (std::size_t input = 0; input < inputs; ++input) {
    Table totals;
    for (const PhaseKernels& kernels : kernels_) {
      totals.push_back(kernels.total(input));
    }
    const std::optional<std::vector<double>> bound = closed_together(defects(), totals);
    if (!bound) {
      return false;
    }
    for (std::size_t part = 0; part < kernels_.size(); ++part) {
      for (std::size_t form = 0; form < forms; ++form) {
        rests_[part][form][input] = kernels_[part].rest(form, input, *bound);
      }
    }
  }
  return true;
}

std::vector<double> PhaseGroup::components(std::size_t part, const std::vector<double>& start) const {
  return product_above(parts_[part]->inverse, start);
}

std::optional<Table> PhaseGroup::late_starts(const std::vector<double>& start) const {
  Table most;
  std::vector<double> all(start.size(), 0.0);
  for (std::size_t part = 0; part < kernels_.size(); ++part) {
    raise_all(all, components(part, start));
  }
  for (const PhaseKernels& kernels : kernels_) {
    most.push_back(kernels.largest_from(0, all));
  }
  const std::optional<std::vector<double>> bound = closed_together(defects(), most);
  if (!bound) {
    return std::nullopt;
  }
  Table late;
  for (const PhaseKernels& kernels : kernels_) {
    late.push_back(product_above(kernels.defect(), *bound));
  }
  return late;
}

}  // namespace veritrack::checker

// The sums over the lags.
#include "checker/model/gain/phase_kernels.hpp"

#include <cmath>
#include <utility>

#include "checker/model/gain/phase_lags.hpp"

namespace veritrack::checker {

/// The data that do not change from lag to lag, and room for those that do.
class PhaseKernels::Lags {
 public:
  Lags(PhaseKernels& kernels, const PhaseLoop& loop)
      : kernels_(&kernels), loop_(&loop), z_(loop.phases), other_(loop.phases), most_(loop.phases) {
    for (const GridFunction& form : loop.forms) {
      form_sizes_.push_back(grid_sizes(form));
      columns_.emplace_back();
      for (const std::size_t end : {0U, 1U}) {
        Table& of_end = columns_.back().at(end);
        for (std::size_t i = 0; i < form.error.size(); ++i) {
          of_end.emplace_back();
          for (const std::vector<double>& value : form.values.at(end)) {
            of_end.back().push_back(value[i]);
          }
        }
      }
      const Table nothing(form.error.size(), std::vector<double>(loop.phases));
      rows_.push_back({nothing, nothing});
    }
    for (const PhaseInput& input : loop.inputs) {
      input_sizes_.push_back({grid_sizes(input.first), grid_sizes(input.second)});
      ends_.push_back({std::array{ShiftedColumn(input.first, 0), ShiftedColumn(input.second, 0)},
                       std::array{ShiftedColumn(input.first, 1), ShiftedColumn(input.second, 1)}});
    }
    for (std::size_t k = 0; k < kernels.forms_ * kernels.inputs_; ++k) {
      const bool has_one_size = loop.has_one_size[k % kernels.inputs_];
      sums_.emplace_back((has_one_size ? 1 : kernels.sources_.size()) * loop.phases, 0.0);
    }
  }

  /// The sums at the grid points, at the larger one of both frequencies.
  void add_ends(const NearPowers& powers, const LagPlace& place, std::size_t source) {
    for (std::size_t form = 0; form < rows_.size(); ++form) {
      for (const std::size_t end : {0U, 1U}) {
        multiply(columns_[form].at(end), powers.power(end), rows_[form].at(end));
      }
    }
    for (std::size_t input = 0; input < ends_.size(); ++input) {
      for (const std::size_t part : {0U, 1U}) {
        ends_[input][0][part].shift(place.steps, place.low);
        ends_[input][1][part].shift(place.steps, place.high);
      }
      const std::size_t at = loop_->has_one_size[input] ? 0 : source * loop_->phases;
      for (std::size_t form = 0; form < rows_.size(); ++form) {
        size_of(rows_[form][0], ends_[input][0], z_);
        size_of(rows_[form][1], ends_[input][1], most_);
        double* const sum = sums_[kernels_->place_of(form, input)].data() + at;
        for (std::size_t g = 0; g < z_.size(); ++g) {
          // A size that is infinite or no number at either end stays so.
          sum[g] += (z_[g] > most_[g] ? z_[g] : most_[g]) + 0.0 * (z_[g] + most_[g]);
        }
      }
    }
  }

  void add_rest(const NearPowers& powers, const LagPlace& place, const PhaseStage& stage) {
    for (std::size_t form = 0; form < form_sizes_.size(); ++form) {
      const GridSizes& of_form = form_sizes_[form];
      const std::vector<double> value = powers.through(of_form.value);
      const std::vector<double> first = powers.through(of_form.first_difference);
      const std::vector<double> lean = powers.through(of_form.lean);
      const std::vector<double> by_power = powers.through_lean(of_form.value);
      const std::vector<double> by_both = powers.through_lean(of_form.lean);
      const std::vector<double> error = powers.through(loop_->forms[form].error);
      for (std::size_t input = 0; input < input_sizes_.size(); ++input) {
        for (const std::size_t part : {0U, 1U}) {
          const GridSizes& column = input_sizes_[input][part];
          const std::vector<double>& column_error = stage.column_errors[input][part];
          double sum = 0.0;
          for (std::size_t i = 0; i < column_error.size(); ++i) {
            // This includes computing the values at the ends, and their places.
            const double twice = 2.0 * column.value[i];
            const double bend =
                0.25 * column.second_difference[i] +
                std::min(place.bend * column.second_difference[i], twice) +
                std::min(0.5 * place.spread * column.lean_difference[i], 2.0 * column.lean[i]) +
                0x1p-44 * column.value[i] + 2.0 * kPlaceError * column.first_difference[i];
            const double moved =
                std::min(0.5 * place.spread * column.first_difference[i] + column.lean[i], twice);
            sum += value[i] * (bend + column_error[i]) + 0.25 * first[i] * column.first_difference[i] +
                   error[i] * (column.value[i] + column_error[i]) + (lean[i] + by_power[i]) * moved +
                   by_both[i] * column.value[i];
          }
          kernels_->rest_[form][input] += sum;
        }
      }
    }
    for (std::size_t input = 0; input < input_sizes_.size(); ++input) {
      for (const std::size_t part : {0U, 1U}) {
        std::vector<double> whole = stage.column_errors[input][part];
        for (std::size_t i = 0; i < whole.size(); ++i) {
          whole[i] += input_sizes_[input][part].value[i];
        }
        const std::vector<double> size = powers.times(whole);
        for (std::size_t i = 0; i < size.size(); ++i) {
          kernels_->totals_[input][i] += size[i];
        }
      }
    }
  }

  [[nodiscard]] Table& sums() { return sums_; }
  [[nodiscard]] const GridSizes& form_sizes(std::size_t form) const { return form_sizes_[form]; }

 private:
  /// c G at all grid points, by component.
  static void multiply(const Table& columns, const Table& power, Table& rows) {
    for (std::size_t j = 0; j < rows.size(); ++j) {
      double* const row = rows[j].data();
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double* const column = columns[i].data();
        const double factor = power[i][j];
        for (std::size_t g = 0; g < rows[j].size(); ++g) {
          row[g] = (i == 0 ? 0.0 : row[g]) + factor * column[g];
        }
      }
    }
  }

  static void dot(const Table& rows, const ShiftedColumn& column, std::vector<double>& result) {
    double* const sum = result.data();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double* const row = rows[i].data();
      const double* const value = column.component(i).data();
      for (std::size_t g = 0; g < result.size(); ++g) {
        sum[g] = (i == 0 ? 0.0 : sum[g]) + row[g] * value[g];
      }
    }
  }

  void size_of(const Table& rows, const std::array<ShiftedColumn, 2>& column, std::vector<double>& size) {
    dot(rows, column[0], size);
    if (column[1].is_empty()) {
      for (double& each : size) {
        each = std::abs(each);
      }
      return;
    }
    dot(rows, column[1], other_);
    for (std::size_t g = 0; g < size.size(); ++g) {
      size[g] = std::sqrt(size[g] * size[g] + other_[g] * other_[g]);
    }
  }

  PhaseKernels* kernels_;
  const PhaseLoop* loop_;
  std::vector<GridSizes> form_sizes_;
  std::vector<std::array<GridSizes, 2>> input_sizes_;
  std::vector<std::array<Table, 2>> columns_, rows_;  ///< by form, end, component and grid point: c and c G
  std::vector<std::array<std::array<ShiftedColumn, 2>, 2>> ends_;  ///< by input, frequency and component
  std::vector<double> z_, other_, most_;
  Table sums_;
};

void PhaseKernels::sum_up(const PhaseLoop& loop) {
  Lags lags(*this, loop);
  NearPowers powers(loop.matrix);
  std::size_t stage = 0;
  for (std::size_t lag = 0; lag < horizon_; ++lag) {
    spend(static_cast<std::int64_t>(forms_ * inputs_ * phases_ / 4));
    while (stage + 1 < loop.stages.size() && loop.stages[stage + 1].first_lag <= lag) {
      ++stage;
    }
    const LagPlace place(loop, lag);
    lags.add_ends(powers, place, source_of_lag_[lag]);
    lags.add_rest(powers, place, loop.stages[stage]);
    powers.add_defect(loop.stages[stage].matrix_error, loop.horizon.late_blocks == 0 && lag + 1 == horizon_,
                      defect_);
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = 0; j < states_; ++j) {
        power_sum_[i][j] += powers.size()[i][j];
      }
    }
    powers.advance();
  }
  if (loop.horizon.late_blocks > 0) {
    add_late_lags(loop, powers, lags.sums());
  }
  for (const std::vector<double>& sums : lags.sums()) {
    sums_.emplace_back();
    sums_.back().reserve(sums.size());
    for (const double sum : sums) {
      sums_.back().push_back(float_above(sum * kManyRoundings));
    }
  }
  const auto settle = [](Table& table) {
    for (std::vector<double>& row : table) {
      for (double& entry : row) {
        entry = entry * kManyRoundings + kManyUnderflows;
      }
    }
  };
  settle(power_sum_);
  settle(rest_);
  settle(defect_);
  settle(totals_);
  for (std::size_t form = 0; form < forms_; ++form) {
    form_sizes_.push_back(lags.form_sizes(form).value);
    for (std::size_t i = 0; i < states_; ++i) {
      form_sizes_.back()[i] = up(form_sizes_.back()[i] + loop.forms[form].error[i]);
    }
  }
}

}  // namespace veritrack::checker

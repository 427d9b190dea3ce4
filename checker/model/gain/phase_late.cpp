// Late lags, by whole turns of the phase (docs/gain-proof.md, section 11).
#include "checker/model/gain/phase_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "checker/model/gain/phase_lags.hpp"

namespace veritrack::checker {

namespace {

/// To the larger one; what is no number stays so.
void raise(double& most, double value) {
  most = value <= most || std::isnan(most) ? most : value;
}

/// How many cells of phases on either side a sample may have come from that stands for half of a step.
std::size_t reach_of(double step) {
  return static_cast<std::size_t>(std::ceil(0.5 * up(step)));
}

/// The powers of a block of lags.
struct LateBlock {
  Table sum, most, lean;  ///< of sizes; the largest of them; of half of what ends differ by
  Table bend;             ///< how far powers are from the line between those at both ends of the block
};

/// A column of an input, at one end of the frequencies.
class LateColumn {
 public:
  LateColumn(const PhaseInput& input, std::size_t end, std::size_t phases)
      : first_(&input.first.values.at(end)),
        second_(input.second.is_empty() ? nullptr : &input.second.values.at(end)),
        size_(phases),
        slope_(phases),
        z_(phases) {}

  /// By cell, what |row B| is at most on the average where samples stand for the phases of half a step on
  /// either side.
  void add_means(const std::vector<double>& row, double step, std::vector<double>& most) {
    const std::size_t phases = size_.size();
    std::fill(size_.begin(), size_.end(), 0.0);
    std::fill(slope_.begin(), slope_.end(), 0.0);
    add_component(row, *first_);
    if (second_ != nullptr) {
      add_component(row, *second_);
    }
    for (std::size_t g = 0; g < phases; ++g) {
      size_[g] = std::sqrt(size_[g]);
      slope_[g] = std::sqrt(slope_[g]);
    }
    const std::size_t reach = reach_of(step);
    for (std::size_t g = 0; g < phases; ++g) {
      double steepest = 0.0;
      for (std::size_t i = phases + g - reach; i <= phases + g + reach; ++i) {
        steepest = std::max(steepest, slope_[i % phases]);
      }
      const double mean = 0.5 * (size_[g] + size_[(g + 1) % phases]) + step * steepest;
      raise(most[g], mean);
    }
  }

 private:
  void add_component(const std::vector<double>& row, const Table& values) {
    const std::size_t phases = size_.size();
    for (std::size_t g = 0; g < phases; ++g) {
      z_[g] = 0.0;
      for (std::size_t i = 0; i < row.size(); ++i) {
        z_[g] += row[i] * values[g][i];
      }
    }
    for (std::size_t g = 0; g < phases; ++g) {
      const double change = z_[(g + 1) % phases] - z_[g];
      size_[g] += z_[g] * z_[g];
      slope_[g] += change * change;
    }
  }

  const Table* first_;
  const Table* second_;
  std::vector<double> size_, slope_, z_;
};

}  // namespace

/// Adds late lags to kernels.
class PhaseKernels::LateLags {
 public:
  /// `first`: the power at the first late lag.
  LateLags(PhaseKernels& kernels, const PhaseLoop& loop, const NearPowers& first)
      : kernels_(&kernels),
        loop_(&loop),
        states_(kernels.states_),
        lags_(kernels.late_lags_),
        powers_(first) {
    const auto phases = static_cast<double>(loop.phases);
    const auto lags = static_cast<double>(lags_);
    const double turns = up(lags * loop.high / phases);
    const double whole = std::floor(turns);
    const double hats = up(1.0 + 2.0 * whole - whole * (whole + 1.0) / turns) +
                        std::ceil(up(2.0 * turns)) / (2.0 * lags) + 0x1p-40;
    weight_ = up(hats / loop.low) * (1.0 + 0x1p-40);
    of_turn_ = up(weight_ * phases);
    for (const GridFunction& form : loop.forms) {
      form_sizes_.push_back(grid_sizes(form));
    }
    for (const PhaseInput& input : loop.inputs) {
      input_sizes_.push_back({grid_sizes(input.first), grid_sizes(input.second)});
    }
    NearPowers powers = first;
    knots_ = {{powers.power(0), powers.power(1)}};
    for (std::size_t block = 0; block < loop.horizon.late_blocks; ++block) {
      for (std::size_t j = 0; j < lags_; ++j) {
        powers.advance();
      }
      knots_.push_back({powers.power(0), powers.power(1)});
    }
  }

  void add_blocks() {
    const std::size_t blocks = loop_->horizon.late_blocks;
    const Table& matrix_error = loop_->stages.front().matrix_error;
    const Table nothing(states_, std::vector<double>(states_, 0.0));
    for (std::size_t block = 0; block < blocks; ++block) {
      spend(static_cast<std::int64_t>(lags_ * states_ * states_));
      LateBlock of = next_block(block);
      Table of_defect = nothing;
      powers_.add_defect(of.most, of.lean, matrix_error, false, of_defect);
      Table at_end = nothing;
      if (block + 1 == blocks) {
        powers_.add_defect(of.most, of.lean, matrix_error, true, at_end);
      }
      for (std::size_t i = 0; i < states_; ++i) {
        for (std::size_t k = 0; k < states_; ++k) {
          kernels_->power_sum_[i][k] += of.sum[i][k];
          kernels_->defect_[i][k] += static_cast<double>(lags_) * of_defect[i][k] + at_end[i][k];
        }
      }
      add_knot(of.most, of.lean);
      add_errors(of);
      for (std::vector<double>& row : of.most) {
        for (double& entry : row) {
          entry = up(entry);
        }
      }
      kernels_->largest_late_.push_back(std::move(of.most));
    }
    add_knot(powers_.size(), powers_.lean());
  }

  /// The sum of an input of this kind over the knots, by cell of phases, for the point g of the grid.
  void add_sums(std::size_t form, std::size_t input, std::vector<double>& single,
                std::vector<float>& by_cell) const {
    const std::size_t phases = loop_->phases;
    std::array<LateColumn, 2> columns{LateColumn(loop_->inputs[input], 0, phases),
                                      LateColumn(loop_->inputs[input], 1, phases)};
    std::vector<double> row(states_);
    for (std::size_t g = 0; g < phases; ++g) {
      spend(static_cast<std::int64_t>(phases * knots_.size() / 4));
      std::vector<double> sum(phases, 0.0);
      for (const std::array<Table, 2>& knot : knots_) {
        std::vector<double> most(phases, 0.0);
        for (const std::size_t end : {0U, 1U}) {
          const std::vector<double>& value = loop_->forms[form].values.at(end)[g];
          for (std::size_t j = 0; j < states_; ++j) {
            row[j] = 0.0;
            for (std::size_t i = 0; i < states_; ++i) {
              row[j] += value[i] * knot.at(end)[i][j];
            }
          }
          columns.at(end).add_means(row, loop_->high, most);
        }
        for (std::size_t j = 0; j < phases; ++j) {
          sum[j] += weight_ * most[j];
        }
      }
      for (const double each : sum) {
        if (loop_->has_one_size[input]) {
          single[g] += each;
        } else {
          by_cell.push_back(float_above(each * kManyRoundings));
        }
      }
    }
  }

 private:
  LateBlock next_block(std::size_t block) {
    const Table nothing(states_, std::vector<double>(states_, 0.0));
    LateBlock of{nothing, nothing, nothing, nothing};
    for (std::size_t j = 0; j < lags_; ++j) {
      const double share = static_cast<double>(j) / static_cast<double>(lags_);
      for (std::size_t i = 0; i < states_; ++i) {
        for (std::size_t k = 0; k < states_; ++k) {
          const double size = powers_.size()[i][k];
          of.sum[i][k] += size;
          raise(of.most[i][k], size);
          raise(of.lean[i][k], powers_.lean()[i][k]);
          for (const std::size_t end : {0U, 1U}) {
            const double from = knots_[block].at(end)[i][k];
            const double to = knots_[block + 1].at(end)[i][k];
            const double off = std::abs(powers_.power(end)[i][k] - ((1.0 - share) * from + share * to)) +
                               0x1p-49 * (size + std::abs(from) + std::abs(to));
            raise(of.bend[i][k], off);
          }
        }
      }
      powers_.advance();
    }
    for (std::vector<double>& sums : of.sum) {
      for (double& sum : sums) {
        sum *= kManyRoundings;
      }
    }
    return of;
  }

  /// Entries (form, input, component, i, j) of c' G B, added up over the states.
  template <typename Entry>
  void add_to_rest(const Entry& entry) {
    for (std::size_t form = 0; form < form_sizes_.size(); ++form) {
      for (std::size_t input = 0; input < input_sizes_.size(); ++input) {
        for (const std::size_t part : {0U, 1U}) {
          const std::size_t components = part == 0 || !loop_->inputs[input].second.is_empty() ? states_ : 0;
          for (std::size_t j = 0; j < components; ++j) {
            for (std::size_t i = 0; i < states_; ++i) {
              kernels_->rest_[form][input] += entry(form, input, part, i, j);
            }
          }
        }
      }
    }
  }

  /// The excess of a product of three functions that are linear in the frequency over its values at both
  /// ends, and rounding.
  void add_knot(const Table& size, const Table& lean) {
    add_to_rest([&](std::size_t form, std::size_t input, std::size_t part, std::size_t i, std::size_t j) {
      const GridSizes& of_form = form_sizes_[form];
      const GridSizes& column = input_sizes_[input][part];
      return of_turn_ *
             (of_form.value[i] * (lean[i][j] * column.lean[j] + 0x1p-40 * size[i][j] * column.value[j]) +
              of_form.lean[i] *
                  (lean[i][j] * (column.value[j] + column.lean[j]) + size[i][j] * column.lean[j]));
    });
  }

  /// The bends of powers, and errors of columns and forms.
  void add_errors(const LateBlock& of) {
    const auto& column_errors = loop_->stages.front().column_errors;
    const auto lags = static_cast<double>(lags_);
    add_to_rest([&](std::size_t form, std::size_t input, std::size_t part, std::size_t i, std::size_t j) {
      const double value = form_sizes_[form].value[i];
      const double column = input_sizes_[input][part].value[j];
      const double error = column_errors[input][part][j];
      return value * (lags * of.bend[i][j] * column + of.sum[i][j] * error) +
             loop_->forms[form].error[i] * of.sum[i][j] * (column + error);
    });
    for (std::size_t input = 0; input < input_sizes_.size(); ++input) {
      for (const std::size_t part : {0U, 1U}) {
        const std::vector<double>& errors = column_errors[input][part];
        for (std::size_t j = 0; j < errors.size(); ++j) {
          for (std::size_t i = 0; i < states_; ++i) {
            kernels_->totals_[input][i] += of.sum[i][j] * (input_sizes_[input][part].value[j] + errors[j]);
          }
        }
      }
    }
  }

  PhaseKernels* kernels_;
  const PhaseLoop* loop_;
  std::size_t states_, lags_;
  NearPowers powers_;                        ///< the next one
  std::vector<std::array<Table, 2>> knots_;  ///< the powers at both ends of each block
  double weight_ = 0.0, of_turn_ = 0.0;      ///< of a hat over a knot, by cell, and in a turn
  std::vector<GridSizes> form_sizes_;
  std::vector<std::array<GridSizes, 2>> input_sizes_;
};

void PhaseKernels::add_late_lags(const PhaseLoop& loop, const NearPowers& first, Table& sums) {
  LateLags late(*this, loop, first);
  late.add_blocks();
  late_.assign(forms_ * inputs_, {});
  for (std::size_t form = 0; form < forms_; ++form) {
    for (std::size_t input = 0; input < inputs_; ++input) {
      late.add_sums(form, input, sums[place_of(form, input)], late_[place_of(form, input)]);
    }
  }
}

void PhaseKernels::add_late(std::size_t form, std::size_t input, const PhaseSizes& sizes,
                            EndSums& sums) const {
  const std::vector<float>& of = late_[place_of(form, input)];
  const std::vector<double>& size = sizes.most.front();
  const std::size_t reach = reach_of(step_);
  const double share = std::min(up(step_), 1.0);
  std::vector<double> weights(phases_);
  for (std::size_t g = 0; g < phases_; ++g) {
    double most = 0.0;
    for (std::size_t i = phases_ + g - reach; i <= phases_ + g + reach; ++i) {
      most = std::max(most, size[i % phases_]);
    }
    weights[g] = up(size[g] + share * up(most - size[g]));
  }
  for (std::size_t g = 0; g < phases_; ++g) {
    double sum = 0.0;
    for (std::size_t j = 0; j < phases_; ++j) {
      sum += weights[j] * static_cast<double>(of[g * phases_ + j]);
    }
    sums.left[g] += sum;
    sums.right[(g + phases_ - 1) % phases_] += sum;
  }
}

}  // namespace veritrack::checker

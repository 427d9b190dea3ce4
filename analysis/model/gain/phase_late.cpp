// Kernels of late inputs: by whole turns of the phase (docs/gain-proof.md, section 11).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/model/gain/phase_kernels.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::Interval;
using rigor::larger_or_nan;

namespace {

using Vector = std::vector<double>;

/// The largest sum of a hat of half width N over points a turn apart, where N is `turns` of them.
double sum_of_hats(double turns) {
  const double whole = std::floor(turns);
  return 1.0 + 2.0 * whole - whole * (whole + 1.0) / turns;
}

/// Lengths of the products of a row with the components of a column at the points of the grid, and of what
/// they differ by from point to point.
class RowLengths {
 public:
  explicit RowLengths(std::size_t phases) : size_(phases), slope_(phases), z_(phases + 1) {}

  /// By cell: what they are at most on the average, where samples stand for the phases of half a step, `step`
  /// cells, on either side. Raises `most` to it.
  void raise(const Vector& row, const std::vector<const GridFunction*>& components, std::size_t end,
             double step, std::size_t reach, Vector& most) {
    const std::size_t phases = size_.size();
    std::fill(size_.begin(), size_.end(), 0.0);
    std::fill(slope_.begin(), slope_.end(), 0.0);
    for (const GridFunction* each : components) {
      add(row, each->values[end]);
    }
    if (components.size() > 1) {
      for (std::size_t g = 0; g < phases; ++g) {
        size_[g] = std::sqrt(size_[g]);
        slope_[g] = std::sqrt(slope_[g]);
      }
    } else {
      for (std::size_t g = 0; g < phases; ++g) {
        size_[g] = std::fabs(z_[g]);
        slope_[g] = std::fabs(z_[g + 1] - z_[g]);
      }
    }
    for (std::size_t g = 0; g < phases; ++g) {
      double steepest = 0.0;
      for (std::size_t i = phases + g - reach; i <= phases + g + reach; ++i) {
        steepest = std::max(steepest, slope_[i >= phases ? i % phases : i]);
      }
      const double mean = 0.5 * (size_[g] + size_[g + 1 == phases ? 0 : g + 1]) + step * steepest;
      most[g] = larger_or_nan(most[g], mean);
    }
  }

 private:
  void add(const Vector& row, const std::vector<Vector>& values) {
    const std::size_t phases = size_.size();
    std::fill(z_.begin(), z_.end(), 0.0);
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t g = 0; g < phases; ++g) {
        z_[g] += row[i] * values[i][g];
      }
    }
    z_[phases] = z_[0];
    for (std::size_t g = 0; g < phases; ++g) {
      const double change = z_[g + 1] - z_[g];
      size_[g] += z_[g] * z_[g];
      slope_[g] += change * change;
    }
  }

  Vector size_, slope_, z_;
};

}  // namespace

/// How many cells of phases a sample is wide, and how long a turn is: what hats over a knot add up to, per
/// cell.
struct PhaseKernels::LateTurn {
  double step = 0.0, weight = 0.0;
  std::size_t reach = 0;
};

PhaseKernels::LateTurn PhaseKernels::late_turn() const {
  const double turn = 2.0 * std::numbers::pi * (1.0 - 1e-12);
  const double points = static_cast<double>(phases_) / turn;
  const double every = static_cast<double>(late_every_);
  const double high = part_->frequency + part_->half_width;
  const double low = -(part_->half_width - part_->frequency);
  const double turns = every * high / turn;
  const double hats = sum_of_hats(turns) + std::ceil(2.0 * turns) / (2.0 * every);
  return {high * points, hats / (low * points) * (1.0 + 1e-9),
          static_cast<std::size_t>(std::ceil(0.5 * high * points))};
}

/// The powers of a block of lags.
struct PhaseKernels::LateBlock {
  Vector sum, most, lean;  ///< of sizes; the largest of them; of half of what both ends differ by
  Vector bend;             ///< how far powers are from the line between those at both ends of the block
};

PhaseKernels::LateBlock PhaseKernels::late_block(std::size_t block, std::array<Vector, 2>& power) {
  const std::size_t n = states_;
  const std::array<Vector, 2> matrices{end_matrix(0), end_matrix(1)};
  const Vector nothing(n * n, 0.0);
  LateBlock of{nothing, nothing, nothing, nothing};
  for (std::size_t j = 0; j < late_every_; ++j) {
    const std::size_t lag = horizon_ + block * late_every_ + j;
    const Interval share(static_cast<double>(j) / static_cast<double>(late_every_));
    Vector& largest = largest_power_[lag * kBlocks / all_lags_];
    for (std::size_t i = 0; i < n * n; ++i) {
      double size = 0.0;
      for (const std::size_t end : {0U, 1U}) {
        const Interval first(knots_[end][block][i]);
        const Interval line = first + share * (Interval(knots_[end][block + 1][i]) - first);
        of.bend[i] = larger_or_nan(of.bend[i], rigor::magnitude(Interval(power[end][i]) - line));
        size = larger_or_nan(size, std::fabs(power[end][i]));
      }
      of.sum[i] += size;
      of.most[i] = larger_or_nan(of.most[i], size);
      largest[i] = larger_or_nan(largest[i], size);
      of.lean[i] =
          larger_or_nan(of.lean[i], 0.5 * rigor::magnitude(Interval(power[1][i]) - Interval(power[0][i])));
    }
    for (const std::size_t end : {0U, 1U}) {
      power[end] = product_of(power[end], matrices[end]);
    }
  }
  return of;
}

void PhaseKernels::add_late_block(const LateBlock& of, bool is_last) {
  constexpr double kOfProducts = 0x1p-47;
  const std::size_t n = states_;
  const auto every = static_cast<double>(late_every_);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double& defect = defect_[i * n + j];
      power_sum_[i * n + j] += of.sum[i * n + j];
      for (std::size_t m = 0; m < n; ++m) {
        const double size = std::fabs(part_->middle[m * n + j]) + std::fabs(part_->lean[m * n + j]);
        defect += every * (of.most[i * n + m] * (part_->off[m * n + j] + kOfProducts * size) +
                           of.lean[i * n + m] * std::fabs(part_->lean[m * n + j]));
        defect += is_last ? of.most[i * n + m] * (size + part_->off[m * n + j]) : 0.0;
      }
    }
  }
  for (Column& column : columns_) {
    for (const GridFunction* function : column.components) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          const std::size_t at = i * n + j;
          column.sizes[i] += of.sum[at] * (function->largest[j] + function->error[j]);
          column.bent[i] += every * of.bend[at] * function->largest[j];
          column.mistaken[i] += of.sum[at] * function->error[j];
        }
      }
    }
  }
}

void PhaseKernels::add_knot(const Vector& size, const Vector& lean) {
  const double of_turn = late_turn().weight * static_cast<double>(phases_);
  for (Column& column : columns_) {
    for (const GridFunction* of : column.components) {
      for (std::size_t i = 0; i < states_; ++i) {
        for (std::size_t j = 0; j < states_; ++j) {
          const std::size_t at = i * states_ + j;
          column.bent[i] += of_turn * lean[at] * of->lean[j];
          column.leaned[i] += of_turn * (lean[at] * (of->largest[j] + of->lean[j]) + size[at] * of->lean[j]);
        }
      }
    }
  }
}

void PhaseKernels::find_late() {
  const std::size_t n = states_;
  std::array<Vector, 2> power;
  for (const std::size_t end : {0U, 1U}) {
    const Vector matrix = end_matrix(end);
    power[end].assign(powers_[end].end() - static_cast<std::ptrdiff_t>(n * n), powers_[end].end());
    knots_[end] = {power[end]};
    for (std::size_t k = 1; k <= late_blocks_ * late_every_; ++k) {
      power[end] = product_of(power[end], matrix);
      if (k % late_every_ == 0) {
        knots_[end].push_back(power[end]);
      }
    }
    power[end] = knots_[end].front();
  }
  for (std::size_t block = 0; block < late_blocks_; ++block) {
    const LateBlock of = late_block(block, power);
    add_late_block(of, block + 1 == late_blocks_);
    add_knot(of.most, of.lean);
  }
  Vector size(n * n), lean(n * n);
  for (std::size_t i = 0; i < n * n; ++i) {
    size[i] = larger_or_nan(std::fabs(power[0][i]), std::fabs(power[1][i]));
    lean[i] = 0.5 * rigor::magnitude(Interval(power[1][i]) - Interval(power[0][i]));
  }
  add_knot(size, lean);
}

std::vector<double> PhaseKernels::late_sizes(const std::vector<double>& sizes) const {
  const LateTurn turn = late_turn();
  const double share = std::min(turn.step, 1.0);
  std::vector<double> result(phases_);
  for (std::size_t g = 0; g < phases_; ++g) {
    double most = 0.0;
    for (std::size_t i = phases_ + g - turn.reach; i <= phases_ + g + turn.reach; ++i) {
      most = larger_or_nan(most, sizes[i % phases_]);
    }
    result[g] = sizes[g] + share * rigor::sub_up(most, sizes[g]);
  }
  return result;
}

void PhaseKernels::add_late_sums() {
  const std::size_t n = states_;
  const LateTurn turn = late_turn();
  late_.assign(forms(), std::vector<Vector>(columns_.size()));
  RowLengths lengths(phases_);
  Vector row(n);
  Vector most(phases_);
  for (std::size_t f = 0; f < forms(); ++f) {
    const GridFunction& form = part_->forms[f];
    for (std::size_t l = 0; l < columns_.size(); ++l) {
      if (l == kSlew) {
        continue;
      }
      Vector& all = late_[f][l];
      all.assign(phases_ * phases_, 0.0);
      for (std::size_t g = 0; g < phases_; ++g) {
        double* result = all.data() + g * phases_;
        for (std::size_t knot = 0; knot <= late_blocks_; ++knot) {
          std::fill(most.begin(), most.end(), 0.0);
          for (const std::size_t end : {0U, 1U}) {
            for (std::size_t j = 0; j < n; ++j) {
              row[j] = 0.0;
              for (std::size_t i = 0; i < n; ++i) {
                row[j] += form.values[end][i][g] * knots_[end][knot][i * n + j];
              }
            }
            lengths.raise(row, columns_[l].components, end, turn.step, turn.reach, most);
          }
          for (std::size_t p = 0; p < phases_; ++p) {
            result[p] += turn.weight * most[p];
          }
        }
        if (l == kNoise) {
          for (std::size_t p = 0; p < phases_; ++p) {
            sums_[f][l][g] += result[p];
          }
        }
      }
      if (l == kNoise) {
        all = {};
      }
    }
  }
}

}  // namespace veritrack::model

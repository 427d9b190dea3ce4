// The second stage of kernels: sums over lags and phases.
#include "analysis/model/gain/phase_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace veritrack::model {

namespace {

/// Rounding of a sum of products over the states, and of the place of a phase in the grid, relative to the
/// absolute values of the factors.
constexpr double kRounding = 1e-9;

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// a' G b
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

}  // namespace

double PhaseKernels::missed_of(const GridFunction& form, const Column& column, const Vector& total) const {
  Vector all = form.largest;
  for (std::size_t i = 0; i < states_; ++i) {
    all[i] += form.error[i];
  }
  double turned = 0.0;
  for (const GridFunction* each : column.components) {
    turned += 0.25 * product(form.first_difference, early_power_sum_, each->first_difference);
  }
  return inner(form.largest, column.bent) + inner(form.lean, column.leaned) + turned +
         inner(form.error, column.sizes) + inner(form.largest, column.mistaken) +
         product(all, defect_, total) + kRounding * inner(all, column.sizes);
}

/// The columns at one lag, at the phases from which they reach the points of the grid, and what forms see of
/// them.
class PhaseKernels::LagSums {
 public:
  explicit LagSums(const PhaseKernels& kernels)
      : kernels_(&kernels),
        rows_{std::vector<Vector>(kernels.states_, Vector(kernels.phases_)),
              std::vector<Vector>(kernels.states_, Vector(kernels.phases_))},
        value_(kernels.phases_),
        side_(kernels.phases_) {}

  void place(std::size_t lag) {
    const PhaseKernels& of = *kernels_;
    const double points = static_cast<double>(of.phases_) / (2.0 * std::numbers::pi);
    for (std::size_t side = 0; side < 2; ++side) {
      powers_[side] = of.powers_[side].data() + lag * of.states_ * of.states_;
      const double width = of.half_width_at(lag);
      const double frequency = of.part_->frequency + (side == 0 ? -width : width);
      shifts_[side] = shift_of(-static_cast<double>(lag + 1) * frequency * points, of.phases_);
    }
    for (std::size_t l = 0; l < of.columns_.size(); ++l) {
      for (std::size_t side = 0; side < 2; ++side) {
        interpolate(l, side);
      }
    }
  }

  void look_at(const GridFunction& form) {
    for (const std::size_t side : {0U, 1U}) {
      multiply(form, side);
    }
  }

  /// By point: the larger one of both sides. A value that is no number has made the sizes of its column NaN
  /// before.
  const Vector& values(std::size_t column) {
    find_side(column, 0, value_);
    find_side(column, 1, side_);
    for (std::size_t g = 0; g < value_.size(); ++g) {
      value_[g] = std::max(value_[g], side_[g]);
    }
    return value_;
  }

 private:
  void multiply(const GridFunction& form, std::size_t side) {
    const std::size_t n = kernels_->states_;
    for (std::size_t j = 0; j < n; ++j) {
      Vector& row = rows_[side][j];
      std::fill(row.begin(), row.end(), 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        const double factor = powers_[side][i * n + j];
        const double* values = form.values[side][i].data();
        for (std::size_t g = 0; g < row.size(); ++g) {
          row[g] += factor * values[g];
        }
      }
    }
  }

  /// A place between two points of the grid: `offset` points on and a share of one.
  struct Shift {
    std::size_t offset = 0;
    double share = 0.0;
  };

  [[nodiscard]] static Shift shift_of(double points, std::size_t phases) {
    const double count = static_cast<double>(phases);
    const double whole = std::floor(points);
    return {static_cast<std::size_t>(whole - std::floor(whole / count) * count) % phases, points - whole};
  }

  void interpolate(std::size_t column, std::size_t side) {
    const std::size_t phases = kernels_->phases_;
    const std::vector<const GridFunction*>& components = kernels_->columns_[column].components;
    std::vector<std::vector<Vector>>& here = columns_[side];
    here.resize(kernels_->columns_.size());
    here[column].resize(components.size() * kernels_->states_, Vector(phases));
    const Shift shift = shifts_[side];
    for (std::size_t c = 0; c < components.size(); ++c) {
      for (std::size_t j = 0; j < kernels_->states_; ++j) {
        const Vector& from = components[c]->values[side][j];
        Vector& to = here[column][c * kernels_->states_ + j];
        for (std::size_t g = 0; g < phases; ++g) {
          const std::size_t first = (g + shift.offset) % phases;
          const double value = from[first];
          to[g] = value + shift.share * (from[(first + 1) % phases] - value);
        }
      }
    }
  }

  void find_side(std::size_t column, std::size_t side, Vector& result) {
    const std::size_t n = kernels_->states_;
    const std::vector<Vector>& here = columns_[side][column];
    const std::size_t components = here.size() / n;
    std::fill(result.begin(), result.end(), 0.0);
    for (std::size_t c = 0; c < components; ++c) {
      for (std::size_t g = 0; g < result.size(); ++g) {
        double z = 0.0;
        for (std::size_t j = 0; j < n; ++j) {
          z += rows_[side][j][g] * here[c * n + j][g];
        }
        result[g] = components == 1 ? std::fabs(z) : result[g] + z * z;
      }
    }
    for (std::size_t g = 0; g < result.size() && components > 1; ++g) {
      result[g] = std::sqrt(result[g]);
    }
  }

  const PhaseKernels* kernels_;
  const double* powers_[2] = {};
  Shift shifts_[2];
  std::vector<std::vector<Vector>> columns_[2];  ///< by side, column, component and state
  std::vector<Vector> rows_[2];                  ///< of the form at both sides
  Vector value_, side_;
};

void PhaseKernels::add_sums() {
  LagSums lag(*this);
  const std::size_t windows = windows_.size();
  for (std::size_t k = 0; k < horizon_; ++k) {
    lag.place(k);
    for (std::size_t f = 0; f < forms(); ++f) {
      lag.look_at(part_->forms[f]);
      for (std::size_t l = 0; l < columns_.size(); ++l) {
        if (l == kSlew && slew_ == 0.0) {
          continue;
        }
        const Vector& values = lag.values(l);
        const std::size_t step = l < kFirstGate ? 1 : windows;
        double* sums = sums_[f][l].data() + (l < kFirstGate ? 0 : window_of_[k]);
        for (std::size_t g = 0; g < phases_; ++g) {
          sums[g * step] += values[g];
        }
      }
    }
  }
}

void PhaseKernels::find(const PhaseTotals& totals) {
  sums_.resize(forms());
  missed_.clear();
  residual_.clear();
  for (std::size_t f = 0; f < forms(); ++f) {
    const GridFunction& form = part_->forms[f];
    sums_[f].clear();
    missed_.emplace_back();
    for (std::size_t l = 0; l < columns_.size(); ++l) {
      sums_[f].emplace_back(phases_ * (l < kFirstGate ? 1 : windows_.size()), 0.0);
      missed_[f].push_back(missed_of(form, columns_[l], totals.of_column[l]));
    }
    residual_.push_back(inner(form.largest, totals.residual) + inner(form.error, totals.residual));
  }
  add_sums();
  if (late_blocks_ > 0) {
    add_late_sums();
  }
  powers_ = {};  // no longer needed
}

}  // namespace veritrack::model

// The first stage of kernels: sums over the lags alone.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "analysis/model/gain/phase_kernels.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::Interval;
using rigor::larger_or_nan;

namespace {

std::vector<double> matrix_times(const std::vector<double>& matrix, const std::vector<double>& vector) {
  const std::size_t n = vector.size();
  std::vector<double> result(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      result[i] += matrix[i * n + j] * vector[j];
    }
  }
  return result;
}

/// Enough for so many turns at all frequencies of the part.
std::size_t lags_of_turns(std::size_t turns, const PhasePart& part) {
  const double low = -(part.half_width - part.frequency);
  return static_cast<std::size_t>(std::ceil(static_cast<double>(turns) * 2.0 * std::numbers::pi / low));
}

}  // namespace

PhaseKernels::PhaseKernels(const std::vector<PhasePart>& parts, std::size_t index,
                           const PhaseGridding& gridding, double slew)
    : part_(&parts[index]),
      states_(part_->states),
      phases_(gridding.phases),
      horizon_(gridding.horizon),
      late_blocks_(gridding.late_blocks),
      late_every_(late_blocks_ == 0 ? 0 : lags_of_turns(gridding.late_turns, *part_)),
      lags_(horizon_ + late_blocks_ * late_every_),
      all_lags_(std::max(gridding.lags, lags_)),
      slew_(slew) {
  find_columns();
  find_windows();
  find_lags(parts, index);
}

void PhaseKernels::find_columns() {
  columns_.resize(kFirstGate);
  for (const GridFunction& each : part_->noise) {
    columns_[kNoise].components.push_back(&each);
  }
  columns_[kSlew].components.push_back(&part_->slew);
  for (const auto& [input, column] : part_->columns) {
    columns_.push_back({{&column}, {}, {}, {}, {}});
  }
  for (Column& each : columns_) {
    each.sizes.assign(states_, 0.0);
    each.bent.assign(states_, 0.0);
    each.leaned.assign(states_, 0.0);
    each.mistaken.assign(states_, 0.0);
  }
}

double PhaseKernels::half_width_at(std::size_t lag) const {
  return part_->half_width + 0.5 * static_cast<double>(lag + 2) * slew_;
}

void PhaseKernels::find_windows() {
  const double points = static_cast<double>(phases_) / (2.0 * std::numbers::pi) * (1.0 + 1e-12);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  for (std::size_t k = 0; k < horizon_; ++k) {
    const double lag = static_cast<double>(k + 1);
    const double length = 1.0 + 2.0 * lag * half_width_at(k) * points;
    const double count = static_cast<double>(phases_);
    // From the first phase of the cell on, at the highest frequency; a little more for rounding.
    const double low = -lag * (part_->frequency + half_width_at(k)) * points - 1e-6;
    Window window;
    window.offset = static_cast<std::size_t>(std::floor(low - std::floor(low / count) * count)) % phases_;
    const double width = std::ceil(length + 2e-6) + 1.0;
    // Wide windows begin at multiples of an eighth of their width: then there are few.
    const std::size_t first = window.offset;
    const auto fits = [&] {
      const std::size_t cells = std::size_t{1} << window.exponent;
      const std::size_t grain = std::max<std::size_t>(cells / 8, 1);
      window.offset = cells < phases_ ? first / grain * grain : 0;
      return cells >= phases_ ||
             static_cast<double>(first - window.offset) + width <= static_cast<double>(cells);
    };
    while (!fits()) {
      ++window.exponent;
    }
    const auto [found, is_new] = known.try_emplace({window.offset, window.exponent}, windows_.size());
    if (is_new) {
      windows_.push_back(window);
    }
    window_of_.push_back(found->second);
  }
}

void PhaseKernels::widen(const std::vector<PhasePart>& parts, std::size_t index, std::size_t reach,
                         Neighbours& neighbours) const {
  for (std::size_t q = index - std::min(index, reach); q < parts.size() && q <= index + reach; ++q) {
    const std::size_t distance = q > index ? q - index : index - q;
    if (distance <= neighbours.reach && distance > 0) {
      continue;
    }
    const PhasePart& other = parts[q];
    for (std::size_t i = 0; i < neighbours.off.size() && distance > 0; ++i) {
      neighbours.off[i] =
          larger_or_nan(neighbours.off[i], rigor::magnitude(other.matrix[i] - Interval(part_->middle[i])));
    }
    std::vector<std::vector<const GridFunction*>> theirs(kFirstGate);
    for (const GridFunction& each : other.noise) {
      theirs[kNoise].push_back(&each);
    }
    theirs[kSlew].push_back(&other.slew);
    for (const auto& [input, column] : other.columns) {
      theirs.push_back({&column});
    }
    for (std::size_t l = 0; l < columns_.size(); ++l) {
      for (std::size_t c = 0; c < columns_[l].components.size(); ++c) {
        const GridFunction& mine = *columns_[l].components[c];
        const GridFunction& its = *theirs.at(l).at(c);
        for (std::size_t i = 0; i < states_; ++i) {
          double far = 0.0;
          for (std::size_t g = 0; g < phases_; ++g) {
            far = larger_or_nan(
                far, rigor::magnitude(Interval(its.values[0][i][g]) - Interval(mine.values[0][i][g])));
          }
          double& error = neighbours.error[l][c][i];
          error = larger_or_nan(error, far + its.error[i]);
        }
      }
    }
  }
  neighbours.reach = reach;
}

std::vector<double> PhaseKernels::end_matrix(std::size_t end) const {
  Vector matrix = part_->middle;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    matrix[i] += end == 0 ? -part_->lean[i] : part_->lean[i];
  }
  return matrix;
}

std::vector<double> PhaseKernels::product_of(const Vector& a, const Vector& b) const {
  const std::size_t n = states_;
  Vector result(n * n, 0.0);
  for (std::size_t i = 0; i < n * n; ++i) {
    for (std::size_t m = 0; m < n; ++m) {
      result[i] += a[i / n * n + m] * b[m * n + i % n];
    }
  }
  return result;
}

double PhaseKernels::size_of_power(std::size_t lag, std::size_t entry) const {
  const std::size_t at = lag * states_ * states_ + entry;
  return larger_or_nan(std::fabs(powers_[0][at]), std::fabs(powers_[1][at]));
}

double PhaseKernels::lean_of_power(std::size_t lag, std::size_t entry) const {
  const std::size_t at = lag * states_ * states_ + entry;
  return 0.5 * rigor::magnitude(Interval(powers_[1][at]) - Interval(powers_[0][at]));
}

void PhaseKernels::add_lag(std::size_t lag, const Neighbours& neighbours) {
  const double points = static_cast<double>(phases_) / (2.0 * std::numbers::pi) * (1.0 + 1e-12);
  // How far apart the phases are from which the ends of the part come, in cells.
  const double spread = 2.0 * static_cast<double>(lag + 1) * half_width_at(lag) * points;
  const double bend = std::min(0.25 * spread * std::ceil(spread), 0.125 * spread * spread + 0.25 * spread);
  for (std::size_t l = 0; l < columns_.size(); ++l) {
    Column& column = columns_[l];
    for (std::size_t c = 0; c < column.components.size(); ++c) {
      const GridFunction& of = *column.components[c];
      const Vector& error = neighbours.error[l][c];
      for (std::size_t j = 0; j < states_; ++j) {
        const double twice = 2.0 * of.largest[j];
        const double bent = 0.25 * of.second_difference[j] + std::min(bend * of.second_difference[j], twice) +
                            std::min(0.5 * spread * of.lean_difference[j], 2.0 * of.lean[j]);
        const double moved = std::min(0.5 * spread * of.first_difference[j] + of.lean[j], twice);
        for (std::size_t i = 0; i < states_; ++i) {
          const double size = size_of_power(lag, i * states_ + j);
          const double lean = lean_of_power(lag, i * states_ + j);
          column.sizes[i] += size * (of.largest[j] + error[j]);
          column.bent[i] += size * bent + lean * moved;
          column.leaned[i] += size * moved + lean * of.largest[j];
          column.mistaken[i] += size * error[j];
        }
      }
    }
  }
}

/// |G_(k+1) - G_k A| at all frequencies of the part: a polynomial of the second degree, whose square is
/// between 0 and 1.
void PhaseKernels::add_defect(std::size_t lag, const Neighbours& neighbours) {
  const std::size_t n = states_;
  const auto entry = [&](std::size_t of_lag, std::size_t at, double sign) {
    if (of_lag == lags_) {
      return Interval(0.0);
    }
    const std::size_t place = of_lag * n * n + at;
    return Interval(0.5) * (Interval(powers_[1][place]) + Interval(sign) * Interval(powers_[0][place]));
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      Interval constant = entry(lag + 1, i * n + j, 1.0);
      Interval linear = entry(lag + 1, i * n + j, -1.0);
      Interval square(0.0);
      double off = 0.0;
      for (std::size_t m = 0; m < n; ++m) {
        const Interval middle = entry(lag, i * n + m, 1.0);
        const Interval lean = entry(lag, i * n + m, -1.0);
        const Interval matrix(part_->middle[m * n + j]);
        const Interval matrix_lean(part_->lean[m * n + j]);
        constant -= middle * matrix;
        linear -= lean * matrix + middle * matrix_lean;
        square -= lean * matrix_lean;
        off += size_of_power(lag, i * n + m) * neighbours.off[m * n + j];
      }
      defect_[i * n + j] += larger_or_nan(rigor::magnitude(constant), rigor::magnitude(constant + square)) +
                            rigor::magnitude(linear) + off;
    }
  }
}

void PhaseKernels::find_lags(const std::vector<PhasePart>& parts, std::size_t index) {
  const std::size_t n = states_;
  power_sum_.assign(n * n, 0.0);
  defect_.assign(n * n, 0.0);
  largest_power_.assign(kBlocks + 1, Vector(n * n, 0.0));
  Neighbours neighbours;
  neighbours.off = part_->off;
  for (const Column& each : columns_) {
    neighbours.error.emplace_back(each.components.size(), Vector(n, 0.0));
  }
  widen(parts, index, 0, neighbours);
  for (const std::size_t end : {0U, 1U}) {
    const Vector matrix = end_matrix(end);
    Vector power(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      power[i * n + i] = 1.0;
    }
    powers_[end] = power;
    for (std::size_t k = 1; k < horizon_ + (late_blocks_ > 0 ? 1 : 0); ++k) {
      power = product_of(power, matrix);
      powers_[end].insert(powers_[end].end(), power.begin(), power.end());
    }
  }
  for (std::size_t k = 0; k < horizon_; ++k) {
    if (slew_ > 0.0) {
      const double far = static_cast<double>(k + 1) * slew_ / (2.0 * part_->half_width) + 1.0 + 1e-6;
      const auto reach = static_cast<std::size_t>(std::min(far, static_cast<double>(parts.size())));
      if (reach > neighbours.reach) {
        widen(parts, index, reach, neighbours);
      }
    }
    for (std::size_t i = 0; i < n * n; ++i) {
      const double size = size_of_power(k, i);
      power_sum_[i] += size;
      double& largest = largest_power_[k * kBlocks / all_lags_][i];
      largest = larger_or_nan(largest, size);
    }
    add_defect(k, neighbours);
    add_lag(k, neighbours);
  }
  early_power_sum_ = power_sum_;
  if (late_blocks_ > 0) {
    find_late();
  }
  for (std::size_t block = kBlocks; block-- > 0;) {
    for (std::size_t i = 0; i < n * n; ++i) {
      largest_power_[block][i] = larger_or_nan(largest_power_[block][i], largest_power_[block + 1][i]);
    }
  }
}

std::optional<std::vector<double>> PhaseKernels::least_total(const std::vector<PhaseKernels>& all,
                                                             const std::vector<Vector>& sums) {
  constexpr int kSteps = 200;
  constexpr double kRoom = 1.0 + 1e-7;
  const auto after = [&](const Vector& total) {
    Vector most(total.size(), 0.0);
    for (std::size_t p = 0; p < all.size(); ++p) {
      const Vector each = matrix_times(all[p].defect_, total);
      for (std::size_t i = 0; i < most.size(); ++i) {
        most[i] = larger_or_nan(most[i], sums[p][i] + each[i]);
      }
    }
    return most;
  };
  Vector total(sums.front().size(), 0.0);
  for (int i = 0; i < kSteps; ++i) {
    total = after(total);
    for (double& each : total) {
      each = each * kRoom + 1e-300;
    }
  }
  const Vector next = after(total);
  for (std::size_t i = 0; i < total.size(); ++i) {
    if (!(next[i] <= total[i]) || !std::isfinite(total[i])) {
      return std::nullopt;
    }
  }
  return total;
}

std::optional<PhaseTotals> PhaseKernels::totals_of(const std::vector<PhaseKernels>& all) {
  PhaseTotals totals;
  if (all.empty()) {
    return std::nullopt;
  }
  const auto total = [&](auto sums_of, Vector& result) {
    std::vector<Vector> sums;
    sums.reserve(all.size());
    for (const PhaseKernels& each : all) {
      sums.push_back(sums_of(each));
    }
    auto found = least_total(all, sums);
    result = found ? *std::move(found) : Vector();
    return !result.empty();
  };
  totals.of_column.resize(all.front().columns_.size());
  Vector residual(all.front().states_, 0.0);  // that of a sample before may be of another part
  for (const PhaseKernels& each : all) {
    for (std::size_t i = 0; i < residual.size(); ++i) {
      const PhasePart& part = *each.part_;
      residual[i] = larger_or_nan(residual[i], part.rounding.empty()
                                                   ? part.residual[i]
                                                   : rigor::add_up(part.residual[i], part.rounding[i]));
    }
  }
  bool is_bounded =
      total([](const PhaseKernels& each) { return matrix_times(each.power_sum_, Vector(each.states_, 1.0)); },
            totals.contraction) &&
      total([&residual](const PhaseKernels& each) { return matrix_times(each.power_sum_, residual); },
            totals.residual);
  for (std::size_t l = 0; l < totals.of_column.size(); ++l) {
    is_bounded = is_bounded && total([l](const PhaseKernels& each) { return each.columns_.at(l).sizes; },
                                     totals.of_column[l]);
  }
  return is_bounded ? std::optional(std::move(totals)) : std::nullopt;
}

std::optional<std::vector<double>> PhaseKernels::peak_of(const std::vector<PhaseKernels>& all,
                                                         const std::vector<double>& start) {
  std::vector<Vector> sums;
  sums.reserve(all.size());
  for (const PhaseKernels& each : all) {
    sums.push_back(matrix_times(each.largest_power_.front(), start));
  }
  return least_total(all, sums);
}

std::vector<double> PhaseKernels::from_start(const std::vector<double>& start,
                                             const std::vector<double>& peak, std::size_t block) const {
  Vector states = matrix_times(largest_power_.at(block), start);
  const Vector rest = matrix_times(defect_, peak);
  for (std::size_t i = 0; i < states_; ++i) {
    states[i] += rest[i];
  }
  Vector result;
  for (const GridFunction& form : part_->forms) {
    double sum = 0.0;
    for (std::size_t i = 0; i < states_; ++i) {
      sum += (form.largest[i] + form.error[i]) * states[i];
    }
    result.push_back(sum);
  }
  return result;
}

}  // namespace veritrack::model

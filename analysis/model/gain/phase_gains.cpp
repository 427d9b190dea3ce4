#include "analysis/model/gain/phase_gains.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

using rigor::Interval;

void PhaseErrors::join(const PhaseErrors& other) {
  for_ever = larger_or_nan(for_ever, other.for_ever);
  long_run = larger_or_nan(long_run, other.long_run);
  linear = larger_or_nan(linear, other.linear);
  ripple = larger_or_nan(ripple, other.ripple);
  mean = hull(mean, other.mean);
  for (std::size_t i = 0; i < from_block.size(); ++i) {
    from_block[i] = larger_or_nan(from_block[i], other.from_block.at(i));
  }
}

namespace {

/// In any order, each with upward rounding.
template <typename Task>
void for_each_part(std::size_t parts, const Task& task) {
  oneapi::tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    const rigor::UpwardRounding upward;
    task(part);
  });
}

}  // namespace

std::optional<PhaseGains> PhaseGains::make(std::vector<PhasePart> parts, const PhaseGridding& gridding,
                                           double slew) {
  PhaseGains bounds;
  bounds.phases_ = gridding.phases;
  bounds.slew_ = slew;
  for (PhasePart& each : parts) {
    auto widened = with_slew(std::move(each), slew);
    if (!widened) {
      return std::nullopt;
    }
    bounds.parts_.push_back(*std::move(widened));
  }
  std::vector<std::optional<PhaseKernels>> kernels(bounds.parts_.size());
  for_each_part(kernels.size(), [&](std::size_t p) { kernels[p].emplace(bounds.parts_, p, gridding, slew); });
  for (std::optional<PhaseKernels>& each : kernels) {
    bounds.kernels_.push_back(*std::move(each));
  }
  const auto totals = PhaseKernels::totals_of(bounds.kernels_);
  if (!totals) {
    return std::nullopt;
  }
  for_each_part(bounds.kernels_.size(), [&](std::size_t p) { bounds.kernels_[p].find(*totals); });
  return bounds;
}

std::vector<double> PhaseGains::sizes(const PhasePart& part, double noise, const std::vector<double>& bounds,
                                      std::size_t phase) const {
  std::vector<double> result;
  result.reserve(part.cells[phase].inputs.size());
  for (const PhaseInput& input : part.cells[phase].inputs) {
    double size = 0.0;
    if (input.is_noise) {
      size = noise;
    } else if (input.size) {
      size = input.size(bounds);
    } else {
      for (const DirectWeight& each : input.sources) {
        size += each.weight * result[static_cast<std::size_t>(each.input)];
      }
    }
    result.push_back(size);
  }
  return result;
}

PhaseGains::Sizes PhaseGains::sizes_at(double noise, const Bounds& bounds) const {
  Sizes result;
  result.of_column.assign(parts_.front().columns.size(), std::vector<double>(phases_, 0.0));
  result.of_input.resize(parts_.size());
  for_each_part(parts_.size(), [&](std::size_t p) {
    for (std::size_t g = 0; g < phases_; ++g) {
      result.of_input[p].push_back(sizes(parts_[p], noise, bounds[g], g));
    }
  });
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    for (std::size_t g = 0; g < phases_; ++g) {
      std::size_t q = 0;
      for (const auto& [input, column] : parts_[p].columns) {
        double& most = result.of_column[q++][g];
        most = larger_or_nan(most, result.of_input[p][g][static_cast<std::size_t>(input)]);
      }
    }
  }
  return result;
}

namespace {

/// By exponent and cell: the largest of as many cells from this one on as that power of 2.
std::vector<std::vector<double>> largest_over_windows(const std::vector<double>& sizes) {
  std::vector<std::vector<double>> table{sizes};
  for (std::size_t width = 1; width < sizes.size(); width *= 2) {
    const std::vector<double>& last = table.back();
    std::vector<double> next(sizes.size());
    for (std::size_t g = 0; g < sizes.size(); ++g) {
      next[g] = larger_or_nan(last[g], last[(g + width) % sizes.size()]);
    }
    table.push_back(std::move(next));
  }
  return table;
}

}  // namespace

void PhaseGains::add_part(const LoopDisturbance& disturbance, const Sizes& sizes, std::size_t part,
                          Bounds& result) const {
  const PhaseKernels& kernels = kernels_[part];
  const std::vector<PhaseKernels::Window>& windows = kernels.windows();
  const std::size_t forms = kernels.forms();
  const std::size_t gates = sizes.of_column.size();
  std::vector<std::vector<std::vector<double>>> tables;
  std::vector<double> largest;
  for (const std::vector<double>& each : sizes.of_column) {
    tables.push_back(largest_over_windows(each));
    largest.push_back(tables.back().back().front());
  }
  std::vector<double> weights(gates * windows.size());
  for (std::size_t g = 0; g < phases_; ++g) {
    for (std::size_t q = 0; q < gates; ++q) {
      for (std::size_t w = 0; w < windows.size(); ++w) {
        weights[q * windows.size() + w] = tables[q][windows[w].exponent][(g + windows[w].offset) % phases_];
      }
    }
    for (std::size_t f = 0; f < forms; ++f) {
      double sum = kernels.residual(f) + kernels.missed(f, PhaseKernels::kNoise) * disturbance.noise +
                   kernels.missed(f, PhaseKernels::kSlew) * disturbance.slew;
      for (const DirectWeight& each : parts_[part].cells[g].direct[f]) {
        sum += each.weight * sizes.of_input[part][g][static_cast<std::size_t>(each.input)];
      }
      for (std::size_t q = 0; q < gates; ++q) {
        sum += kernels.missed(f, PhaseKernels::kFirstGate + q) * largest[q];
      }
      double most = 0.0;
      for (const std::size_t point : {g, (g + 1) % phases_}) {
        double here = kernels.gain(f, PhaseKernels::kNoise, point) * disturbance.noise +
                      kernels.gain(f, PhaseKernels::kSlew, point) * disturbance.slew;
        for (std::size_t q = 0; q < gates; ++q) {
          const double* gains = kernels.gains(f, PhaseKernels::kFirstGate + q, point);
          const double* of_gate = weights.data() + q * windows.size();
          for (std::size_t w = 0; w < windows.size(); ++w) {
            here += gains[w] * of_gate[w];
          }
        }
        most = larger_or_nan(most, here);
      }
      result[g][f] = sum + most;
    }
  }
}

PhaseGains::Bounds PhaseGains::after(const LoopDisturbance& disturbance, const Bounds& bounds) const {
  const Sizes sizes = sizes_at(disturbance.noise, bounds);
  const Bounds nothing(phases_, std::vector<double>(kernels_.front().forms(), 0.0));
  std::vector<Bounds> by_part(parts_.size(), nothing);
  for_each_part(parts_.size(), [&](std::size_t part) { add_part(disturbance, sizes, part, by_part[part]); });
  Bounds result = nothing;
  for (const Bounds& each : by_part) {
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t f = 0; f < result[g].size(); ++f) {
        result[g][f] = larger_or_nan(result[g][f], each[g][f]);
      }
    }
  }
  return result;
}

PhaseGains::Bounds PhaseGains::plus(const Bounds& bounds, const std::vector<double>& by_form) {
  Bounds sum = bounds;
  for (std::vector<double>& cell : sum) {
    for (std::size_t f = 0; f < by_form.size(); ++f) {
      cell[f] += by_form[f];
    }
  }
  return sum;
}

std::optional<PhaseGains::Bounds> PhaseGains::closed(const LoopDisturbance& disturbance,
                                                     const std::vector<double>& from_start) const {
  constexpr int kMostSteps = 200;
  constexpr double kTooFar = 5.0;  // times the linear bounds: they do not close where they have grown so
  constexpr double kRoom = 1.0005;
  constexpr double kTooLarge = 1e6;
  Bounds bounds(phases_, std::vector<double>(kernels_.front().forms(), 0.0));
  double linear = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    Bounds next = plus(after(disturbance, bounds), from_start);
    double growth = 0.0;
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t f = 0; f < next[g].size(); ++f) {
        next[g][f] = next[g][f] * kRoom + 1e-300;
        if (!(next[g][f] < kTooLarge)) {
          return std::nullopt;
        }
        growth = std::max(growth, next[g][f] - bounds[g][f] * 1.00001);
      }
    }
    bounds = std::move(next);
    const double error = error_of(bounds);
    linear = step == 0 ? error : linear;
    if (!(error <= kTooFar * linear)) {
      return std::nullopt;
    }
    if (growth <= 0.0) {
      break;
    }
  }
  const Bounds next = plus(after(disturbance, bounds), from_start);
  for (std::size_t g = 0; g < phases_; ++g) {
    for (std::size_t f = 0; f < next[g].size(); ++f) {
      if (!(next[g][f] <= bounds[g][f])) {
        return std::nullopt;
      }
    }
  }
  return bounds;
}

double PhaseGains::error_of(const Bounds& bounds) const {
  double error = 0.0;
  for (const PhasePart& part : parts_) {
    for (std::size_t g = 0; g < phases_; ++g) {
      error = larger_or_nan(error, bounds[g].back() + rigor::magnitude(part.cells[g].bias));
    }
  }
  return error;
}

double PhaseGains::missed_share() const {
  double share = 0.0;
  for (const PhaseKernels& each : kernels_) {
    const std::size_t error = each.forms() - 1;
    double gain = 0.0;
    for (std::size_t g = 0; g < phases_; ++g) {
      gain = std::max(gain, each.gain(error, PhaseKernels::kNoise, g));
    }
    share = larger_or_nan(share, each.missed(error, PhaseKernels::kNoise) / gain);
  }
  return share;
}

double PhaseGains::largest_bias() const {
  return error_of(Bounds(phases_, std::vector<double>(1, 0.0)));
}

std::optional<std::pair<std::size_t, Interval>> PhaseGains::frequency_state() const {
  std::optional<std::pair<std::size_t, Interval>> found = parts_.front().frequency_state;
  for (const PhasePart& part : parts_) {
    if (!found || !part.frequency_state || found->first != part.frequency_state->first) {
      return std::nullopt;
    }
    found->second = hull(found->second, part.frequency_state->second);
  }
  return found;
}

void PhaseGains::add_mean_and_ripple(const Bounds& bounds, PhaseErrors& errors) const {
  errors.mean = Interval::empty();
  for (const PhasePart& part : parts_) {
    Interval sum(0.0);
    Interval around(0.0);
    double most = 0.0;
    for (std::size_t g = 0; g < phases_; ++g) {
      const PhaseNetwork& cell = part.cells[g];
      const double error = bounds[g].back();
      sum += cell.mean_bias;
      most = larger_or_nan(most, error);
      const Interval here = cell.bias + Interval::from_bounds(-error, error);
      around = g == 0 ? here : hull(around, here);
    }
    const Interval mean = sum / Interval(static_cast<double>(phases_)) + Interval::from_bounds(-most, most);
    errors.mean = is_empty(errors.mean) ? mean : hull(errors.mean, mean);
    errors.ripple = larger_or_nan(errors.ripple, rigor::sub_up(around.upper(), around.lower()));
  }
}

std::optional<PhaseErrors> PhaseGains::errors(const LoopDisturbance& disturbance) const {
  constexpr int kRefinements = 8;
  if (!(disturbance.slew >= 0.0) || !(disturbance.slew <= slew_) || !(disturbance.noise >= 0.0)) {
    return std::nullopt;
  }
  const std::size_t n = parts_.front().states;
  std::vector<double> start(n, 0.0);  // in the basis
  for (const PhasePart& part : parts_) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < disturbance.start.size(); ++j) {
        sum += part.inverse[i * n + j] * disturbance.start[j];
      }
      start[i] = larger_or_nan(start[i], sum);
    }
  }
  const auto peak = PhaseKernels::peak_of(kernels_, start);
  if (!peak) {
    return std::nullopt;
  }
  const auto from_start = [&](std::size_t block) {
    std::vector<double> most(kernels_.front().forms(), 0.0);
    for (const PhaseKernels& each : kernels_) {
      const std::vector<double> here = each.from_start(start, *peak, block);
      for (std::size_t f = 0; f < most.size(); ++f) {
        most[f] = larger_or_nan(most[f], here[f]);
      }
    }
    return most;
  };
  const bool starts_off = !disturbance.start.empty();
  const std::vector<double> nothing(kernels_.front().forms(), 0.0);
  std::optional<Bounds> bounds = closed(disturbance, starts_off ? from_start(0) : nothing);
  if (!bounds) {
    return std::nullopt;
  }
  PhaseErrors errors;
  errors.for_ever = error_of(*bounds);
  const Bounds settled = after(disturbance, *bounds);
  for (std::size_t block = 0; block < PhaseKernels::kBlocks; ++block) {
    errors.from_block.push_back(
        std::min(errors.for_ever, error_of(plus(settled, starts_off ? from_start(block) : nothing))));
  }
  for (int i = 0; i < kRefinements; ++i) {
    const Bounds next = after(disturbance, *bounds);
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t f = 0; f < next[g].size(); ++f) {
        (*bounds)[g][f] = next[g][f] <= (*bounds)[g][f] ? next[g][f] : (*bounds)[g][f];
      }
    }
  }
  errors.long_run = error_of(*bounds);
  for (const PhaseKernels& each : kernels_) {
    for (std::size_t g = 0; g < phases_; ++g) {
      const std::size_t error = each.forms() - 1;
      errors.linear =
          larger_or_nan(errors.linear, each.gain(error, PhaseKernels::kNoise, g) * disturbance.noise +
                                           each.gain(error, PhaseKernels::kSlew, g) * disturbance.slew);
    }
  }
  add_mean_and_ripple(*bounds, errors);
  return errors;
}

}  // namespace veritrack::model

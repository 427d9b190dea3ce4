// One round of the bounds of the theorem, and the rounds until they close.
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/gain/phase_gains.hpp"
#include "analysis/model/gain/upward_parts.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::larger_or_nan;

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
  std::vector<std::vector<double>> late;
  for (const std::vector<double>& each : sizes.of_column) {
    late.push_back(kernels.has_late() ? kernels.late_sizes(each) : std::vector<double>());
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
          if (kernels.has_late()) {
            const double* of_cells = kernels.late(f, PhaseKernels::kFirstGate + q, point);
            for (std::size_t j = 0; j < phases_; ++j) {
              here += of_cells[j] * late[q][j];
            }
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
  // Times the linear bounds: they do not close where they have grown so. Where errors decay slowly, what is
  // of the second order in the noise adds up to more.
  const double too_far = kernels_.front().has_late() ? 200.0 : 5.0;
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
    if (!(error <= too_far * linear)) {
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

}  // namespace veritrack::model

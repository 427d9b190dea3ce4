#include "analysis/model/gain/phase_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

std::optional<PhaseLoop> PhaseLoop::make(const TrackerModel& tracker, const FloquetCell& cell,
                                         const PhaseGridding& gridding, std::size_t part) {
  const rigor::BallModelScope scope(0, 0);
  PhaseLoop loop;
  const std::size_t n = cell.states();
  loop.states_ = n;
  loop.phases_ = gridding.phases;
  loop.horizon_ = gridding.horizon;
  const double half_turn = 0.5 / static_cast<double>(gridding.phases);
  const double half_z = 1.0 / static_cast<double>(gridding.parts);
  TubeCell place;
  place.half_turn = half_turn;
  place.half_z = half_z;
  place.z = static_cast<double>(2 * part + 1) * half_z - 1.0;
  loop.matrix_.assign(n, std::vector<Interval>(n));
  for (std::size_t g = 0; g < gridding.phases; ++g) {
    place.turn = static_cast<double>(2 * g + 1) * half_turn;
    loop.steps_.push_back(phase_step(tracker, cell, place));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Interval range = loop.steps_.back().matrix[i][j].range();
        if (is_empty(range)) {
          return std::nullopt;
        }
        loop.matrix_[i][j] = g == 0 ? range : hull(loop.matrix_[i][j], range);
      }
    }
  }
  loop.first_ = cell.curve.frequency + cell.curve.half_width * place.z;
  // A little more, for the rounding of the middle.
  loop.half_width_ = rigor::mul_up(cell.curve.half_width * half_z, 1.0 + 1e-9) + 1e-15;
  loop.find_windows(cell, gridding, part);
  if (!loop.find_kernels()) {
    return std::nullopt;
  }
  return loop;
}

std::vector<double> PhaseLoop::sizes(double noise, const std::vector<double>& bounds,
                                     std::size_t phase) const {
  const PhaseStep& step = steps_[phase];
  std::vector<double> result;
  for (const PhaseInput& input : step.inputs) {
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

PhaseLoop::Bounds PhaseLoop::after(double noise, const Bounds& bounds) const {
  std::vector<std::vector<double>> size_of;
  for (std::size_t g = 0; g < phases_; ++g) {
    size_of.push_back(sizes(noise, bounds[g], g));
  }
  const std::vector<int>& gates = steps_.front().gates;
  // By gate and window: the largest size over the window of each cell; and over all.
  std::vector<std::vector<std::vector<double>>> weights(gates.size());
  std::vector<double> largest(gates.size(), 0.0);
  for (std::size_t q = 0; q < gates.size(); ++q) {
    std::vector<double> of_cell(phases_);
    for (std::size_t g = 0; g < phases_; ++g) {
      of_cell[g] = size_of[g][static_cast<std::size_t>(gates[q])];
      largest[q] = larger_or_nan(largest[q], of_cell[g]);
    }
    weights[q].assign(phases_, std::vector<double>(windows_.size(), 0.0));
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t w = 0; w < windows_.size(); ++w) {
        double most = 0.0;
        for (std::size_t i = 0; i < windows_[w].width; ++i) {
          const double each = of_cell[(g + windows_[w].offset + i) % phases_];
          most = larger_or_nan(most, each);
        }
        weights[q][g][w] = most;
      }
    }
  }
  Bounds result(phases_, std::vector<double>(kernels_.size(), 0.0));
  for (std::size_t g = 0; g < phases_; ++g) {
    for (std::size_t f = 0; f < kernels_.size(); ++f) {
      double sum = noise_[f][g] * noise + residual_[f];
      for (const DirectWeight& each : steps_[g].forms[f].direct) {
        sum += each.weight * size_of[g][static_cast<std::size_t>(each.input)];
      }
      for (std::size_t q = 0; q < gates.size(); ++q) {
        sum += kernels_[f][q].missed * largest[q];
      }
      double most = 0.0;
      for (std::size_t corner = 0; corner < 4; ++corner) {
        double of_corner = 0.0;
        for (std::size_t q = 0; q < gates.size(); ++q) {
          const double* kernel = kernels_[f][q].sums.data() + (g * 4 + corner) * windows_.size();
          for (std::size_t w = 0; w < windows_.size(); ++w) {
            of_corner += kernel[w] * weights[q][g][w];
          }
        }
        most = larger_or_nan(most, of_corner);
      }
      result[g][f] = sum + most;
    }
  }
  return result;
}

double PhaseLoop::error_of(const Bounds& bounds) const {
  double error = 0.0;
  for (std::size_t g = 0; g < phases_; ++g) {
    const Interval bias = steps_[g].bias.range();
    const double here = is_empty(bias) ? INFINITY : bounds[g].back() + rigor::magnitude(bias);
    error = larger_or_nan(error, here);
  }
  return error;
}

std::optional<PhaseErrors> PhaseLoop::errors(double noise) const {
  constexpr int kMostSteps = 400;
  constexpr double kRoom = 1.0005;
  Bounds bounds(phases_, std::vector<double>(kernels_.size(), 0.0));
  for (int step = 0; step < kMostSteps; ++step) {
    Bounds next = after(noise, bounds);
    for (auto& cell : next) {
      for (double& each : cell) {
        each = each * kRoom + 1e-300;
      }
    }
    double growth = 0.0;
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t f = 0; f < next[g].size(); ++f) {
        if (!(next[g][f] < 1e6)) {
          return std::nullopt;
        }
        growth = std::max(growth, next[g][f] - bounds[g][f] * 1.00001);
      }
    }
    bounds = std::move(next);
    if (growth <= 0.0) {
      break;
    }
  }
  const Bounds next = after(noise, bounds);
  for (std::size_t g = 0; g < phases_; ++g) {
    for (std::size_t f = 0; f < next[g].size(); ++f) {
      if (!(next[g][f] <= bounds[g][f])) {
        return std::nullopt;
      }
    }
  }
  PhaseErrors errors;
  errors.for_ever = error_of(bounds);
  errors.long_run = error_of(next);
  for (std::size_t g = 0; g < phases_; ++g) {
    errors.linear = std::max(errors.linear, noise_.back()[g] * noise);
  }
  return errors;
}

}  // namespace veritrack::model

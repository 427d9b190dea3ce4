#include "analysis/model/gain/phase_gains.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/gain/upward_parts.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::Interval;
using rigor::larger_or_nan;

void PhaseErrors::join(const PhaseErrors& other) {
  for_ever = larger_or_nan(for_ever, other.for_ever);
  long_run = larger_or_nan(long_run, other.long_run);
  linear = larger_or_nan(linear, other.linear);
  bias = larger_or_nan(bias, other.bias);
  ripple = larger_or_nan(ripple, other.ripple);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i] = larger_or_nan(states[i], other.states.at(i));
  }
  mean = hull(mean, other.mean);
  for (std::size_t i = 0; i < from_block.size(); ++i) {
    from_block[i] = larger_or_nan(from_block[i], other.from_block.at(i));
  }
}

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

double PhaseGains::error_of(const Bounds& bounds) const {
  double error = 0.0;
  for (const PhasePart& part : parts_) {
    for (std::size_t g = 0; g < phases_; ++g) {
      error = larger_or_nan(
          error, bounds[g].back() + rigor::magnitude(part.cells[g].bias) + part.rounding_of_frequency);
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
  double bias = 0.0;
  for (const PhasePart& part : parts_) {
    for (const PhaseNetwork& cell : part.cells) {
      bias = larger_or_nan(bias, rigor::magnitude(cell.bias));
    }
  }
  return bias;
}

double PhaseGains::rounding_of_frequency() const {
  double most = 0.0;
  for (const PhasePart& part : parts_) {
    most = larger_or_nan(most, part.rounding_of_frequency);
  }
  return most;
}

std::vector<double> PhaseGains::rounded(const std::vector<double>& start) const {
  std::vector<double> result = start;
  for (const PhasePart& part : parts_) {
    result.resize(std::max(result.size(), part.rounding_of_start.size()), 0.0);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    double most = 0.0;
    for (const PhasePart& part : parts_) {
      most = larger_or_nan(most, part.rounding_of_start.empty() ? 0.0 : part.rounding_of_start[i]);
    }
    result[i] += most;
  }
  return result;
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
      const double error = bounds[g].back() + part.rounding_of_frequency;
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

std::vector<double> PhaseGains::in_basis(const std::vector<double>& start) const {
  const std::size_t n = states();
  std::vector<double> result(n, 0.0);
  for (const PhasePart& part : parts_) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < start.size(); ++j) {
        sum += part.inverse[i * n + j] * start[j];
      }
      result[i] = larger_or_nan(result[i], sum);
    }
  }
  return result;
}

PhaseGains::Bounds PhaseGains::in_long_run(const LoopDisturbance& disturbance, Bounds bounds) const {
  constexpr int kRefinements = 8;
  for (int i = 0; i < kRefinements; ++i) {
    const Bounds next = after(disturbance, bounds);
    for (std::size_t g = 0; g < phases_; ++g) {
      for (std::size_t f = 0; f < next[g].size(); ++f) {
        bounds[g][f] = next[g][f] <= bounds[g][f] ? next[g][f] : bounds[g][f];
      }
    }
  }
  return bounds;
}

double PhaseGains::linear_error(const LoopDisturbance& disturbance) const {
  double most = 0.0;
  for (const PhaseKernels& each : kernels_) {
    const std::size_t error = each.forms() - 1;
    for (std::size_t g = 0; g < phases_; ++g) {
      most = larger_or_nan(most, each.gain(error, PhaseKernels::kNoise, g) * disturbance.noise +
                                     each.gain(error, PhaseKernels::kSlew, g) * disturbance.slew);
    }
  }
  return most;
}

std::optional<PhaseErrors> PhaseGains::errors(const LoopDisturbance& disturbance) const {
  if (!(disturbance.slew >= 0.0) || !(disturbance.slew <= slew_) || !(disturbance.noise >= 0.0)) {
    return std::nullopt;
  }
  const std::vector<double> of_states = rounded(disturbance.start);
  const std::vector<double> start = in_basis(of_states);
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
  const bool starts_off = !of_states.empty();
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
  const Bounds late = in_long_run(disturbance, *bounds);
  errors.long_run = error_of(late);
  errors.linear = linear_error(disturbance);
  errors.bias = largest_bias();
  add_mean_and_ripple(late, errors);
  if (!parts_.front().rounding_of_start.empty()) {
    errors.states.assign(states(), 0.0);
    for (const std::vector<double>& of_cell : *bounds) {
      for (std::size_t i = 0; i < states(); ++i) {
        errors.states[i] = larger_or_nan(errors.states[i], of_cell[i]);
      }
    }
  }
  return errors;
}

}  // namespace veritrack::model

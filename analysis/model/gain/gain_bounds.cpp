#include "analysis/model/gain/gain_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

using Cause = NetworkInput::Cause;
using Numbers = std::vector<double>;

namespace {

/// a + b c, an upper bound of numbers that are not negative.
double plus(double a, double b, double c) {
  return b == 0.0 || c == 0.0 ? a : rigor::add_up(a, rigor::mul_up(b, c));
}

bool is_at_most(const Numbers& a, const Numbers& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x <= y && std::isfinite(y); });
}

}  // namespace

/// The equation of one block, with what earlier blocks contribute.
class GainBounds::Block {
 public:
  /// `sizes`: of the inputs in the blocks before this one; `largest`: over all blocks.
  Block(const GainBounds& gains, const LoopDisturbance& disturbance, std::size_t block,
        const std::vector<Numbers>& sizes, const Numbers& largest)
      : gains_(&gains), disturbance_(&disturbance), known_(gains.start_of_block(disturbance, block)) {
    const std::vector<NetworkInput>& inputs = gains.network_.inputs;
    const Numbers now = gains.sizes(disturbance, Numbers(known_.size(), 0.0));
    now_.resize(known_.size());
    for (std::size_t f = 0; f < known_.size(); ++f) {
      for (std::size_t l = 0; l < inputs.size(); ++l) {
        if (inputs[l].cause != Cause::remainder) {
          known_[f] = plus(known_[f], gains.total_[f][l], now[l]);
        } else {
          const linear::InputGain& gain = gains.gains_.inputs[f][l];
          known_[f] = plus(known_[f], gain.missed, largest[l]);
          add_remainder(f, l, block, sizes);
        }
      }
    }
  }

  /// The right side at these bounds of the forms.
  [[nodiscard]] Numbers at(const Numbers& bounds) const {
    const Numbers size = gains_->sizes(*disturbance_, bounds);
    Numbers result = known_;
    for (std::size_t f = 0; f < result.size(); ++f) {
      for (const DirectTerm& term : gains_->network_.direct[f]) {
        if (gains_->network_.inputs[term.input].cause == Cause::remainder) {
          result[f] = plus(result[f], term.weight, size[term.input]);
        }
      }
      for (const Lag& lag : now_[f]) {
        result[f] = plus(result[f], lag.gain, std::max(lag.before, size[lag.input]));
      }
    }
    return result;
  }

  /// Bounds that contain their own right side, from below.
  [[nodiscard]] std::optional<Numbers> solved(const search::Deadline& deadline) const {
    constexpr int kRounds = 5000;
    constexpr double kStep = 1.0 + 0x1p-20;
    Numbers bounds = at(Numbers(known_.size(), 0.0));
    for (int round = 0; round < kRounds; ++round) {
      const Numbers next = at(bounds);
      if (!gains_->keeps_limits(bounds) || deadline.is_over()) {
        return std::nullopt;
      }
      if (is_at_most(next, bounds)) {
        return bounds;
      }
      for (std::size_t f = 0; f < bounds.size(); ++f) {
        bounds[f] = next[f] <= bounds[f] ? bounds[f] : rigor::mul_up(next[f], kStep);
      }
    }
    return std::nullopt;
  }

 private:
  /// A gain from inputs of this block, or from those of an earlier one where they are larger.
  struct Lag {
    std::size_t input = 0;
    double gain = 0.0;
    double before = 0.0;
  };

  void add_remainder(std::size_t f, std::size_t l, std::size_t block, const std::vector<Numbers>& sizes) {
    const Numbers& gain = gains_->gains_.inputs[f][l].blocks;
    const bool is_last = block == gain.size();
    const auto size_in = [&](std::size_t number) { return sizes[number][l]; };
    double later = 0.0;  // the largest size from block - p - 1 on
    for (std::size_t p = 0; p < gain.size() && (is_last || p <= block); ++p) {
      if (is_last) {
        if (p < block) {
          later = std::max(later, size_in(block - p - 1));
        }
        now_[f].push_back({l, gain[p], later});
        continue;
      }
      double before = p < block ? size_in(block - p - 1) : 0.0;
      if (p == 0) {
        now_[f].push_back({l, gain[p], before});
      } else {
        before = std::max(before, size_in(block - p));
        known_[f] = plus(known_[f], gain[p], before);
      }
    }
  }

  const GainBounds* gains_;
  const LoopDisturbance* disturbance_;
  Numbers known_;
  std::vector<std::vector<Lag>> now_;  // by form
};

GainBounds::GainBounds(LoopNetwork network, linear::WorstCaseGains gains, std::size_t samples,
                       std::size_t blocks)
    : network_(std::move(network)), gains_(std::move(gains)), samples_(samples), blocks_(blocks) {
  for (std::size_t f = 0; f < network_.forms.size(); ++f) {
    total_.emplace_back();
    for (const linear::InputGain& gain : gains_.inputs[f]) {
      total_.back().push_back(gain.total());
    }
    for (const DirectTerm& term : network_.direct[f]) {
      total_.back()[term.input] = rigor::add_up(total_.back()[term.input], term.weight);
    }
  }
}

std::optional<GainBounds> GainBounds::make(LoopNetwork network, std::size_t samples, std::size_t blocks) {
  std::optional<linear::WorstCaseGains> gains =
      linear::worst_case_gains(network.a, network.columns, network.forms, samples, blocks);
  if (!gains || !rigor::is_finite(network.bias)) {
    return std::nullopt;
  }
  return GainBounds(std::move(network), std::move(*gains), samples, blocks);
}

Numbers GainBounds::sizes(const LoopDisturbance& disturbance, const Bounds& bounds) const {
  // A sample of at most the amplitude and the noise that is turned is off by up to the angle times its
  // length.
  const double length = rigor::add_up(network_.largest_amplitude, disturbance.noise);
  const double noise = rigor::add_up(disturbance.noise, rigor::mul_up(network_.turned, length));
  Numbers sizes;
  for (const NetworkInput& input : network_.inputs) {
    sizes.push_back(input.size(noise, disturbance.slew, bounds));
  }
  return sizes;
}

bool GainBounds::keeps_limits(const Bounds& bounds) const {
  return std::all_of(network_.limits.begin(), network_.limits.end(),
                     [&](const auto& limit) { return bounds[limit.first] < limit.second; }) &&
         std::all_of(bounds.begin(), bounds.end(), [](double bound) { return std::isfinite(bound); });
}

Numbers GainBounds::start_of_block(const LoopDisturbance& disturbance, std::size_t block) const {
  Numbers off = disturbance.start;
  off.resize(network_.a.size(), 0.0);
  for (std::size_t j = 0; j < network_.ripple_at_start.size(); ++j) {
    off[j] = rigor::add_up(off[j], network_.ripple_at_start[j]);
  }
  Numbers start = network_.ripple;
  for (std::size_t f = 0; f < start.size(); ++f) {
    for (std::size_t j = 0; j < off.size(); ++j) {
      const linear::StartGain& gain = gains_.starts[f][j];
      start[f] = plus(start[f], block < blocks_ ? gain.blocks[block] : gain.later, off[j]);
    }
  }
  return start;
}

std::optional<std::vector<Numbers>> GainBounds::sequence(const LoopDisturbance& disturbance,
                                                         const search::Deadline& deadline) const {
  constexpr int kRounds = 20;
  constexpr double kRoom = 1.0 + 0x1p-10;
  Numbers largest(network_.inputs.size(), 0.0);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Numbers> bounds;
    std::vector<Numbers> sizes;
    Numbers found(largest.size(), 0.0);
    for (std::size_t block = 0; block <= blocks_; ++block) {
      const std::optional<Numbers> solved = Block(*this, disturbance, block, sizes, largest).solved(deadline);
      if (!solved) {
        return std::nullopt;
      }
      bounds.push_back(*solved);
      sizes.push_back(this->sizes(disturbance, *solved));
      for (std::size_t l = 0; l < found.size(); ++l) {
        found[l] = std::max(found[l], sizes.back()[l]);
      }
    }
    if (is_at_most(found, largest)) {
      return bounds;
    }
    for (std::size_t l = 0; l < found.size(); ++l) {
      largest[l] = rigor::mul_up(found[l], kRoom);
    }
  }
  return std::nullopt;
}

Numbers GainBounds::in_the_long_run(const LoopDisturbance& disturbance, Bounds bounds) const {
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    const Numbers size = sizes(disturbance, bounds);
    for (std::size_t f = 0; f < bounds.size(); ++f) {
      double sum = network_.ripple[f];
      for (std::size_t l = 0; l < size.size(); ++l) {
        sum = plus(sum, total_[f][l], size[l]);
      }
      bounds[f] = std::min(bounds[f], sum);
    }
  }
  return bounds;
}

double GainBounds::linear_error(double noise, double slew) const {
  const Numbers size = sizes({noise, slew, {}}, Numbers(network_.forms.size(), 0.0));
  double sum = rigor::add_up(rigor::magnitude(network_.bias), network_.ripple.back());
  for (std::size_t l = 0; l < size.size(); ++l) {
    if (network_.inputs[l].cause != Cause::remainder) {
      sum = plus(sum, total_.back()[l], size[l]);
    }
  }
  return sum;
}

double GainBounds::residual_error() const {
  const Numbers size = sizes({}, Numbers(network_.forms.size(), 0.0));
  double sum = 0.0;
  for (std::size_t l = 0; l < size.size(); ++l) {
    if (network_.inputs[l].cause == Cause::residual) {
      sum = plus(sum, total_.back()[l], size[l]);
    }
  }
  return sum;
}

bool GainBounds::acts(std::string_view operation, double noise) const {
  const LoopDisturbance disturbance{noise, 0.0, {}};
  Numbers bounds = network_.ripple;
  const Numbers given = sizes(disturbance, Numbers(bounds.size(), 0.0));
  for (std::size_t f = 0; f < bounds.size(); ++f) {
    for (std::size_t l = 0; l < given.size(); ++l) {
      const bool is_remainder = network_.inputs[l].cause == Cause::remainder;
      bounds[f] = is_remainder ? bounds[f] : plus(bounds[f], total_[f][l], given[l]);
    }
  }
  const Numbers size = sizes(disturbance, bounds);
  for (std::size_t l = 0; l < size.size(); ++l) {
    if (network_.inputs[l].what == operation && size[l] > 0.0) {
      return true;
    }
  }
  return false;
}

std::optional<LoopBounds> GainBounds::bounds(const LoopDisturbance& disturbance,
                                             const search::Deadline& deadline) const {
  const bool is_covered =
      (!network_.has_ripples || !(disturbance.slew > 0.0)) && disturbance.noise <= network_.most_noise;
  const std::optional<std::vector<Numbers>> sequence =
      is_covered ? this->sequence(disturbance, deadline) : std::nullopt;
  if (!sequence) {
    return std::nullopt;
  }
  LoopBounds result;
  // The frequency that the program reports is off by its own rounding.
  const double bias = rigor::add_up(rigor::magnitude(network_.bias), network_.rounding_of_frequency);
  result.from_block.resize(sequence->size());
  for (std::size_t block = sequence->size(); block-- > 0;) {
    const double error = rigor::add_up((*sequence)[block].back(), bias);
    result.from_block[block] =
        block + 1 < sequence->size() ? std::max(error, result.from_block[block + 1]) : error;
  }
  result.for_ever = result.from_block.front();
  const Numbers settled = in_the_long_run(disturbance, sequence->back());
  result.long_run = rigor::add_up(settled.back(), bias);
  // Each part that turns with the signal has the mean 0, but for the share by which the error of its angle
  // changes it.
  result.mean = rigor::add_up(settled.back(), network_.rounding_of_frequency);
  for (const LoopNetwork::TurningPart& part : network_.turning) {
    const double share = std::min(1.0, settled[part.angle]);
    result.mean = rigor::add_up(rigor::sub_up(result.mean, part.error), rigor::mul_up(part.error, share));
  }
  const Numbers size = sizes(disturbance, settled);
  result.budget.steady_state = rigor::magnitude(network_.bias);
  result.budget.rounding = network_.rounding_of_frequency;
  result.budget.ripple = network_.ripple.back();
  for (std::size_t l = 0; l < size.size(); ++l) {
    const Cause cause = network_.inputs[l].cause;
    double& part = cause == Cause::noise       ? result.budget.noise
                   : cause == Cause::slew      ? result.budget.slew
                   : cause == Cause::remainder ? result.budget.remainders
                   : cause == Cause::rounding  ? result.budget.rounding
                                               : result.budget.steady_state;
    part = plus(part, total_.back()[l], size[l]);
    if (cause == Cause::rounding) {
      result.rounding_gains.push_back(total_.back()[l]);
    }
  }
  for (const std::size_t form : network_.state_forms) {
    double most = 0.0;
    for (const Numbers& of_block : *sequence) {
      most = std::max(most, of_block[form]);
    }
    result.states.push_back(most);
  }
  return result;
}

}  // namespace veritrack::model

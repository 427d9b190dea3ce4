#include "checker/model/gain/gain_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checker/model/gain/gain_rounding.hpp"
#include "checker/model/gain/loop_bounds.hpp"

namespace veritrack::checker {

namespace {

constexpr int kMostRounds = 3000;

}  // namespace

Ball GainErrors::from_block(std::size_t block) const {
  const auto first = by_block_.begin() + static_cast<std::ptrdiff_t>(block);
  return Ball(*std::max_element(first, by_block_.end())) + Ball(bias_);  // all are finite
}

Ball GainErrors::from(const Ball& sample) const {
  const double whole = std::floor(sample.lower_double() / static_cast<double>(block_length_));
  const double last = static_cast<double>(by_block_.size() - 1);
  return from_block(whole >= last  ? by_block_.size() - 1
                    : whole >= 1.0 ? static_cast<std::size_t>(whole)
                                   : 0);
}

GainBounds::Given GainBounds::given(const Ball& noise, const Ball& slew,
                                    const std::vector<Ball>& start) const {
  Given result;
  std::vector<Ball> without_ripples = start;
  for (const GainRipple& ripple : network_->ripples) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      without_ripples[i] += ripple.of_state[i];
    }
  }
  for (std::size_t i = 0; i < network_->rounding_of_start.size(); ++i) {
    without_ripples[i] += network_->rounding_of_start[i];
  }
  const std::optional<Table> of_start = kernels_.starts(without_ripples);
  if (!of_start) {
    result.is_known = false;
    return result;
  }
  result.start = *of_start;
  for (std::size_t form = 0; form < network_->forms.size(); ++form) {
    double sum = 0.0;
    for (const GainRipple& ripple : network_->ripples) {
      sum += upper(ripple.of_form[form]);
    }
    for (std::size_t input = 0; input < network_->inputs.size(); ++input) {
      const GainInput& entry = network_->inputs[input];
      if (!entry.is_remainder()) {
        sum +=
            upward_product(kernels_.total(form, input), upper(entry.size(network_->with_turns(noise), slew)));
      }
    }
    result.outside.push_back(up(sum));
  }
  return result;
}

std::vector<double> GainBounds::sizes(const std::vector<double>& bounds) const {
  std::vector<double> result(network_->inputs.size(), 0.0);
  for (std::size_t input = 0; input < network_->inputs.size(); ++input) {
    const GainInput& entry = network_->inputs[input];
    if (entry.is_remainder()) {
      std::vector<Ball> about;
      for (const std::size_t form : entry.about) {
        about.emplace_back(bounds[form]);
      }
      result[input] = upper(entry.at_bounds(about));
    }
  }
  return result;
}

Table GainBounds::next(const Table& bounds, const Given& given) const {
  const std::size_t blocks = kernels_.blocks();
  const std::size_t forms = network_->forms.size();
  Table z;  // by block and input
  for (const std::vector<double>& of_block : bounds) {
    z.push_back(sizes(of_block));
  }
  Table result(blocks + 1, std::vector<double>(forms));
  for (std::size_t form = 0; form < forms; ++form) {
    for (std::size_t m = 0; m <= blocks; ++m) {
      result[m][form] = given.start[form][m] + given.outside[form];
    }
  }
  for (std::size_t input = 0; input < network_->inputs.size(); ++input) {
    if (!network_->inputs[input].is_remainder()) {
      continue;
    }
    // The largest from each block on.
    std::vector<double> later(blocks + 1);
    for (std::size_t m = blocks + 1; m-- > 0;) {
      later[m] = m == blocks ? z[m][input] : std::max(z[m][input], later[m + 1]);
    }
    std::vector<double> pair(blocks);  // of a block and the one before
    for (std::size_t m = 0; m < blocks; ++m) {
      pair[m] = m == 0 ? z[0][input] : std::max(z[m - 1][input], z[m][input]);
    }
    spend(static_cast<std::int64_t>(forms * blocks * blocks / 8));
    for (std::size_t form = 0; form < forms; ++form) {
      const std::vector<double>& kernel = kernels_.by_block(form, input);
      const double tail = upward_product(kernels_.tail(form, input), later[0]);
      for (std::size_t m = 0; m < blocks; ++m) {
        double sum = upward_product(kernels_.direct(form, input), z[m][input]) + tail;
        for (std::size_t p = 0; p <= m; ++p) {
          sum += upward_product(kernel[p], pair[m - p]);
        }
        result[m][form] += sum;
      }
      double sum = upward_product(kernels_.direct(form, input), z[blocks][input]) + tail;
      for (std::size_t p = 0; p < blocks; ++p) {
        sum += upward_product(kernel[p], later[blocks - p - 1]);
      }
      result[blocks][form] += sum;
    }
  }
  for (std::vector<double>& of_block : result) {
    for (double& bound : of_block) {
      bound = up(bound);
    }
  }
  return result;
}

bool GainBounds::keeps_limits(const std::vector<double>& bounds) const {
  return std::all_of(network_->limits.begin(), network_->limits.end(), [&](const GainLimit& limit) {
    const Ball value = limit.base + Ball::within(Ball(bounds[limit.form]));
    return certainly_less(limit.low, value) && certainly_less(value, limit.high);
  });
}

std::vector<double> GainBounds::in_long_run(std::vector<double> bounds, const Given& given) const {
  Table totals(bounds.size(), std::vector<double>(network_->inputs.size()));
  for (std::size_t form = 0; form < bounds.size(); ++form) {
    for (std::size_t input = 0; input < network_->inputs.size(); ++input) {
      totals[form][input] = kernels_.total(form, input);
    }
  }
  for (int round = 0; round < kMostRounds; ++round) {
    spend(static_cast<std::int64_t>(bounds.size() * network_->inputs.size() / 8));
    const std::vector<double> z = sizes(bounds);
    bool changes = false;
    std::vector<double> next = bounds;
    for (std::size_t form = 0; form < bounds.size(); ++form) {
      double sum = given.outside[form];
      for (std::size_t input = 0; input < network_->inputs.size(); ++input) {
        if (network_->inputs[input].is_remainder()) {
          sum += upward_product(totals[form][input], z[input]);
        }
      }
      changes = changes || up(sum) * kGrowth < bounds[form];
      next[form] = up(sum) < bounds[form] ? up(sum) : bounds[form];
    }
    bounds = std::move(next);
    if (!changes) {
      break;
    }
  }
  return bounds;
}

Ball GainBounds::mean(const std::vector<double>& bounds) const {
  // The response c Pi e^(jt phi) z has no mean where z does not change; |z - size e^(j constant)| is at most
  // the size of the angle's deviation, and the mean at most the size of z.
  Ball result(bounds[network_->error_form]);
  for (const GainRipple& ripple : network_->ripples) {
    const Ball& most = ripple.of_form[network_->error_form];
    result -= most * (one - min(one, Ball(bounds[ripple.angle_form])));
  }
  return result;
}

bool GainBounds::is_about_steady_state() const {
  double sum = 0.0;
  for (std::size_t input = 0; input < network_->inputs.size(); ++input) {
    if (network_->inputs[input].is_residual) {
      sum += upward_product(kernels_.total(network_->error_form, input),
                            upper(network_->inputs[input].size(zero, zero)));
    }
  }
  return up(sum) <= kMostOfResidual;
}

std::optional<GainErrors> GainBounds::errors(const Ball& noise, const Ball& slew,
                                             const std::vector<Ball>& start) const {
  if (!is_certain() || start.size() != network_->states() || !certainly_not_negative(noise) ||
      !certainly_not_negative(slew) || (!network_->ripples.empty() && !certainly_equal(slew, zero)) ||
      !certainly_less(network_->with_turns(noise), network_->least_amplitude) ||
      (network_->is_rounded &&
       !certainly_at_most(noise, Ball(kMostRoundedNoise) * network_->least_amplitude))) {
    return std::nullopt;
  }
  const std::size_t blocks = kernels_.blocks();
  const Given known = given(noise, slew, start);
  if (!known.is_known) {
    return std::nullopt;
  }
  Table bounds(blocks + 1, std::vector<double>(network_->forms.size(), 0.0));
  for (int round = 0; round < kMostRounds; ++round) {
    const Table above = next(bounds, known);
    if (!std::all_of(bounds.begin(), bounds.end(), [&](const auto& each) { return keeps_limits(each); })) {
      return std::nullopt;
    }
    bool is_kept = true;
    Table raised = bounds;
    for (std::size_t m = 0; m <= blocks; ++m) {
      for (std::size_t form = 0; form < above[m].size(); ++form) {
        if (!std::isfinite(above[m][form])) {
          return std::nullopt;
        }
        is_kept = is_kept && above[m][form] <= bounds[m][form];
        raised[m][form] = std::max(bounds[m][form], above[m][form] * kGrowth);
      }
    }
    if (is_kept) {
      const Ball& rounding = network_->rounding_of_frequency;
      std::vector<double> error;
      for (const std::vector<double>& of_block : bounds) {
        error.push_back(upper(Ball(of_block[network_->error_form]) + rounding));
      }
      const std::vector<double> late = in_long_run(bounds.back(), known);
      return GainErrors(error, upper(Ball(late[network_->error_form]) + rounding), mean(late) + rounding,
                        upper(abs(network_->bias)), kernels_.block_length());
    }
    bounds = std::move(raised);
  }
  return std::nullopt;
}

}  // namespace veritrack::checker

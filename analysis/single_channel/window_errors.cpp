#include "analysis/single_channel/window_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::single_channel {

using rigor::Interval;

WindowErrors::WindowErrors(const trackers::ToneModel<Interval>& design, const WindowClaim& claim,
                           const Interval& noise, const Interval& slew)
    : radius_(claim.assumption.radius) {
  const Interval zero(0.0);
  const Interval one(1.0);
  const StepRounding& rounding = claim.assumption.rounding;
  error_rounding_ = Interval(rounding.error);
  const Interval growth = one / sqrt(one - Interval(rounding.covariance));
  growth_.reserve(claim.shares.size() + 1);
  growth_.push_back(one);
  shrinkage_.reserve(claim.shares.size() + 1);
  shrinkage_.push_back(one);
  for (const double share : claim.shares) {
    growth_.push_back(growth_.back() * growth);
    shrinkage_.push_back(growth_.back() * sqrt(max(one - Interval(share), zero)));
  }
  // |delta nu + i nu^2 / 2| is less than the exact term by at most |nu|^3 / 6, |nu| <= R sqrt(P33).
  const Interval variance(claim.assumption.frequency_variance);
  const Interval cubic = radius_ * variance * sqrt(variance) / Interval(6.0);
  curvature_ = growth * (Interval(claim.curvature) + cubic) / sqrt(Interval(claim.signal_uncertainty));
  input_ = sqrt(square(noise) / design.r + square(slew) / design.q2);
}

Interval WindowErrors::factor(const Interval& level) const {
  Interval sum(0.0);
  for (std::size_t m = 0; m + 1 < shrinkage_.size(); ++m) {
    sum += shrinkage_[m];
  }
  return shrinkage_.back() + curvature_ * sum * level;
}

Interval WindowErrors::pushed_by_rounding(std::size_t samples) const {
  Interval sum(0.0);
  for (std::size_t j = 0; j < samples; ++j) {
    sum += shrinkage_[j];
  }
  return error_rounding_ * sum;
}

Interval WindowErrors::pushed(std::size_t samples) const {
  return growth_[samples] * sqrt(Interval(static_cast<int>(samples))) * input_ + pushed_by_rounding(samples);
}

Interval WindowErrors::after_window(const Interval& level) const {
  return factor(level) * level + pushed(growth_.size() - 1);
}

bool WindowErrors::keeps(double level) const {
  return certainly_less_equal(after_window(Interval(level)), Interval(level));
}

bool WindowErrors::keeps_radius() const {
  return keeps(radius_.upper());
}

Interval WindowErrors::rate() const {
  return exp(log(factor(radius_)) / Interval(window()));
}

Interval WindowErrors::largest_input() const {
  const Interval rounding = pushed_by_rounding(growth_.size() - 1);
  return (radius_ * (Interval(1.0) - factor(radius_)) - rounding) /
         (growth_.back() * sqrt(Interval(window())));
}

/// The bound on the level after `levels`, from the longest window that they allow.
double WindowErrors::next(const std::vector<double>& levels) const {
  const std::size_t m = std::min(levels.size(), shrinkage_.size() - 1);
  const std::size_t first = levels.size() - m;
  Interval sum(0.0);
  for (std::size_t j = 0; j < m; ++j) {
    sum += shrinkage_[m - 1 - j] * square(Interval(levels[first + j]));
  }
  return (shrinkage_[m] * Interval(levels[first]) + curvature_ * sum + pushed(m)).upper();
}

/// Whether the last levels are the same over more than a window: all that follow are the same, too.
bool WindowErrors::is_constant(const std::vector<double>& levels) const {
  const std::size_t run = shrinkage_.size();
  return levels.size() >= run && std::all_of(levels.end() - static_cast<std::ptrdiff_t>(run), levels.end(),
                                             [&](double level) { return level == levels.back(); });
}

std::optional<std::vector<double>> WindowErrors::levels(double start, int samples) const {
  std::vector<double> levels;
  levels.reserve(static_cast<std::size_t>(samples) + 1);
  levels.push_back(start);
  for (int k = 0; k < samples && !is_constant(levels); ++k) {
    levels.push_back(next(levels));
  }
  levels.resize(static_cast<std::size_t>(samples) + 1, levels.back());
  const bool inside = std::all_of(levels.begin(), levels.end(), [&](double level) {
    return certainly_less_equal(Interval(level), radius_);
  });
  return inside ? std::optional(levels) : std::nullopt;
}

double WindowErrors::ultimate() const {
  constexpr int kSamples = 4000;
  std::vector<double> levels(static_cast<std::size_t>(window()), radius_.upper());
  levels.reserve(levels.size() + kSamples);
  for (int k = 0; k < kSamples && !is_constant(levels); ++k) {
    levels.push_back(std::min(next(levels), levels.back()));
  }
  return levels.back();
}

}  // namespace veritrack::single_channel

#include "checker/model/gaussian_drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "checker/model/filter_step.hpp"
#include "checker/model/tube_check.hpp"
#include "checker/model/tube_cover.hpp"

namespace veritrack::checker {

namespace {

/// Levels over R between which the inequality is shown.
constexpr std::array<double, 18> kLevels{0.0,     0.125, 0.1875, 0.25,  0.28125, 0.3125,
                                         0.34375, 0.375, 0.4375, 0.5,   0.5625,  0.625,
                                         0.6875,  0.75,  0.8125, 0.875, 0.9375,  1.0};

/// The inequality over a part of a tube. Everything is relative to R.
///
/// With |F|/R <= |N xi + B u| + r + q |u|, u = v/V, and any positive a and b,
///   L |F|^2/R^2 <= L (1 + a) |N xi + B u|^2 + L (1 + 1/a) ((1 + b) r^2 + (1 + 1/b) q^2 |u|^2),
/// a quadratic form in u, whose exponential has a known expectation.
class Drift {
 public:
  Drift(const LengthBound& step, double radius, const GaussianTerms& terms, std::size_t channels)
      : step_(&step),
        unit_(one / Ball(radius)),
        exponent_(terms.exponent),
        factor_(terms.factor),
        constant_(terms.constant),
        twice_variance_(two * square(Ball(terms.deviation) / Ball(terms.most_noise))),
        half_channels_(half * Ball(static_cast<double>(channels))),
        scale_((unit_ * unit_).upper_double()) {
    // |B|^2 is a little more than at the middle, where it may vanish.
    const double near = step.linear().near_sum(0.0, scale_);
    for (const double tried : {1.02 * near, 1.1 * near, 1.3 * near, 2.0 * near, near + 1e-6, near + 1e-5,
                               near + 1e-4, near + 1e-3, near + 1e-2, near + 0.1, near + 1.0}) {
      if (!gain_ && step.linear().sum_is_at_most(tried, 0.0, scale_)) {
        gain_ = Ball(tried);
      }
    }
  }

  /// For all levels between low R and high R.
  [[nodiscard]] bool holds(double low, double high) const {
    if (!gain_) {
      return false;
    }
    // r over the level falls and then rises: its greatest value is at an end.
    Ball rest = Ball(step_->without_noise(high)) * unit_;
    if (low > 0.0) {
      rest = max(rest / Ball(high), Ball(step_->without_noise(low)) * unit_ / Ball(low));
    }
    const Ball with_noise = Ball(step_->with_noise(high)) * unit_;
    const double r = rest.upper_double();
    const double q = with_noise.upper_double() * std::sqrt(twice_variance_.near());
    if (!std::isfinite(r) || !std::isfinite(q)) {
      return false;
    }
    const double b = std::clamp(q / (r + 1e-12), 1e-3, 1e3);
    std::optional<Demand> best;
    for (const double multiple : {0.2, 0.45, 0.9, 1.6, 3.0}) {
      for (const double least : {1e-4, 0.02}) {
        const double a = std::max(least, multiple * (r + q));
        const std::optional<Demand> demand = demand_for(a, b, low, high, rest, with_noise);
        if (demand && (!best || demand->room > best->room)) {
          best = demand;
        }
      }
    }
    return best && step_->linear().sum_is_at_most(best->most, scale_, best->of_noise);
  }

 private:
  /// N N' + w m B B' <= m I is enough, with m = most and w m (over R^2) = of_noise.
  struct Demand {
    double most = 0.0;
    double of_noise = 0.0;
    double room = 0.0;  ///< about; not evidence
  };

  [[nodiscard]] std::optional<Demand> demand_for(double a, double b, double low, double high,
                                                 const Ball& rest, const Ball& with_noise) const {
    const Ball more = one + Ball(a);
    const Ball of_rest = exponent_ * (one + one / Ball(a));
    const Ball left = one - twice_variance_ * of_rest * (one + one / Ball(b)) * square(with_noise);
    const Ball pivot = left - twice_variance_ * exponent_ * more * *gain_;
    if (!certainly_positive(pivot)) {
      return std::nullopt;
    }
    // Minus the logarithm of the root of the determinant, and what kappa W + c_0 has above W.
    const Ball spread = -(half_channels_ * log(pivot));
    const Ball at_high = exponent_ * square(Ball(high));
    const Ball gained = log(factor_ + constant_ * exp(-at_high)) - spread;
    const Ball lost = of_rest * (one + Ball(b)) * square(rest);
    Ball most = one;
    if (low > 0.0) {
      const Ball at_low = exponent_ * square(Ball(low));
      most = one + min(gained / at_high, gained / at_low) - lost / exponent_;
    } else if (!certainly_at_most(lost, gained)) {
      return std::nullopt;
    }
    Demand demand;
    // A little less, so that all of N N' + ... < m I.
    constexpr double kLess = 1.0 - 0x1p-40;
    demand.most = (most / more).lower_double() * kLess;
    const Ball weight = twice_variance_ * exponent_ * more / left;
    demand.of_noise = (weight * Ball(demand.most) * unit_ * unit_).upper_double();
    if (!(demand.most > 0.0) || !std::isfinite(demand.of_noise) || !(demand.of_noise >= 0.0)) {
      return std::nullopt;
    }
    demand.room = 1.0 - step_->linear().near_sum(scale_, demand.of_noise) / demand.most;
    return demand;
  }

  const LengthBound* step_;
  Ball unit_, exponent_, factor_, constant_, twice_variance_, half_channels_;
  double scale_;  ///< 1/R^2, or more
  std::optional<Ball> gain_;
};

}  // namespace

bool drift_is_bounded(const LengthBound& step, double radius, const GaussianTerms& terms,
                      std::size_t channels) {
  const Drift drift(step, radius, terms, channels);
  for (std::size_t i = kLevels.size() - 1; i > 0; --i) {
    if (!drift.holds(kLevels.at(i - 1), kLevels.at(i))) {
      return false;
    }
  }
  return true;
}

bool is_seldom_left(const TrackedModel& model, const TubeSet& set, std::int64_t& cells,
                    Objections& objections) {
  if (!set.gaussian || set.tubes.empty()) {
    objections.emplace_back("no tubes for Gaussian noise");
    return false;
  }
  if (model.amplitude_varies) {
    objections.emplace_back("in Gaussian noise the amplitude must be one number");
    return false;
  }
  const GaussianTerms& terms = *set.gaussian;
  const bool is_filter = bounds_covariance(set);
  if (is_filter && !bounds_suit(*model.recursion)) {
    objections.emplace_back("bounds of a covariance are for filters with a linear measurement");
    return false;
  }
  const VectorMonomials monomials(is_filter ? model.recursion->filtered() : model.recursion->states(),
                                  model.recursion->samples());
  const double share = terms.deviation / terms.most_noise;
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& only) {
    const PhaseTube& tube = set.tubes[number];
    const double radius = tube.levels.front();
    PartAnswer answer;
    const auto decide = [&](const std::vector<BallPolynomial>& map) {
      const LengthBound bound(map);
      if (!drift_is_bounded(bound, radius, terms, model.recursion->samples())) {
        answer.open = only;
      }
      answer.halve_frequencies = bound.by_frequency() > bound.by_phase();
    };
    const auto ask_step = [&](const auto& step, const auto& map) {
      if (step.has_shape()) {
        decide(map());
      } else {
        answer.open = only;
      }
    };
    if (!is_filter) {
      const TubeStep step(model, tube, part, monomials);
      ask_step(step, [&] { return step.map(radius, terms.most_noise); });
      return answer;
    }
    // The step of the estimate is affine in v, and its covariance does not depend on v.
    const FilterStep step(model, tube, part, monomials);
    ask_step(step, [&] { return step.map(radius, terms.most_noise, 2.0 * terms.exponent * share * share); });
    if (answer.open.empty() && !step.keeps_covariance(radius)) {
      answer.open = only;
    }
    return answer;
  };
  std::vector<FirstGrid> grids;
  grids.reserve(set.tubes.size());
  for (const PhaseTube& tube : set.tubes) {
    grids.push_back({tube.phases, tube.frequencies, 1});
  }
  if (!has_known_angles(model, set, objections)) {
    return false;
  }
  if (!certain_everywhere(grids, ask, cells)) {
    objections.emplace_back("in the noise that is said a tube may be left more often");
    return false;
  }
  return true;
}

Ball leaving_probability(const GaussianTerms& terms, std::size_t channels, const Ball& samples,
                         const Ball& start_share) {
  const Ball count(static_cast<double>(channels));
  const Ball squared = square(Ball(terms.most_noise) / Ball(terms.deviation));
  // From the expectation of exp(s |v|^2), which is at most (1 - 2 sigma^2 s)^(-channels/2), with the best s.
  const Ball longer =
      certainly_less(count, squared) ? exp(half * (count * (log(squared / count) + one) - squared)) : one;
  const Ball exponent(terms.exponent);
  const Ball rarely = exp(-exponent);
  const Ball constant(terms.constant);
  return exp(exponent * (square(start_share) - one)) +
         (constant * rarely + longer) / (one - Ball(terms.factor)) + samples * (constant * rarely + longer);
}

}  // namespace veritrack::checker

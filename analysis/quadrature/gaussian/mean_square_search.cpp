#include "analysis/quadrature/gaussian/mean_square_search.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "analysis/quadrature/gaussian/leaking_filter.hpp"
#include "analysis/quadrature/gaussian/linear_filter.hpp"
#include "analysis/quadrature/gaussian/lock_samples.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximin.hpp"

namespace veritrack::quadrature {

namespace {

/// Six numbers: logarithms of the entries of a factor but the coupling, of g and of beta, in units in which
/// the linear filter has 1. With a leak three more: how much of what the bias adds to later squares is in the
/// form, of each error.
constexpr Eigen::Index kFormParameters = 6;
constexpr Eigen::Index kWithLeak = 9;

/// The linear filter: what a form for it needs, and begins with.
struct Linear {
  double mean_square;     ///< of its frequency error, the bias included
  double variance;        ///< without the bias
  Eigen::Matrix3d later;  ///< e'Ne is about the sum of all later squares of nu
  Eigen::Vector3d along;  ///< what the bias adds to that sum is twice this times e
};

class Forms {
 public:
  Forms(const Linear& linear, bool leaks) : linear_(linear), leaks_(leaks) {
    constexpr double kRate = 0.01;
    constexpr double kAmplitudeShare = 0.1;
    const Eigen::Matrix3d& later = linear.later;
    rate_ = kRate / linear.mean_square;
    phase_ = std::sqrt(later(1, 1));
    coupling_ = later(1, 2) / phase_;
    frequency_ = std::sqrt(later(2, 2) - coupling_ * coupling_);
    amplitude_ = std::sqrt(kAmplitudeShare * later(2, 2));
  }

  [[nodiscard]] search::SearchSpace space(int evaluations) const {
    const Eigen::Index n = leaks_ ? kWithLeak : kFormParameters;
    search::SearchSpace space{Eigen::VectorXd(n), Eigen::VectorXd::Constant(n, 0.1), Eigen::VectorXd(n),
                              Eigen::VectorXd(n), evaluations};
    space.start.head(kFormParameters) << 0.35, 0.4, 0.6, 0.4, 4.5, -2.5;
    space.lower.head(kFormParameters) << -0.2, -0.2, -1.0, -0.2, 2.0, -9.0;
    space.upper.head(kFormParameters) << 3.0, 3.0, 3.0, 3.0, 8.0, 1.0;
    if (leaks_) {
      space.lower[4] = -2.0;
      space.upper[4] = 14.0;
      space.lower[5] = -14.0;
      space.upper[5] = 8.0;
      // So that h is at most the square of the frequency's entry.
      space.lower[3] = 0.001 - std::log(frequency_);
      space.start.tail(3).setConstant(1.0);
      space.lower.tail(3).setConstant(-1.0);
      space.upper.tail(3).setConstant(3.0);
    }
    return space;
  }

  [[nodiscard]] LockMeanSquare form(const Eigen::VectorXd& x) const {
    const double root = std::sqrt(rate_);
    LockMeanSquare form;
    form.metric = {root * std::exp(x[0]) * amplitude_, root * std::exp(x[1]) * phase_,
                   root * (std::exp(x[1]) * coupling_ + x[2] * frequency_),
                   root * std::exp(x[3]) * frequency_};
    form.weight = rate_ * linear_.variance * std::exp(x[4]);
    form.share = rate_ * linear_.variance * std::exp(x[5]);
    form.rate = rate_;
    if (leaks_) {
      // |R (e - f)|^2 = |R e|^2 - 2 f'R'R e + ...
      const auto& r = form.metric;
      Eigen::Matrix3d factor;
      factor << r.amplitude, 0.0, 0.0, 0.0, r.phase, r.coupling, 0.0, 0.0, r.frequency;
      const Eigen::Vector3d along = rate_ * linear_.along.cwiseProduct(x.tail(3));
      const Eigen::Vector3d offset = -(factor.transpose() * factor).llt().solve(along);
      std::copy(offset.begin(), offset.end(), form.offset.begin());
    }
    return form;
  }

 private:
  Linear linear_;
  bool leaks_;
  double rate_;
  double amplitude_, phase_, coupling_, frequency_;
};

std::optional<Linear> linear_of(const trackers::ToneModel<double>& design, const LockSet& set) {
  if (design.epsilon != 0.0) {
    const auto filter = leaking_filter(design, 0.5 * (set.lowest_frequency + set.highest_frequency));
    const auto square = filter ? mean_square_frequency_error(*filter, set.noise_deviation) : std::nullopt;
    if (!square) {
      return std::nullopt;
    }
    const double bias = filter->steady.errors[2];
    return Linear{*square, *square - bias * bias, filter->later, bias * filter->later_sum};
  }
  const auto filter = linear_filter(design, set.centre);
  if (!filter) {
    return std::nullopt;
  }
  const double variance = frequency_variance(*filter, set.noise_deviation, set.frequency_walk);
  Linear linear{variance, variance, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()};
  linear.later.bottomRightCorner<2, 2>() = filter->later;
  return linear;
}

constexpr std::array<double, 17> kLevels{0.003, 0.03, 0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0,
                                         4.0,   5.0,  6.0, 7.0, 8.5, 11., 16., 24.};

/// Besides what the point needs: far out there is room, so that cells there need not be small.
constexpr double kRoomPerLevel = 0.15;
constexpr double kMostLevelWithRoom = 8.0;
/// The mean squares that the points need, in units of the linear mean square.
Eigen::VectorXd needs(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set,
                      const LockMeanSquare& form, double linear, const std::vector<LockSample>& samples) {
  const MeanSquareInequality inequality(design, set, form);
  Eigen::VectorXd result(static_cast<Eigen::Index>(samples.size()));
  constexpr std::size_t kGrain = 128;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), kGrain), [&](const auto& range) {
    const rigor::UpwardRounding upward_here;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      result[static_cast<Eigen::Index>(k)] = inequality.needed_at(point_at(set, samples[k])) / linear;
    }
  });
  return result;
}

Eigen::VectorXd wanted(Eigen::VectorXd needed, const std::vector<LockSample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    needed[static_cast<Eigen::Index>(k)] *=
        1.0 + kRoomPerLevel * std::min(samples[k].level, kMostLevelWithRoom);
  }
  return needed;
}

}  // namespace

std::optional<LockMeanSquare> propose_mean_square(const trackers::ToneModel<double>& design,
                                                  const LockSet& set) {
  const auto about_lock = linear_of(design, set);
  if (!about_lock) {
    return std::nullopt;
  }
  const double linear = about_lock->mean_square;
  const bool leaks = design.epsilon != 0.0;
  constexpr int kAllDirections = 1200;
  constexpr std::size_t kAdded = 40;
  constexpr int kRounds = 8;
  constexpr double kLeastNeed = 1e-3;
  constexpr double kNearEnough = 0.005;
  const trackers::ToneModel<rigor::Interval> enclosed{rigor::Interval(design.q1), rigor::Interval(design.q2),
                                                      rigor::Interval(design.r),
                                                      rigor::Interval(design.epsilon)};
  std::vector<LockSample> all;
  std::vector<double> levels(kLevels.begin(), kLevels.end());
  if (leaks) {
    // From here on W shrinks.
    levels.push_back(std::log(set.drift / (1.0 - set.decay)));
  }
  for (const LevelPoint& direction : sample_directions(kAllDirections)) {
    for (const double level : levels) {
      if (level < set.level) {
        all.push_back({direction, level});
        if (leaks) {
          all.push_back({{direction[0], direction[1], -direction[2], direction[3]}, level});
        }
      }
    }
  }
  const Forms forms(*about_lock, leaks);
  std::vector<LockSample> looked_at(all.begin(), all.begin() + 17 * 12);
  search::SearchSpace space = forms.space(400);
  double bound = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const search::BestPoint best = search::climb_least(
        [&](const Eigen::VectorXd& x) {
          return Eigen::VectorXd(-wanted(needs(enclosed, set, forms.form(x), linear, looked_at), looked_at)
                                      .cwiseMax(kLeastNeed)
                                      .array()
                                      .log());
        },
        space);
    space.start = best.point;
    const Eigen::VectorXd needed = needs(enclosed, set, forms.form(space.start), linear, all);
    const Eigen::VectorXd worst = wanted(needed, all);
    bound = needed.maxCoeff();
    if (std::log(worst.maxCoeff()) <= -best.value + kNearEnough) {
      break;
    }
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return worst[static_cast<Eigen::Index>(a)] > worst[static_cast<Eigen::Index>(b)];
    });
    for (std::size_t k = 0; k < kAdded; ++k) {
      looked_at.push_back(all[order[k]]);
    }
  }
  LockMeanSquare proposal = forms.form(space.start);
  proposal.bound = linear * bound;
  return proposal;
}

}  // namespace veritrack::quadrature

#include "analysis/quadrature/gaussian/lock_search.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "analysis/quadrature/gaussian/drift_inequality.hpp"
#include "analysis/quadrature/gaussian/lock_centre.hpp"
#include "analysis/quadrature/gaussian/lock_samples.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximin.hpp"

namespace veritrack::quadrature {

namespace {

constexpr Eigen::Index kParameters = std::tuple_size_v<LockShape>;

/// A block matrix by its Cholesky factor [[a, 0, 0], [0, b, 0], [0, c, d]].
struct Factor {
  double a, b, c, d;
  [[nodiscard]] LevelCovariance<double> product() const { return {a * a, b * b, b * c, c * c + d * d}; }
};
Factor factor_of(const LevelCovariance<double>& p) {
  const double b = std::sqrt(p.p22);
  const double c = p.p23 / b;
  return {std::sqrt(p.p11), b, c, std::sqrt(p.p33 - c * c)};
}
/// The factor of C X C', C and X = f f' by their factors.
Factor times(const Factor& c, const Factor& f) {
  return {c.a * f.a, c.b * f.b, c.c * f.b + c.d * f.c, c.d * f.d};
}
Factor inverse(const Factor& c) {
  return {1.0 / c.a, 1.0 / c.b, -c.c / (c.b * c.d), 1.0 / c.d};
}
/// C^-T X C^-1.
LevelCovariance<double> pulled_back(const Factor& c, const LevelCovariance<double>& x) {
  const Factor i = inverse(c);
  const double row = x.p23 * i.d;
  const double last = x.p33 * i.d;
  return {x.p11 * i.a * i.a, i.b * i.b * x.p22 + 2.0 * i.b * i.c * x.p23 + i.c * i.c * x.p33,
          i.b * row + i.c * last, last * i.d};
}

Eigen::Matrix3d whole(const LevelCovariance<double>& p) {
  Eigen::Matrix3d matrix;
  matrix << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return matrix;
}
LevelCovariance<double> symmetric(const Eigen::Matrix3d& p) {
  return {p(0, 0), p(1, 1), p(1, 2), p(2, 2), p(0, 1), p(0, 2), false};
}

/// In coordinates in which the steady state is the identity and the noise is that of the model. Four numbers
/// a matrix: logarithms of a, b, d, and c.
class Shapes {
 public:
  Shapes(const LockRequest& request, const LockCentre& centre)
      : request_(request),
        centre_(centre),
        root_(factor_of(centre.covariance)),
        whole_root_(whole(centre.covariance).llt().matrixL()) {}

  /// The common values of good sets of the designs of La Scala's Table 3.2.
  [[nodiscard]] static search::SearchSpace space(int evaluations) {
    search::SearchSpace space{Eigen::VectorXd(kParameters), Eigen::VectorXd::Constant(kParameters, 0.1),
                              Eigen::VectorXd::Constant(kParameters, -6.0),
                              Eigen::VectorXd::Constant(kParameters, 6.0), evaluations};
    space.start << -0.8, -0.43, 0.21, -0.08,  // T
        -0.03, -0.46, 0.32, -0.6,             // D_h
        -0.2, -0.05, 0.26, -0.7,              // D_l
        1.39;                                 // gamma
    return space;
  }

  [[nodiscard]] LockSet set(const Eigen::VectorXd& x) const {
    const auto factor = [&](Eigen::Index first) {
      return Factor{std::exp(x[first]), std::exp(x[first + 1]), x[first + 2], std::exp(x[first + 3])};
    };
    LockSet set;
    const double scale = request_.design.r / (request_.noise_deviation * request_.noise_deviation);
    LevelCovariance<double> weight = pulled_back(root_, factor(0).product());
    const Factor metric =
        factor_of({scale * weight.p11, scale * weight.p22, scale * weight.p23, scale * weight.p33});
    // M = T'T with an upper triangular T.
    set.metric = {metric.a, metric.b, metric.c, metric.d};
    set.centre = centre_.covariance;
    set.bias = centre_.errors;
    set.lowest_frequency = request_.lowest_frequency;
    set.highest_frequency = request_.highest_frequency;
    set.spread_above = times(root_, factor(4)).product();
    set.spread_below = pulled_back(root_, factor(8).product());
    if (!centre_.covariance.apart) {
      set.spread_above = symmetric(whole_root_ * whole(factor(4).product()) * whole_root_.transpose());
      const Eigen::Matrix3d back = whole_root_.inverse();
      set.spread_below = symmetric(back.transpose() * whole(factor(8).product()) * back);
    }
    set.weight = std::exp(x[12]);
    set.level = request_.level;
    set.decay = request_.decay;
    set.drift = request_.drift;
    set.noise_deviation = request_.noise_deviation;
    set.frequency_walk = request_.frequency_walk;
    return set;
  }

 private:
  const LockRequest& request_;
  LockCentre centre_;
  Factor root_;
  Eigen::Matrix3d whole_root_;  ///< with the entries 12 and 13
};

/// Shares of the level.
constexpr std::array<double, 7> kShares{1.0, 0.8, 0.5, 0.25, 0.1, 0.03, 0.003};

/// The margins of a set at these samples, in parallel.
Eigen::VectorXd margins_of(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set,
                           const std::vector<LockSample>& samples) {
  const DriftInequality inequality(design, set);
  Eigen::VectorXd margins(static_cast<Eigen::Index>(samples.size()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 64), [&](const auto& range) {
    const rigor::UpwardRounding upward;
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const double margin = inequality.margin_at(point_at(set, samples[k]));
      margins[static_cast<Eigen::Index>(k)] = std::isnan(margin) ? -1.0 : margin;
    }
  });
  return margins;
}

/// From the usual shapes, or from a near one.
std::optional<LockProposal> propose_from(const LockRequest& request) {
  const bool leaks = request.design.epsilon != 0.0;
  const auto centre =
      lock_centre(request.design, 0.5 * (request.lowest_frequency + request.highest_frequency));
  if (!centre) {
    return std::nullopt;
  }
  constexpr int kAllDirections = 1200;
  constexpr std::size_t kAdded = 24;
  const trackers::ToneModel<rigor::Interval> design{
      rigor::Interval(request.design.q1), rigor::Interval(request.design.q2),
      rigor::Interval(request.design.r), rigor::Interval(request.design.epsilon)};
  std::vector<LockSample> all;
  for (const LevelPoint& direction : sample_directions(kAllDirections)) {
    for (const double share : kShares) {
      all.push_back({direction, share * request.level});
      if (leaks) {
        all.push_back({{direction[0], direction[1], -direction[2], direction[3]}, share * request.level});
      }
    }
  }
  // From less noise to that which is asked for: what is worst with less is nearly so with more.
  const std::vector<double> parts = request.near ? std::vector{1.0} : std::vector{0.5, 0.7, 0.9, 1.0};
  std::vector<LockSample> looked_at(all.begin(), all.begin() + 200);
  search::SearchSpace space = Shapes::space(request.evaluations);
  if (request.near) {
    space.start = Eigen::Map<const Eigen::VectorXd>(request.near->data(), kParameters);
  }
  double least = -1.0;
  const Shapes shapes(request, *centre);
  LockSet set;
  for (const double part : parts) {
    const auto set_at = [&](const Eigen::VectorXd& x) {
      LockSet easier = shapes.set(x);
      easier.noise_deviation *= part;
      easier.frequency_walk *= part;
      return easier;
    };
    const int rounds = part < 1.0 ? 1 : 6;
    for (int round = 0; round < rounds; ++round) {
      const search::BestPoint best = search::climb_least(
          [&](const Eigen::VectorXd& x) { return margins_of(design, set_at(x), looked_at); }, space);
      space.start = best.point;
      set = set_at(best.point);
      const Eigen::VectorXd margins = margins_of(design, set, all);
      least = margins.minCoeff();
      if (least >= best.value - 1e-3 && round > 0) {
        break;
      }
      std::vector<std::size_t> order(all.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return margins[static_cast<Eigen::Index>(a)] < margins[static_cast<Eigen::Index>(b)];
      });
      for (std::size_t k = 0; k < kAdded; ++k) {
        looked_at.push_back(all[order[k]]);
      }
    }
  }
  LockProposal proposal{set, least};
  std::copy(space.start.begin(), space.start.end(), proposal.shape.begin());
  return proposal;
}

/// With much less noise the shape of a good set changes little from design to design: followed from La
/// Scala's designs, which the usual shapes are of, to this one.
std::optional<LockShape> followed_shape(const LockRequest& request) {
  constexpr double kUsualRatio = 0.13;  // q1/r and q2/r of figure 3.4
  constexpr double kQuiet = 0.3;        // of the noise
  constexpr int kSteps = 4;
  std::optional<LockShape> shape;
  for (int k = 0; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps;
    LockRequest between = request;
    const double usual = kUsualRatio * request.design.r;
    between.design.q1 = usual * std::pow(request.design.q1 / usual, share);
    between.design.q2 = usual * std::pow(request.design.q2 / usual, share);
    between.noise_deviation *= kQuiet;
    between.frequency_walk *= kQuiet;
    between.near = shape;
    const auto found = propose_from(between);
    if (!found || !(found->margin > 0.0)) {
      return std::nullopt;
    }
    shape = found->shape;
  }
  return shape;
}

}  // namespace

std::optional<LockProposal> propose_lock_set(const LockRequest& request) {
  std::optional<LockProposal> found = propose_from(request);
  const bool is_unusual = found && !(found->margin > 0.0) && !request.near && request.design.epsilon == 0.0;
  if (!is_unusual) {
    return found;
  }
  LockRequest louder = request;
  louder.near = followed_shape(request);
  for (const double part : {0.5, 0.75, 1.0}) {
    if (!louder.near) {
      return found;
    }
    louder.noise_deviation = part * request.noise_deviation;
    louder.frequency_walk = part * request.frequency_walk;
    const auto better = propose_from(louder);
    if (!better || !(better->margin > 0.0)) {
      return found;
    }
    louder.near = better->shape;
    if (part == 1.0) {
      return better;
    }
  }
  return found;
}

}  // namespace veritrack::quadrature

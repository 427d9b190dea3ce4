// Bounds of a filter's covariance and a shape, carried along an orbit of the tone: see filter_proposal.hpp.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "analysis/model/filter/filter_numbers.hpp"
#include "analysis/model/filter/orbit_points.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"
#include "analysis/model/step/tube.hpp"
#include "analysis/rigor/decompositions.hpp"

namespace veritrack::model::detail {

/// Of the bounds, in units of themselves: what they have to spare.
inline constexpr double kSlack = 0.006;
/// Of those in the long run, where it is also how fast the covariance comes between them, and of those of a
/// frequency that moves, which have to fit together at borders of cells.
inline constexpr double kWideSlack = 0.012;

struct FilterParameters {
  double eta = 0.3;
  double theta = 0.3;
  double lambda = 0.9;
  double noise = 0.0;     ///< V, or the deviation of Gaussian noise
  double slew = 0.0;      ///< W
  double moving = 0.0;    ///< c
  double source = 0.0;    ///< b
  double spread = 0.0;    ///< d
  double exponent = 0.0;  ///< L, for Gaussian noise: see gaussian_drift.hpp; 0: the noise is bounded
  VectorXd process;       ///< the diagonal of W
};

/// What is carried along.
struct FilterOnOrbit {
  Small low, high;  ///< predicted for this sample
  Small shape;      ///< Pi after it
};

/// What a step is worth.
struct FilterGrowth {
  double whole = 0.0;   ///< |F|, about, for |xi| <= 1
  double linear = 0.0;  ///< of it, without noise
};

/// c0, for proposals.
inline constexpr double kProposedConstant = 5.0;

/// The root of the largest (log E W+ - log(1 + c0 exp(-L l^2)))/(L l^2), about, over the levels l, where the
/// step is N xi + B v and what is quadratic: from N N', B deviation, and the square of a bound of the latter.
inline double gaussian_growth(const Small& gram, const Small& of_noise, double squared, double exponent) {
  const Small noise = 2.0 * exponent * of_noise * of_noise.transpose();
  const Index n = gram.rows();
  constexpr std::array<double, 5> kLevels{1.0, 0.7, 0.5, 0.34, 0.25};
  std::array<double, kLevels.size()> least{};
  least.fill(std::numeric_limits<double>::infinity());
  for (const double a : {0.01, 0.02, 0.04, 0.07, 0.12, 0.2, 0.35}) {
    const Eigen::LLT<Small> root(Small::Identity(n, n) - (1.0 + a) * noise);
    if (root.info() != Eigen::Success) {
      break;
    }
    const Small half = root.matrixL().solve(gram);
    const Small inner = root.matrixL().solve(Small(half.transpose()));
    const double linear = rigor::largest_eigenvalue(inner);
    const double spread = -std::log(root.matrixLLT().diagonal().prod());
    for (std::size_t i = 0; i < kLevels.size(); ++i) {
      const double square = kLevels[i] * kLevels[i];
      const double all = exponent * square;
      least[i] = std::min(least[i], (1.0 + a) * linear + (1.0 + 1.0 / a) * squared * square +
                                        (spread - std::log1p(kProposedConstant * std::exp(-all))) / all);
    }
  }
  return std::sqrt(std::max(0.0, *std::max_element(least.begin(), least.end())));
}

class FilterOrbit {
 public:
  /// `around`: the bounds are for all estimates in there, not only for those in the shape.
  /// `slope`: of the curve by the frequency, for a slew. `points`: of the same orbit from the phase at which
  /// it begins, or none.
  FilterOrbit(const TrackedTone& tone, const NodeCurve& curve, const FilterParameters& parameters,
              const Surroundings& around = {}, const Eigen::MatrixXcd* slope = nullptr,
              const OrbitPoints* points = nullptr)
      : walk_(tone, curve, around, parameters.slew > 0.0 ? slope : nullptr),
        parameters_(parameters),
        is_inside_(around.tube != nullptr),
        moves_(parameters.slew > 0.0 && slope != nullptr),
        points_(points) {}

  /// At this phase, from the steady state of the filter.
  void begin(double phase) {
    number_ = 0;
    point_ = points_ != nullptr ? points_->find(0) : nullptr;
    if (point_ == nullptr) {
      own_ = walk_.first(phase);
      point_ = &own_;
    }
    updated_low_ = updated_high_ = point_->covariance;
    here_.shape = parameters_.process.asDiagonal();
    here_.low = here_.high = point_->covariance;
  }
  /// To the next sample; false where bounds or shape are none.
  [[nodiscard]] bool step() {
    const OrbitPoint& now = *point_;
    const FilterNumbers& numbers = walk_.numbers();
    const Index n = numbers.states();
    const Eigen::LLT<Small> root(here_.shape);
    if (root.info() != Eigen::Success || !(here_.shape.maxCoeff() < 1e12)) {
      return false;
    }
    const Small f = now.jacobian;
    const Small slope = now.slope;
    before_ = root.matrixL();
    changes_.clear();
    Small of_high = Small::Zero(n, n);
    Small of_low = Small::Zero(n, n);
    const Small wide = is_inside_ ? Small(now.wide) : before_;
    const bool is_same = now.changes_of_slope.empty();
    for (Index i = 0; i < n; ++i) {
      const Small change = change_along(now.changes, wide.col(i));
      changes_.push_back(is_same && !is_inside_
                             ? change
                             : change_along(is_same ? now.changes : now.changes_of_slope, before_.col(i)));
      of_high += change * updated_high_ * change.transpose();
      of_low += change * updated_low_ * change.transpose();
    }
    const double slack = is_inside_ || moves_ ? kWideSlack : kSlack;
    constexpr double kHigherOrders = 1.1;
    of_high *= kHigherOrders;
    of_low *= kHigherOrders;
    const double eta = parameters_.eta;
    const double theta = parameters_.theta;
    FilterOnOrbit next;
    next.high = (1.0 + slack) * (numbers.process() + (1.0 + eta) * f * updated_high_ * f.transpose() +
                                 (1.0 + 1.0 / eta) * of_high);
    next.low = (1.0 - slack) * (numbers.process() + (1.0 - theta) * f * updated_low_ * f.transpose() -
                                (1.0 / theta - 1.0) * of_low);
    if (Eigen::LLT<Small>(next.low).info() != Eigen::Success || !(next.high.maxCoeff() < 1e12)) {
      return false;
    }
    updated_high_ = numbers.updated(next.high);
    updated_low_ = numbers.updated(next.low);
    const Small middle = 0.5 * (updated_high_ + updated_low_);
    delta_ = 0.5 * (updated_high_ - updated_low_);
    gain_ = middle * numbers.weighted().transpose();
    contraction_ = (Small::Identity(n, n) - gain_ * numbers.measured());
    const Small a = contraction_ * slope;
    next.shape = a * here_.shape * a.transpose() / parameters_.lambda +
                 parameters_.source * gain_ * gain_.transpose() + parameters_.spread * delta_;
    next.shape.diagonal() += parameters_.process;
    jacobian_ = slope;
    advance();
    if (moves_) {
      next.shape += parameters_.moving * point_->move * point_->move.transpose();
    }
    here_ = std::move(next);
    offset_ = gain_ * point_->innovation - point_->correction;
    return true;
  }
  [[nodiscard]] const FilterOnOrbit& here() const { return here_; }
  /// How far frequency errors reach in the shape.
  [[nodiscard]] double reach() const {
    return std::sqrt((point_->gradient * here_.shape * point_->gradient.transpose()).value());
  }
  /// Of the step that was the last one: the least one over the multipliers that are tried. With `enough`, the
  /// first one that is at most so much, and infinity when there is none.
  [[nodiscard]] FilterGrowth growth(double enough = 0.0) {
    const Index n = walk_.numbers().states();
    const Eigen::LLT<Small> root(here_.shape);
    FilterGrowth worst{std::numeric_limits<double>::infinity(), 1.0};
    if (root.info() != Eigen::Success) {
      return worst;
    }
    const auto in_units = [&](auto x) {
      root.matrixL().solveInPlace(x);
      return x;
    };
    const Small spread = in_units(Small(in_units(delta_).transpose()));
    const Small& weights = walk_.numbers().weighted();
    const Small weighted = weights * delta_ * weights.transpose();
    const Small factor = Eigen::LLT<Small>(weighted).matrixL();
    const Small of_measured = factor.transpose() * walk_.numbers().measured();
    const Small of_x = in_units(Small(contraction_ * jacobian_ * before_));
    const Small reach_of_x = -of_measured * jacobian_ * before_;
    const Small of_v = Small(in_units(gain_) * parameters_.noise);
    const Small reach_of_v = factor.transpose() * parameters_.noise;
    Wide second(n, n * n);
    for (Index i = 0; i < n; ++i) {
      second.middleCols(i * n, n) = 0.5 * changes_[static_cast<std::size_t>(i)] * before_;
    }
    const Wide of_squares = in_units(Wide(contraction_ * second));
    const Wide reach_of_squares = -of_measured * second;
    // What the range of gains does to the curve.
    const Small offset = in_units(Small(offset_));
    const Small reach_of_offset = factor.transpose() * point_->innovation;
    const double top = rigor::largest_eigenvalue(spread);
    constexpr std::array<double, 7> kShares{1.08, 1.2, 1.4, 1.8, 3.0, 8.0, 40.0};
    for (std::size_t tried = 0; tried < kShares.size(); ++tried) {
      // What was good at the last sample first.
      const std::size_t number = (tried + good_share_) % kShares.size();
      const double most = enough > 0.0 ? enough : worst.whole;
      const double mu = kShares.at(number) * top + 1e-300;
      const Eigen::LLT<Small> inner(Small::Identity(n, n) - spread / mu);
      const auto stacked = [&](auto first, const auto& below) {
        inner.matrixL().solveInPlace(first);
        auto both = first;
        both.resize(first.rows() + below.rows(), first.cols());
        both << first, std::sqrt(mu) * below;
        return both;
      };
      const Small x = stacked(of_x, reach_of_x);
      const Small gram = x * x.transpose();
      const double alone = std::sqrt(rigor::largest_eigenvalue(gram));
      if (parameters_.exponent > 0.0) {
        const Small v = stacked(of_v, reach_of_v);
        const Wide squares = stacked(of_squares, reach_of_squares);
        const double drift = gaussian_growth(
            gram, v, rigor::largest_eigenvalue(Small(squares * squares.transpose())), parameters_.exponent);
        if (drift < worst.whole) {
          worst = {drift, alone};
        }
        continue;
      }
      double others = stacked(offset, reach_of_offset).norm();
      if (alone + others > most) {
        continue;
      }
      const Wide squares = stacked(of_squares, reach_of_squares);
      others += std::sqrt(rigor::largest_eigenvalue(Small(squares * squares.transpose())));
      if (alone + others > most) {
        continue;
      }
      double linear = alone;
      if (parameters_.noise > 0.0 || moves_) {
        Small other = Small::Zero(gram.rows(), gram.rows());
        // Of both, each gets a half.
        const double half = parameters_.noise > 0.0 && moves_ ? 2.0 : 1.0;
        if (parameters_.noise > 0.0) {
          const Small v = stacked(of_v, reach_of_v);
          other += half * v * v.transpose();
        }
        if (moves_) {
          const Small w = stacked(Small(in_units(Small(point_->move)) * parameters_.slew),
                                  Small(Small::Zero(reach_of_v.rows(), 1)));
          other += half * w * w.transpose();
        }
        linear = with_disturbances(gram, other, alone, most - others, enough > 0.0);
      }
      const double whole = linear + others;
      if (whole < worst.whole) {
        worst = {whole, alone};
        best_share_ = number;
      }
      if (enough > 0.0 && worst.whole <= enough) {
        break;
      }
    }
    good_share_ = best_share_;
    if (enough > 0.0 && !(worst.whole <= enough)) {
      worst.whole = std::numeric_limits<double>::infinity();
    }
    return worst;
  }

 private:
  /// The root of the least largest eigenvalue of gram/t + other/(1 - t) over some t, or infinity when it is
  /// above `most`; with `any`, the first one that is not. `alone`: the root of the one of gram.
  [[nodiscard]] double with_disturbances(const Small& gram, const Small& other, double alone, double most,
                                         bool any) {
    constexpr std::array<double, 5> kSplits{0.5, 0.7, 0.82, 0.9, 0.95};
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = good_split_;
    for (std::size_t tried = 0; tried < kSplits.size(); ++tried) {
      const std::size_t number = (tried + good_split_) % kSplits.size();
      const double t = kSplits.at(number);
      if (alone / std::sqrt(t) > std::min(most, least)) {
        continue;
      }
      const double length = std::sqrt(rigor::largest_eigenvalue(Small(gram / t + other / (1.0 - t))));
      if (length < least) {
        least = length;
        best = number;
      }
      if (any && least <= most) {
        break;
      }
    }
    good_split_ = best;
    return least;
  }
  void advance() {
    ++number_;
    const OrbitPoint* next = points_ != nullptr ? points_->find(number_) : nullptr;
    if (next == nullptr) {
      own_ = walk_.after(*point_);
      next = &own_;
    }
    point_ = next;
  }

  OrbitWalk walk_;
  FilterParameters parameters_;
  bool is_inside_, moves_;
  const OrbitPoints* points_;
  std::size_t number_ = 0;
  const OrbitPoint* point_ = nullptr;  ///< the sample
  OrbitPoint own_;                     ///< one that is not among the points
  SmallVector offset_;                 ///< on the curve: what the middle gain makes of the innovation
  Small updated_low_, updated_high_, delta_, gain_, contraction_, jacobian_, before_;
  std::vector<Small> changes_;
  FilterOnOrbit here_;
  std::size_t good_share_ = 0, best_share_ = 0, good_split_ = 0;  ///< of the multipliers and splits
};

}  // namespace veritrack::model::detail

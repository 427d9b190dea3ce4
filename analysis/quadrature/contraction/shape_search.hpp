// The shapes that a proposal chooses among, and the results of sampling for each; part of proposal.hpp.
#pragma once

#include <limits>
#include <optional>

#include "analysis/quadrature/contraction/proposal.hpp"
#include "analysis/quadrature/contraction/sampled_set.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::quadrature {

constexpr double kWorthless = -std::numeric_limits<double>::max();

[[nodiscard]] constexpr bool is_about_a_start(Objective objective) {
  return objective == Objective::frequency_bound || objective == Objective::ultimate_error ||
         objective == Objective::settling || objective == Objective::requirement;
}

[[nodiscard]] constexpr bool sets_a_disturbance(Objective objective) {
  return objective == Objective::noise || objective == Objective::slew;
}

/// Sets about a start are small, and their steps nearly linear: little room will do. In units of the steady
/// state.
[[nodiscard]] constexpr double covariance_margin(Objective objective) {
  return is_about_a_start(objective) ? 0.003 : 0.02;
}

/// The space of shapes, with the objectives as functions on it.
class ShapeSearch {
 public:
  ShapeSearch(const ProposalRequest& request, const BlockCovariance<double>& steady);

  /// T from three numbers: the weights of amplitude and frequency against phase, as logarithms, and the
  /// coupling, all in units of the steady state's standard deviations. Then, for noise and slew if there are
  /// any, by how much their gains squared exceed the least; and the radius, when it is searched for.
  [[nodiscard]] search::SearchSpace space() const;

  [[nodiscard]] Shape shape(const Eigen::VectorXd& x) const;

  [[nodiscard]] SampledSet sample(const Shape& shape, double radius, double noise) const;

  /// The contribution of noise and slew to |T e|^2 in a step.
  [[nodiscard]] double pushed(const Shape& shape) const;

  /// The largest radius that tolerates noise and slew, 0 if there is none: growth by steps, then bisection.
  [[nodiscard]] double largest_radius(const Shape& shape) const;

  /// The noise or slew that the set tolerates. Noise turns the estimate and so widens the covariance bounds:
  /// the first value is tried, in part, before the second is believed.
  [[nodiscard]] double largest_disturbance(const Shape& shape) const;

  /// The set around the start: its radius and its bounds. Grows the set when noise and slew drive states out
  /// of it.
  struct Promise {
    double radius = 0.0, start_level = 0.0, rate_squared = 0.0, ultimate = 0.0;
  };

  [[nodiscard]] std::optional<Promise> promise(const Shape& shape) const;

  /// The worst ratio of a set's claim to the requirement, when it claims this part of its contraction. Below
  /// 1 where the set meets all requirements.
  [[nodiscard]] double shortfall(const Shape& shape, const Promise& promise, double part) const;

  /// The objective among the sets around a start, to be maximised.
  [[nodiscard]] double worth(const Shape& shape) const;

 private:
  ProposalRequest request_;
  BlockCovariance<double> steady_;
  BlockUpdate<double> update_;
  bool noisy_ = false, slewing_ = false, about_radius_ = false;
};

}  // namespace veritrack::quadrature

// The parameters of a shape as a point of a space that is searched: see shape_proposal.hpp.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "analysis/model/shape/shape_proposal.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model::detail {

using Eigen::Index;
using Eigen::MatrixXd;

/// The axes of W: the states themselves, or those of their covariance under the disturbance. Where states
/// move together (delays), a diagonal W would be useless; where they do not (a filter's covariances), it is
/// better.
enum class Axes { of_states, of_covariance };

/// The places of the parameters in the space of the search: the logit of lambda between the square of the
/// rate and 1, the logarithms of W along its axes, and of c where it is wanted.
class SearchCoordinates {
 public:
  SearchCoordinates(const CurveDynamics& dynamics, const ShapeSettings& settings, Axes axes)
      : rate_squared_(square_of_rate(dynamics, settings)) {
    const bool with_noise = settings.noise > 0.0 || settings.slew == 0.0;
    const bool for_slew = settings.objective == ShapeObjective::largest_slew ||
                          (settings.objective == ShapeObjective::least_long_run_error && settings.slew > 0.0);
    weights_ = for_slew ? DisturbanceWeights{0.0, 1.0} : DisturbanceWeights{1.0, 0.0};
    is_both_ = for_slew && settings.objective == ShapeObjective::least_long_run_error && with_noise;
    if (is_both_) {
      weights_.noise = 1.0;
    }
    find_axes(dynamics);
    if (axes == Axes::of_states) {
      axes_ = MatrixXd(axes_.diagonal().asDiagonal());
    }
    size_ = dynamics.size;
  }

  /// Around parameters that were good nearby.
  SearchCoordinates(const CurveDynamics& dynamics, const ShapeSettings& settings,
                    const ShapeParameters& nearby)
      : rate_squared_(square_of_rate(dynamics, settings)), weights_(nearby.weights) {
    is_both_ = weights_.noise > 0.0 && weights_.slew > 0.0;
    if (const auto factor = rigor::cholesky(nearby.source)) {
      axes_ = *factor;
    }
    const double share = (nearby.lambda - rate_squared_) / (1.0 - rate_squared_);
    nearby_ = Eigen::VectorXd::Zero(size());
    nearby_[0] = share > 0.05 && share < 0.95 ? std::log(share / (1.0 - share)) : 0.0;
  }

  [[nodiscard]] const Eigen::VectorXd& nearby() const { return nearby_; }
  [[nodiscard]] bool is_usable() const { return axes_.allFinite() && axes_.size() > 0; }
  [[nodiscard]] Index size() const { return 1 + axes_.cols() + (is_both_ ? 1 : 0); }
  /// W is exp(logarithm) of the covariance, and along every axis at least exp(floor) of the state's size.
  [[nodiscard]] Eigen::VectorXd start(double logit, double logarithm, double floor) const {
    Eigen::VectorXd x = Eigen::VectorXd::Constant(size(), logarithm);
    x[0] = logit;
    for (Index i = 0; i < axes_.cols(); ++i) {
      x[1 + i] = std::max(logarithm, std::min(25.0, 2.0 * (floor + std::log(size_[i] / axes_(i, i)))));
    }
    if (is_both_) {
      x[size() - 1] = 0.0;
    }
    return x;
  }
  [[nodiscard]] ShapeParameters at(const Eigen::VectorXd& x) const {
    ShapeParameters parameters;
    parameters.lambda = rate_squared_ + (1.0 - rate_squared_) / (1.0 + std::exp(-x[0]));
    parameters.weights = weights_;
    if (is_both_) {
      parameters.weights.slew *= std::exp(x[size() - 1]);
    }
    const Eigen::VectorXd sizes = x.segment(1, axes_.cols()).array().exp();
    parameters.source = axes_ * sizes.asDiagonal() * axes_.transpose();
    return parameters;
  }

 private:
  static double square_of_rate(const CurveDynamics& dynamics, const ShapeSettings& settings) {
    const double rate = std::max(dynamics.cocycle.rate(), settings.largest_rate);
    return rate * rate;
  }
  void find_axes(const CurveDynamics& dynamics) {
    const int n = dynamics.cocycle.states();
    if (weights_.slew > 0.0) {
      // In units of a slew that has the same effect as a noise of 1.
      const double noise = dynamics.noise_source.colwise().sum().cwiseAbs().maxCoeff();
      const double drift = dynamics.slew.colwise().squaredNorm().maxCoeff();
      weights_.slew = drift > 0.0 && noise > 0.0 ? noise / drift : 1.0;
    }
    ShapeParameters plain;
    plain.lambda = 0.5 * (1.0 + rate_squared_);
    plain.weights = {1.0, weights_.slew};
    plain.source = MatrixXd::Zero(n, n);
    const MatrixXd pi = dynamics.cocycle.lyapunov_solution(plain.lambda, lyapunov_source(dynamics, plain));
    MatrixXd mean = pi.rowwise().mean().reshaped(n, n);
    // States that no disturbance reaches still have to have an axis.
    const double largest = mean.diagonal().maxCoeff();
    mean.diagonal() = mean.diagonal() * (1.0 + 1e-6) + Eigen::VectorXd::Constant(n, 1e-10 * largest);
    if (const auto factor = rigor::cholesky(mean)) {
      axes_ = *factor;
    }
  }

  double rate_squared_;
  DisturbanceWeights weights_;
  bool is_both_ = false;
  MatrixXd axes_;
  Eigen::VectorXd size_;
  Eigen::VectorXd nearby_;
};

}  // namespace veritrack::model::detail

#include "analysis/quadrature/leak/steady_cautious_rate.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "analysis/quadrature/leak/rate_descent.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::quadrature {

namespace {

/// T e+ / s = constant + slope u.
struct AffineStep {
  rigor::Vector<3> constant;
  rigor::Matrix<3> slope;
};

AffineStep affine_step(const SteadySetting<double>& setting, const SteadyPlace<double>& place) {
  const detail::StepForms<double> forms =
      detail::step_forms(setting, place, covariance_image(setting, place.level, place.x));
  const auto& t = setting.metric;
  rigor::Matrix<3> metric;
  metric << t.t11, t.t12, t.t13, 0.0, t.t22, t.t23, 0.0, 0.0, t.t33;
  // Columns: what belongs to 1, to alpha and to c = psi + nu; nu is carried over besides.
  rigor::Matrix<3> images;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto& [delta, frequency, left1, left2] = forms.left;
    images.col(i) << forms.polar.amplitude1 * delta.first[k] + forms.polar.amplitude2 * delta.second[k],
        forms.polar.phase2 * delta.second[k], frequency[k];
  }
  rigor::Matrix<3> by_error;
  by_error << images.col(1), images.col(2), images.col(2);
  by_error(2, 2) += 1.0 - setting.design.epsilon;
  return {metric * images.col(0),
          metric * metric.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(by_error)};
}

/// Bounds of T J spread J' T' / r^2 and of |T J K|, the remainder included.
struct CautiousBounds {
  rigor::Matrix<3> gram;
  double noise_gain;
};

CautiousBounds cautious_bounds(const SteadySetting<double>& setting, double level,
                               const SteadyStep<double>& step, const SteadyBounds<double>& bounds,
                               double noise) {
  using trackers::detail::square;
  const auto& t = setting.metric;
  const double over_r = 1.0 / setting.design.r;
  const double spread = detail::larger_eigenvalue(step.spread11, step.spread12, step.spread22);
  const double largest_gain = detail::larger_eigenvalue(step.largest11, step.largest12, step.largest22);
  const double radius =
      level * detail::root(spread) * detail::root(step.eta_squared) * over_r + largest_gain * noise;
  const double bend = 0.5 * radius / bounds.least_along;
  const double bent = t.t11 * bend + std::hypot(t.t12, t.t22) * bend / bounds.least_along;
  const double rest = square(bent * over_r) * spread;
  const rigor::Matrix<3> gram = step.gram.matrix();
  const double theta = std::sqrt(std::fmax(rest, 1e-300) / std::fmax(gram.trace(), 1e-300));
  CautiousBounds result;
  result.gram = (1.0 + theta) * gram + (1.0 + 1.0 / theta) * rest * rigor::Matrix<3>::Identity();
  const auto& n = step.noise;
  const double mean_squared = detail::larger_eigenvalue(square(n[0]) + square(n[2]) + square(n[4]),
                                                        n[0] * n[1] + n[2] * n[3] + n[4] * n[5],
                                                        square(n[1]) + square(n[3]) + square(n[5]));
  const double spread_squared = result.gram.cwiseAbs().rowwise().sum().maxCoeff();
  result.noise_gain =
      detail::root(mean_squared) + bent * largest_gain + level * detail::root(spread_squared * spread);
  return result;
}

}  // namespace

double cautious_rate(const SteadySetting<double>& setting, const SteadyPlace<double>& place,
                     const SteadyStep<double>& step, const SteadyBounds<double>& bounds, double noise) {
  constexpr double kMore = 1.1;  // of the noise than there is
  const CautiousBounds cautious = cautious_bounds(setting, place.level, step, bounds, noise);
  const AffineStep affine = affine_step(setting, place);
  const RateDescent<2> descent(affine.constant, {affine.slope * affine.slope.transpose(), cautious.gram},
                               {1.0, step.eta_squared});
  return std::sqrt(descent.least().value) + kMore * cautious.noise_gain * noise / place.level;
}

}  // namespace veritrack::quadrature

#include "analysis/theorems/homogeneous_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/elementary.hpp"
#include "analysis/theorems/signal_model.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::IntervalVector;
using IntervalCovariance = trackers::FactoredCovariance<Interval>;
using Estimate = trackers::QuadratureEstimate<Interval>;

/// 2^exponent; below the normal range, the interval from 0 to the least normal number.
Interval power_of_two(int exponent) {
  constexpr int kLeast = std::numeric_limits<double>::min_exponent - 1;
  return exponent >= kLeast ? Interval(std::ldexp(1.0, exponent))
                            : Interval::from_bounds(0.0, std::numeric_limits<double>::min());
}

/// Moves the scale of the direction into the exponent.
void rescale(HomogeneousState& state) {
  const double largest = state.direction.cwiseAbs().maxCoeff();
  if (std::isfinite(largest) && largest > 0.0) {
    int shift = 0;
    (void)std::frexp(largest, &shift);
    state.direction = state.direction.unaryExpr([shift](double x) { return std::ldexp(x, -shift); }).eval();
    state.exponent += shift;
  }
}

IntervalCovariance to_interval(const trackers::FactoredCovariance<double>& p) {
  return {Interval(p.conditional_11), Interval(p.conditional_12), Interval(p.conditional_22),
          Interval(p.regression_1),   Interval(p.regression_2),   Interval(p.frequency_variance)};
}

trackers::FactoredCovariance<double> midpoint(const IntervalCovariance& p) {
  return {rigor::midpoint(p.conditional_11), rigor::midpoint(p.conditional_12),
          rigor::midpoint(p.conditional_22), rigor::midpoint(p.regression_1),
          rigor::midpoint(p.regression_2),   rigor::midpoint(p.frequency_variance)};
}

/// z' P^-1 z, from the factors: (z - u z3)' M^-1 (z - u z3) + z3^2 / d. Empty unless M and d are certainly
/// positive.
Interval energy(const IntervalCovariance& p, const IntervalVector<3>& z) {
  const Interval e1 = z(0) - p.regression_1 * z(2);
  const Interval e2 = z(1) - p.regression_2 * z(2);
  const Interval determinant = p.conditional_11 * p.conditional_22 - square(p.conditional_12);
  const bool definite = certainly_positive(p.conditional_11) && certainly_positive(determinant) &&
                        certainly_positive(p.frequency_variance);
  if (!definite) {
    return Interval::empty();
  }
  // e' M^-1 e by completing the square: e1^2 / M11 + (e2 - M12 e1 / M11)^2 M11 / det M.
  const Interval remainder = e2 - p.conditional_12 * e1 / p.conditional_11;
  return square(e1) / p.conditional_11 + square(remainder) * p.conditional_11 / determinant +
         square(z(2)) / p.frequency_variance;
}

/// F(x) z, equation (3.8): the derivative of f at x in the direction z.
IntervalVector<3> linearised(const IntervalVector<3>& x, const IntervalVector<3>& z,
                             const Interval& epsilon) {
  const auto [sine, cosine] = rigor::sin_cos(x(2));
  const Interval real = z(0) - x(1) * z(2);
  const Interval imaginary = z(1) + x(0) * z(2);
  IntervalVector<3> result;
  result(0) = cosine * real - sine * imaginary;
  result(1) = sine * real + cosine * imaginary;
  result(2) = (Interval(1.0) - epsilon) * z(2);
  return result;
}

}  // namespace

HomogeneousState start_homogeneous(const Eigen::Vector3d& direction, double length,
                                   const Eigen::Matrix3d& covariance) {
  HomogeneousState state;
  const double size = direction.norm();
  const bool usable = std::isfinite(size) && size > std::numeric_limits<double>::min();
  state.direction =
      usable ? Eigen::Vector3d(direction / size) : Eigen::Vector3d::Constant(1.0 / std::sqrt(3.0));
  state.direction *= length;
  rescale(state);
  state.covariance = trackers::FactoredCovariance<double>::from_matrix(covariance);
  return state;
}

Interval magnitude_of(const HomogeneousState& state) {
  return euclidean_norm<3>(rigor::to_interval(state.direction)) * power_of_two(state.exponent);
}

HomogeneousStep step_homogeneous(const HomogeneousState& state, const Eigen::Vector3d& true_state,
                                 const trackers::ToneModel<Interval>& design) {
  const IntervalVector<3> x = rigor::to_interval(true_state);
  const IntervalVector<3> z = rigor::to_interval(state.direction);  // in units of 2^exponent
  const IntervalCovariance covariance = to_interval(state.covariance);
  const Interval unit = power_of_two(state.exponent);

  // The Riccati recursion along zbar = x - z.
  const Estimate zbar{x(0) - unit * z(0), x(1) - unit * z(1), x(2) - unit * z(2), covariance};
  const IntervalCovariance predicted = trackers::time_update(zbar, design).covariance;

  // [I - K H] F_x z is the prediction F_x z corrected by a measurement of zero.
  const IntervalVector<3> carried = linearised(x, z, design.epsilon);
  const Estimate updated = trackers::measurement_update(
      Estimate{carried(0), carried(1), carried(2), predicted}, Interval(0.0), Interval(0.0), design);
  const IntervalVector<3> next = updated.state();

  HomogeneousStep step;
  step.relative_decrease = (energy(covariance, z) - energy(updated.covariance, next)) /
                           (square(z(0)) + square(z(1)) + square(z(2)));
  step.next.direction = rigor::midpoint(next);
  step.next.exponent = state.exponent;
  step.next.covariance = midpoint(updated.covariance);
  rescale(step.next);
  return step;
}

}  // namespace veritrack::theorems

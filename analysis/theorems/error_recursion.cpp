#include "analysis/theorems/error_recursion.hpp"

#include <cmath>

#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/theorems/invariant_covariance.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::Verdict;

template <typename Derived>
Interval largest_eigenvalue_of(const Eigen::MatrixBase<Derived>& matrix) {
  const auto eigenvalues = rigor::symmetric_eigenvalues(matrix);
  return eigenvalues ? (*eigenvalues)(eigenvalues->size() - 1) : Interval::empty();
}

/// The upper end as a point, for quantities of which only an upper bound is needed.
Interval most(const Interval& x) {
  return Interval(x.upper());
}

/// A P A', in which every symmetric matrix stays symmetric.
IntervalMatrix<3> congruence(const IntervalMatrix<3>& a, const IntervalMatrix<3>& p) {
  const IntervalMatrix<3> product = a * p * a.transpose();
  return rigor::intersection(product, product.transpose());
}

IntervalMatrix<3> process_noise(const IntervalDesign& design) {
  IntervalMatrix<3> noise = IntervalMatrix<3>::Constant(Interval(0.0));
  noise(0, 0) = noise(1, 1) = design.q1;
  noise(2, 2) = design.q2;
  return noise;
}

/// F P F' <= mu Q, so that F' P(k+1|k)^-1 F <= mu/(1 + mu) P^-1: alpha = sqrt(mu/(1 + mu)).
void set_contraction(ErrorRecursion& recursion, const IntervalMatrix<3>& carried,
                     const IntervalDesign& design) {
  const Interval one(1.0);
  rigor::IntervalVector<3> scale;
  scale << one / sqrt(design.q1), one / sqrt(design.q1), one / sqrt(design.q2);
  const Interval mu = most(largest_eigenvalue_of(congruence(IntervalMatrix<3>(scale.asDiagonal()), carried)));
  const Interval rest = one / (one + mu);
  recursion.one_minus_alpha = rest / (one + sqrt(mu * rest));
  recursion.alpha = one - recursion.one_minus_alpha;
}

}  // namespace

std::optional<ErrorRecursion> error_recursion(const IntervalDesign& design, const ErrorBounds& tube,
                                              int window) {
  const auto range = window > 0 ? matrix_range(design, tube, window) : invariant_range(design, tube);
  if (!range) {
    return std::nullopt;
  }
  const auto least = rigor::inverse(range->information);
  if (!least) {
    return std::nullopt;
  }
  ErrorRecursion recursion;
  recursion.tube = tube;
  recursion.window = window;
  recursion.range = *range;

  // One step from the frame of the predicted phase: the turn, then F.
  const IntervalMatrix<3> step = own_frame_transition(tube.amplitude(), design.epsilon) * tube.turn();
  const IntervalMatrix<3> carried = congruence(step, range->upper);
  const IntervalMatrix<3> noise = process_noise(design);
  const IntervalMatrix<3> predicted_above = carried + noise;
  const IntervalMatrix<3> predicted_below =
      congruence(step, rigor::intersection(*least, least->transpose())) + noise;
  const auto inverse = rigor::inverse(predicted_below);
  if (!inverse) {
    return std::nullopt;
  }
  set_contraction(recursion, carried, design);

  recursion.p = largest_eigenvalue_of(range->upper);
  recursion.q = largest_eigenvalue_of(range->information);
  recursion.s = most(largest_eigenvalue_of(predicted_above));
  const Interval plane = largest_eigenvalue_of(range->upper.topLeftCorner<2, 2>());
  const Interval frequency = range->upper(2, 2);
  recursion.plane_gain = sqrt(plane);
  recursion.frequency_gain = sqrt(frequency);

  // |phi| <= e3^2/2 + |e3| |e_z| in the plane, measured by P(k+1|k)^-1.
  const Interval weight =
      largest_eigenvalue_of(rigor::intersection(*inverse, inverse->transpose()).topLeftCorner<2, 2>());
  recursion.curvature =
      (frequency / Interval(2.0) + recursion.frequency_gain * recursion.plane_gain) * sqrt(most(weight));
  recursion.process_gain = sqrt(most((*inverse)(2, 2)));
  const Interval one(1.0);
  const Interval innovation = most(largest_eigenvalue_of(predicted_above.topLeftCorner<2, 2>())) + design.r;
  recursion.measurement_gain = sqrt(one / design.r - one / innovation);
  recursion.tube_radius =
      min(tube.plane_error / recursion.plane_gain, tube.frequency_error / recursion.frequency_gain);

  for (const Interval* value : {&recursion.one_minus_alpha, &recursion.curvature, &recursion.process_gain,
                                &recursion.measurement_gain, &recursion.p, &recursion.q, &recursion.s,
                                &recursion.plane_gain, &recursion.frequency_gain, &recursion.tube_radius}) {
    // cannot bind (*value): each is a root, a norm, or a product of such and of the tube's sizes; what is not
    // a number decides nothing in decide_invariant.
    if (!certainly_positive(*value)) {
      return std::nullopt;
    }
  }
  return recursion;
}

Verdict ErrorRecursion::decide_invariant(const Interval& radius, const Interval& disturbance) const {
  // alpha R + c R^2 + d <= R, without 1 - alpha as a difference.
  const Interval growth = curvature * square(radius) + disturbance;
  return rigor::conjunction({decide_less(Interval(0.0), radius), decide_less_equal(radius, tube_radius),
                             decide_less_equal(growth, one_minus_alpha * radius)});
}

Interval ErrorRecursion::propose_radius(const Interval& disturbance) const {
  constexpr double kInside = 0.999;
  const double gap = one_minus_alpha.lower();
  const double c = curvature.upper();
  const double room = gap * gap - 4.0 * c * disturbance.upper();
  if (!(room >= 0.0)) {
    return Interval::empty();
  }
  const double least = (gap - std::sqrt(room)) / (2.0 * c);
  const double largest = kInside * std::min((gap + std::sqrt(room)) / (2.0 * c), tube_radius.lower());
  return least <= largest ? Interval(largest) : Interval::empty();
}

Interval ErrorRecursion::toughest_radius() const {
  return Interval(min(one_minus_alpha / (Interval(2.0) * curvature), tube_radius).lower());
}

Interval ErrorRecursion::largest_disturbance() const {
  const Interval radius = toughest_radius();
  return one_minus_alpha * radius - curvature * square(radius);
}

Interval ErrorRecursion::ultimate_radius(const Interval& disturbance) const {
  const Interval room = square(one_minus_alpha) - Interval(4.0) * curvature * disturbance;
  return Interval(2.0) * disturbance / (one_minus_alpha + sqrt(room));
}

}  // namespace veritrack::theorems

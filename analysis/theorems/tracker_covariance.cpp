#include "analysis/theorems/tracker_covariance.hpp"

#include "analysis/rigor/definiteness.hpp"
#include "analysis/theorems/riccati_bounds.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::Verdict;

SmallMatrix noise_of_a_step(const IntervalDesign& design) {
  SmallMatrix noise = SmallMatrix::Constant(3, 3, Interval(0.0));
  noise(0, 0) = noise(1, 1) = design.q1;
  noise(2, 2) = design.q2;
  return noise;
}

}  // namespace

// The deviation of the entries from the middle is at most the diagonal matrix of its row sums.
std::optional<IntervalMatrix<3>> point_above(const IntervalMatrix<3>& matrix) {
  IntervalMatrix<3> above;
  for (int i = 0; i < 3; ++i) {
    Interval slack(0.0);
    for (int j = 0; j < 3; ++j) {
      // The middle of the upper triangle is used for both.
      const double middle = rigor::midpoint(matrix(std::min(i, j), std::max(i, j)));
      above(i, j) = Interval(middle);
      slack += Interval(rigor::magnitude(matrix(i, j) - Interval(middle)));
    }
    above(i, i) = Interval((above(i, i) + slack).upper());
  }
  return rigor::is_finite(above) ? std::optional(above) : std::nullopt;
}

Interval ErrorBounds::amplitude() const {
  return Interval(1.0) + rigor::symmetric(plane_error.upper());
}

IntervalMatrix<3> ErrorBounds::turn() const {
  const Interval one(1.0);
  // asin x <= x / sqrt(1 - x^2).
  const Interval phase = plane_error / sqrt(one - square(plane_error));
  const Interval angle = phase + phase + frequency_error;
  const Interval sine = rigor::symmetric(min(angle, one).upper());
  const Interval cosine = hull(max(one - square(angle) / Interval(2.0), -one), one);
  const Interval zero(0.0);
  IntervalMatrix<3> turn;
  turn << cosine, -sine, zero,  //
      sine, cosine, zero,       //
      zero, zero, one;
  return turn;
}

IntervalMatrix<3> own_frame_transition(const Interval& amplitude, const Interval& epsilon) {
  IntervalMatrix<3> transition = IntervalMatrix<3>::Identity();
  transition(1, 2) = amplitude;
  transition(2, 2) = Interval(1.0) - epsilon;
  return transition;
}

std::optional<MatrixRange> matrix_range(const IntervalDesign& design, const ErrorBounds& tube, int window) {
  const IntervalMatrix<3> straight = own_frame_transition(tube.amplitude(), design.epsilon);
  const IntervalMatrix<3> turned = tube.turn() * straight;
  const auto steps = static_cast<std::size_t>(window);
  const SmallMatrix output = IntervalMatrix<2, 3>::Identity();
  const SmallMatrix measurement_noise = IntervalMatrix<2>::Identity() * design.r;
  LinearWindow system;
  system.transitions.assign(steps, turned);
  system.transitions.back() = straight;  // into the frame of the predicted phase
  system.process_noises.assign(steps, noise_of_a_step(design));
  system.outputs.assign(steps + 1, output);
  system.measurement_noises.assign(steps + 1, measurement_noise);
  const auto gramians = window_gramians(system);
  if (!gramians) {
    return std::nullopt;
  }
  const auto covariance = covariance_bound(*gramians);
  const auto information = information_bound(*gramians);
  if (!covariance || !information) {
    return std::nullopt;
  }
  const auto upper = point_above(*covariance);
  const auto most_information = point_above(*information);
  if (!upper || !most_information) {
    return std::nullopt;
  }
  return MatrixRange{*upper, *most_information};
}

Verdict decide_start(const IntervalMatrix<3>& start, const MatrixRange& range, const IntervalDesign& design,
                     const ErrorBounds& tube, int window) {
  using Covariance = trackers::PolarCovariance<Interval>;
  const IntervalMatrix<3> turn = tube.turn();
  Covariance covariance = Covariance::from_matrix(start);
  for (int k = 0; k <= window; ++k) {
    const IntervalMatrix<3> matrix = covariance.matrix();
    // P^-1 <= I where P - I^-1 >= 0, a Schur complement of [[I, 1], [1, P]].
    IntervalMatrix<6> joint = IntervalMatrix<6>::Identity();
    joint.topLeftCorner<3, 3>() = range.information;
    joint.bottomRightCorner<3, 3>() = matrix;
    joint.topRightCorner<3, 3>() = joint.bottomLeftCorner<3, 3>() = IntervalMatrix<3>::Identity();
    const IntervalMatrix<3> room = range.upper - matrix;
    if (rigor::conjunction({rigor::is_positive_definite(room), rigor::is_positive_definite(joint)}) !=
        Verdict::proved) {
      return Verdict::undecided;
    }
    // From the frame of the predicted phase into that of the estimated one, where the next step begins.
    IntervalMatrix<3> own = matrix;
    if (k > 0) {
      own = turn * matrix * turn.transpose();
    }
    const Covariance predicted =
        trackers::predicted_covariance(Covariance::from_matrix(own), tube.amplitude(), design);
    covariance = trackers::filtered_covariance(predicted, trackers::gain(predicted, design.r), design.r);
  }
  return Verdict::proved;
}

}  // namespace veritrack::theorems

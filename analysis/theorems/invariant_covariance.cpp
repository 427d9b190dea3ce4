#include "analysis/theorems/invariant_covariance.hpp"

#include <Eigen/LU>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::Verdict;

/// The steady state of P = Phi(P) with F P F' multiplied by `factor`, at |z| = 1; by floating point.
std::optional<Eigen::Matrix3d> scaled_steady_state(const IntervalDesign& design, double factor) {
  constexpr int kSteps = 2000;
  constexpr double kAtRest = 1e-10;
  const double q1 = rigor::midpoint(design.q1);
  const double q2 = rigor::midpoint(design.q2);
  const double r = rigor::midpoint(design.r);
  Eigen::Matrix3d transition = Eigen::Matrix3d::Identity();
  transition(1, 2) = 1.0;
  transition(2, 2) = 1.0 - rigor::midpoint(design.epsilon);
  const Eigen::Vector3d noise(q1, q1, q2);
  Eigen::Matrix3d covariance = Eigen::Vector3d(r, r, r + q2).asDiagonal();
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix3d predicted = factor * transition * covariance * transition.transpose();
    predicted.diagonal() += noise;
    Eigen::Matrix2d innovation = predicted.topLeftCorner<2, 2>();
    innovation.diagonal().array() += r;
    const Eigen::Matrix<double, 3, 2> seen = predicted.leftCols<2>();
    const Eigen::Matrix3d next = predicted - seen * innovation.inverse() * seen.transpose();
    const double change = (next - covariance).cwiseAbs().maxCoeff();
    covariance = 0.5 * (next + next.transpose());
    if (!covariance.allFinite()) {
      return std::nullopt;
    }
    if (change <= kAtRest * covariance.cwiseAbs().maxCoeff()) {
      return covariance;
    }
  }
  return std::nullopt;
}

/// The covariance after a step from `covariance`, in the frame of the predicted phase.
IntervalMatrix<3> after_step(const IntervalMatrix<3>& covariance, const IntervalDesign& design,
                             const ErrorBounds& tube) {
  using Covariance = trackers::PolarCovariance<Interval>;
  const IntervalMatrix<3> turn = tube.turn();
  const IntervalMatrix<3> own = turn * covariance * turn.transpose();
  const Covariance predicted =
      trackers::predicted_covariance(Covariance::from_matrix(own), tube.amplitude(), design);
  return trackers::filtered_covariance(predicted, trackers::gain(predicted, design.r), design.r).matrix();
}

}  // namespace

std::optional<MatrixRange> verified_range(const Eigen::Matrix3d& upper, const Eigen::Matrix3d& lower,
                                          const IntervalDesign& design, const ErrorBounds& tube) {
  MatrixRange range;
  range.upper = rigor::to_interval(upper);
  const IntervalMatrix<3> least = rigor::to_interval(lower);
  const IntervalMatrix<3> room_above = range.upper - after_step(range.upper, design, tube);
  const IntervalMatrix<3> room_below = after_step(least, design, tube) - least;
  if (rigor::conjunction({rigor::is_positive_definite(least), rigor::is_positive_definite(room_above),
                          rigor::is_positive_definite(room_below)}) != Verdict::proved) {
    return std::nullopt;
  }
  const auto inverse = rigor::inverse(least);
  const auto information = inverse ? point_above(*inverse) : std::nullopt;
  if (!information) {
    return std::nullopt;
  }
  range.information = *information;
  return range;
}

std::optional<MatrixRange> invariant_range(const IntervalDesign& design, const ErrorBounds& tube) {
  constexpr double kLargestShare = 0.75;
  double share = tube.plane_error.upper();
  while (share < kLargestShare) {
    const auto upper = scaled_steady_state(design, 1.0 + share);
    const auto lower = scaled_steady_state(design, 1.0 - share);
    if (!upper || !lower) {
      return std::nullopt;
    }
    if (auto range = verified_range(*upper, *lower, design, tube)) {
      return range;
    }
    share *= 1.5;
  }
  return std::nullopt;
}

}  // namespace veritrack::theorems

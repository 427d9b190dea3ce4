// The samples of an orbit of the tone: what of a filter depends on them only, not on the parameters of a
// proposal.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "analysis/model/filter/filter_numbers.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"
#include "analysis/model/steady_state/phase_grid.hpp"
#include "analysis/model/step/tube.hpp"

namespace veritrack::model::detail {

/// A matrix of series at a place, from its lower triangle.
inline MatrixXd matrix_at(const std::vector<PhaseSeries>& triangle, double phase, double z,
                          bool is_symmetric) {
  std::size_t most = 1;
  for (const PhaseSeries& series : triangle) {
    most = std::max(most, series.coefficients.size());
  }
  std::vector<std::pair<double, double>> harmonics;
  for (std::size_t h = 0; h < most; ++h) {
    const double angle = static_cast<double>(h) * phase;
    harmonics.emplace_back(std::cos(angle), std::sin(angle));
  }
  const std::vector<double> powers{1.0, z, z * z, z * z * z, z * z * z * z};
  Index rows = 0;
  while (rows * (rows + 1) / 2 < static_cast<Index>(triangle.size())) {
    ++rows;
  }
  MatrixXd matrix = MatrixXd::Zero(rows, rows);
  std::size_t place = 0;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j <= i; ++j) {
      matrix(i, j) = triangle[place++].at(harmonics, powers);
      if (is_symmetric) {
        matrix(j, i) = matrix(i, j);
      }
    }
  }
  return matrix;
}

/// A tube in which the estimate stays, at a frequency of its cell.
struct Surroundings {
  const Tube* tube = nullptr;
  double radius = 0.0;
  double z = 0.0;
};

/// A sample, on the curve. Matrices of their own sizes: there are many samples.
struct OrbitPoint {
  double phase = 0.0;
  VectorXd estimate;
  MatrixXd covariance;                     ///< updated, of the steady state
  Eigen::RowVectorXd gradient;             ///< of the frequency, in the estimate
  MatrixXd jacobian;                       ///< F at the estimate
  MatrixXd slope;                          ///< the derivative of f there
  VectorXd predicted;                      ///< f there: for the next sample
  std::vector<MatrixXd> changes;           ///< of F along each state
  std::vector<MatrixXd> changes_of_slope;  ///< of the derivative of f; empty when they are the same
  MatrixXd wide;                           ///< the tube around, if any
  VectorXd move;                           ///< how the curve moves with the frequency, if asked for
  /// From the sample before: the correction, and the innovation that belongs to it. A leak makes them other
  /// than 0 on the curve.
  VectorXd correction, innovation;
};

/// Along which they change: sum_i direction_i changes_i.
inline Small change_along(const std::vector<MatrixXd>& changes, const SmallVector& direction) {
  Small sum = direction[0] * changes[0];
  for (std::size_t i = 1; i < changes.size(); ++i) {
    sum += direction[static_cast<Index>(i)] * changes[i];
  }
  return sum;
}

/// Computes samples one after the other.
class OrbitWalk {
 public:
  /// `slope`: of the curve by the frequency, or none.
  OrbitWalk(const TrackedTone& tone, const NodeCurve& curve, const Surroundings& around,
            const Eigen::MatrixXcd* slope)
      : tone_(&tone), numbers_(tone), curve_(&curve), around_(around), slope_(slope) {}

  [[nodiscard]] const FilterNumbers& numbers() const { return numbers_; }
  [[nodiscard]] OrbitPoint first(double phase) {
    OrbitPoint point;
    fill(point, phase);
    return point;
  }
  [[nodiscard]] OrbitPoint after(const OrbitPoint& before) {
    OrbitPoint point;
    fill(point, before.phase + curve_->frequency);
    point.correction = point.estimate - before.predicted;
    const MatrixXd gain = point.covariance * numbers_.weighted().transpose();
    point.innovation = (gain.transpose() * gain).ldlt().solve(gain.transpose() * point.correction);
    return point;
  }

 private:
  void fill(OrbitPoint& point, double phase) {
    const Index n = numbers_.states();
    const VectorXd state = state_at(*curve_, phase);
    point.phase = phase;
    point.estimate = state.head(n);
    point.covariance.resize(n, n);
    Index place = n;
    for (Index i = 0; i < n; ++i) {
      for (Index j = i; j < n; ++j) {
        point.covariance(i, j) = point.covariance(j, i) = state[place++];
      }
    }
    point.gradient = tone_->step.frequency_gradient(state).leftCols(n);
    point.slope = numbers_.slope(point.estimate);
    for (Index j = 0; j < n; ++j) {
      // As far as the filter itself expects errors.
      const double variance = point.covariance(j, j);
      const double size = variance > 0.0 && std::isfinite(variance) ? std::sqrt(variance) : 1.0;
      SmallVector direction = SmallVector::Zero(n);
      direction[j] = size;
      point.changes.emplace_back(numbers_.change(point.estimate, direction) / size);
      if (numbers_.has_given_jacobian()) {
        point.changes_of_slope.emplace_back(numbers_.change_of_slope(point.estimate, direction) / size);
      }
    }
    point.jacobian = numbers_.jacobian(point.estimate);
    point.predicted = numbers_.predicted();
    if (around_.tube != nullptr) {
      point.wide = around_.radius * matrix_at(around_.tube->shape, phase, around_.z, false);
    }
    if (slope_ != nullptr) {
      point.move = value_at(*slope_, phase).head(n);
    }
  }

  const TrackedTone* tone_;
  FilterNumbers numbers_;
  const NodeCurve* curve_;
  Surroundings around_;
  const Eigen::MatrixXcd* slope_;
};

/// The first samples of an orbit, for many proposals.
class OrbitPoints {
 public:
  OrbitPoints(const TrackedTone& tone, const NodeCurve& curve, double first_phase,
              const Surroundings& around = {}, const Eigen::MatrixXcd* slope = nullptr) {
    OrbitWalk walk(tone, curve, around, slope);
    points_.reserve(kSamples);
    points_.push_back(walk.first(first_phase));
    while (points_.size() < kSamples) {
      OrbitPoint next = walk.after(points_.back());
      points_.push_back(std::move(next));
    }
  }
  /// Sample number `number`; none when it is not among them.
  [[nodiscard]] const OrbitPoint* find(std::size_t number) const {
    return number < points_.size() ? &points_[number] : nullptr;
  }

 private:
  /// More are seldom needed, and are computed then.
  static constexpr std::size_t kSamples = 128;
  std::vector<OrbitPoint> points_;
};

}  // namespace veritrack::model::detail

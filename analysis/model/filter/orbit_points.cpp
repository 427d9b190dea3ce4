#include "analysis/model/filter/orbit_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/steady_state/phase_grid.hpp"

namespace veritrack::model::detail {

MatrixXd matrix_at(const std::vector<PhaseSeries>& triangle, double phase, double z, bool is_symmetric) {
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

SmallMatrix change_along(const std::vector<MatrixXd>& changes, const SmallVector& direction) {
  SmallMatrix sum = direction[0] * changes[0];
  for (std::size_t i = 1; i < changes.size(); ++i) {
    sum += direction[static_cast<Index>(i)] * changes[i];
  }
  return sum;
}

OrbitPoint OrbitWalk::first(double phase) {
  OrbitPoint point;
  fill(point, phase);
  return point;
}

OrbitPoint OrbitWalk::after(const OrbitPoint& before) {
  OrbitPoint point;
  fill(point, before.phase + curve_->frequency);
  point.correction = point.estimate - before.predicted;
  const SmallMatrix gain = rigor::product_with_transpose(point.covariance, numbers_.weighted());
  const SmallMatrix transposed = rigor::transposed(gain);
  point.innovation = rigor::symmetric_solution(rigor::product(transposed, gain),
                                               rigor::product(transposed, point.correction));
  return point;
}

void OrbitWalk::fill(OrbitPoint& point, double phase) {
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
  fill_changes(point);
  point.jacobian = numbers_.jacobian(point.estimate);
  point.predicted = numbers_.predicted();
  if (around_.tube != nullptr) {
    point.wide = around_.radius * matrix_at(around_.tube->shape, phase, around_.z, false);
  }
  if (slope_ != nullptr) {
    point.move = value_at(*slope_, phase).head(n);
  }
}

void OrbitWalk::fill_changes(OrbitPoint& point) {
  const Index n = numbers_.states();
  for (Index j = 0; j < n; ++j) {
    // As far as the filter itself expects errors.
    const double variance = point.covariance(j, j);
    const double size = variance > 0.0 && std::isfinite(variance) ? std::sqrt(variance) : 1.0;
    SmallVector direction = SmallVector::Zero(n);
    direction[j] = size;
    point.changes.emplace_back(numbers_.change(point.estimate, direction));
    point.changes.back() /= size;
    if (numbers_.has_given_jacobian()) {
      point.changes_of_slope.emplace_back(numbers_.change_of_slope(point.estimate, direction));
      point.changes_of_slope.back() /= size;
    }
  }
}

OrbitPoints::OrbitPoints(const TrackedTone& tone, const NodeCurve& curve, double first_phase,
                         const Surroundings& around, const Eigen::MatrixXcd* slope) {
  constexpr std::size_t kSamples = 128;  // more are seldom needed, and are computed then
  OrbitWalk walk(tone, curve, around, slope);
  points_.reserve(kSamples);
  points_.push_back(walk.first(first_phase));
  while (points_.size() < kSamples) {
    OrbitPoint next = walk.after(points_.back());
    points_.push_back(std::move(next));
  }
}

}  // namespace veritrack::model::detail

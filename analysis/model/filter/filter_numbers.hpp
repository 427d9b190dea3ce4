// The parts of a filter in doubles, for proposals.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "analysis/model/steady_state/curve_fit.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::model::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Matrices of a filter of at most ten states without allocations.
inline constexpr int kMostStates = 10;
inline constexpr int kMostRows = kMostStates + 2;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostStates * kMostStates>;

/// The parts of a filter in doubles.
class FilterNumbers {
 public:
  explicit FilterNumbers(const TrackedTone& tone)
      : parts_(tone.filter), inputs_(tone.step.constants()), constants_(inputs_.size()) {
    inputs_.resize(constants_ + static_cast<std::size_t>(parts_->states + parts_->samples), 1.0);
    const auto values = trackers::filter_values(*parts_, inputs_);
    const Index n = parts_->states;
    const Index c = parts_->samples;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    measured_ = Eigen::Map<const RowMajor>(values.measured.data(), c, n);
    process_ = Eigen::Map<const RowMajor>(values.process.data(), n, n);
    noise_ = Eigen::Map<const RowMajor>(values.noise.data(), c, c);
    weighted_ = noise_.inverse() * measured_;
  }
  [[nodiscard]] bool has_given_jacobian() const { return parts_->has_given_jacobian; }
  [[nodiscard]] Index states() const { return parts_->states; }
  [[nodiscard]] const Small& measured() const { return measured_; }
  [[nodiscard]] const Small& weighted() const { return weighted_; }  ///< R^-1 H
  [[nodiscard]] const Small& process() const { return process_; }
  [[nodiscard]] Small jacobian(const SmallVector& estimate) {
    std::copy(estimate.begin(), estimate.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(constants_));
    results_.resize(parts_->program.results().size());
    parts_->program.run(std::span<const double>(inputs_), registers_, std::span<double>(results_));
    const Index n = states();
    Small f(n, n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        f(i, j) = results_[static_cast<std::size_t>(n + i * n + j)];
      }
    }
    return f;
  }
  /// The prediction from the estimate of which the Jacobian was asked last.
  [[nodiscard]] SmallVector predicted() const {
    return Eigen::Map<const VectorXd>(results_.data(), states());
  }
  /// The derivative of f, by which errors change: F itself, unless that is given.
  [[nodiscard]] Small slope(const SmallVector& estimate) {
    if (!parts_->has_given_jacobian) {
      return jacobian(estimate);
    }
    constexpr double kPart = 1e-5;
    const Index n = states();
    Small f(n, n);
    for (Index j = 0; j < n; ++j) {
      const double change = kPart * std::max(1e-3, std::fabs(estimate[j]));
      SmallVector higher = estimate;
      SmallVector lower = estimate;
      higher[j] += change;
      lower[j] -= change;
      (void)jacobian(higher);
      const SmallVector above = predicted();
      (void)jacobian(lower);
      f.col(j) = (above - predicted()) / (2.0 * change);
    }
    return f;
  }
  /// The change of F along a direction.
  [[nodiscard]] Small change(const SmallVector& estimate, const SmallVector& direction) {
    constexpr double kPart = 1e-4;
    return (jacobian(estimate + kPart * direction) - jacobian(estimate - kPart * direction)) / (2.0 * kPart);
  }
  /// The change of the derivative of f along a direction.
  [[nodiscard]] Small change_of_slope(const SmallVector& estimate, const SmallVector& direction) {
    constexpr double kPart = 1e-3;
    return parts_->has_given_jacobian
               ? Small((slope(estimate + kPart * direction) - slope(estimate - kPart * direction)) /
                       (2.0 * kPart))
               : change(estimate, direction);
  }
  [[nodiscard]] Small updated(const Small& predicted) const {
    const Small cross = measured_ * predicted;
    const Small result =
        predicted - cross.transpose() * (cross * measured_.transpose() + noise_).ldlt().solve(cross);
    return 0.5 * (result + result.transpose());
  }

 private:
  const trackers::FilterParts* parts_;
  std::vector<double> inputs_, registers_, results_;
  std::size_t constants_;
  Small measured_, process_, noise_, weighted_;
};

}  // namespace veritrack::model::detail

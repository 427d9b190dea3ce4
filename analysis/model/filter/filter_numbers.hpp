// The parts of a filter in doubles, for proposals.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/model/steady_state/curve_fit.hpp"
#include "analysis/rigor/small_matrix.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::model::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using rigor::SmallMatrix;
using rigor::SmallVector;

/// The most states of a filter for which tubes are proposed.
inline constexpr int kMostStates = 10;

/// The parts of a filter in doubles.
class FilterNumbers {
 public:
  explicit FilterNumbers(const TrackedTone& tone);
  [[nodiscard]] bool has_given_jacobian() const { return parts_->has_given_jacobian; }
  [[nodiscard]] Index states() const { return parts_->states; }
  [[nodiscard]] const SmallMatrix& measured() const { return measured_; }
  [[nodiscard]] const SmallMatrix& weighted() const { return weighted_; }  ///< R^-1 H
  [[nodiscard]] const SmallMatrix& process() const { return process_; }
  [[nodiscard]] SmallMatrix jacobian(const SmallVector& estimate);
  /// The prediction from the estimate whose Jacobian was computed last.
  [[nodiscard]] SmallVector predicted() const;
  /// The derivative of f, by which errors change: F itself, unless that is given.
  [[nodiscard]] SmallMatrix slope(const SmallVector& estimate);
  /// The change of F along a direction.
  [[nodiscard]] SmallMatrix change(const SmallVector& estimate, const SmallVector& direction);
  /// The change of the derivative of f along a direction.
  [[nodiscard]] SmallMatrix change_of_slope(const SmallVector& estimate, const SmallVector& direction);
  /// The covariance after a sample.
  [[nodiscard]] SmallMatrix updated(const SmallMatrix& predicted) const;

 private:
  const trackers::FilterParts* parts_;
  std::vector<double> inputs_, registers_, results_;
  std::size_t constants_;
  SmallMatrix measured_, process_, noise_, weighted_;
};

}  // namespace veritrack::model::detail

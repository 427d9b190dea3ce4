// The samples of an orbit of the tone: the quantities of a filter that depend on them only, not on the
// parameters of a proposal.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/model/filter/filter_numbers.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"
#include "analysis/model/step/tube.hpp"

namespace veritrack::model::detail {

/// A matrix of series at a place, from its lower triangle.
[[nodiscard]] MatrixXd matrix_at(const std::vector<PhaseSeries>& triangle, double phase, double z,
                                 bool is_symmetric);

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
  VectorXd move;                           ///< the derivative of the curve by the frequency, if requested
  /// From the sample before: the correction and its innovation. With a leak they are not 0 on the curve.
  VectorXd correction, innovation;
};

/// Along which they change: sum_i direction_i changes_i.
[[nodiscard]] SmallMatrix change_along(const std::vector<MatrixXd>& changes, const SmallVector& direction);

/// Computes samples one after the other.
class OrbitWalk {
 public:
  /// `slope`: of the curve by the frequency, or none.
  OrbitWalk(const TrackedTone& tone, const NodeCurve& curve, const Surroundings& around,
            const Eigen::MatrixXcd* slope)
      : tone_(&tone), numbers_(tone), curve_(&curve), around_(around), slope_(slope) {}

  [[nodiscard]] const FilterNumbers& numbers() const { return numbers_; }
  [[nodiscard]] OrbitPoint first(double phase);
  [[nodiscard]] OrbitPoint after(const OrbitPoint& before);

 private:
  void fill(OrbitPoint& point, double phase);
  void fill_changes(OrbitPoint& point);

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
              const Surroundings& around = {}, const Eigen::MatrixXcd* slope = nullptr);
  /// Sample number `number`; none when it is not among them.
  [[nodiscard]] const OrbitPoint* find(std::size_t number) const {
    return number < points_.size() ? &points_[number] : nullptr;
  }

 private:
  std::vector<OrbitPoint> points_;
};

}  // namespace veritrack::model::detail

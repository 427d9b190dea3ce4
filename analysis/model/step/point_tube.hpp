// A tube in floating point, at one frequency: for simulations and pictures, without any claim.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <vector>

#include "analysis/model/step/tube_step.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::model {

/// Curve and shape at a phase.
struct PointFrame {
  Eigen::VectorXd curve;
  Eigen::MatrixXd shape;  ///< lower triangular
  /// For a tube that bounds a covariance: the middle of the bounds of the predicted one; otherwise without
  /// rows.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd spread;  ///< and half of their difference

  /// For a filter with such a tube: the estimate alone.
  [[nodiscard]] Eigen::VectorXd state(const Eigen::VectorXd& coordinates) const {
    return curve + shape * coordinates;
  }
  /// xi with state = C + U xi. For a filter, the covariance is left aside.
  [[nodiscard]] Eigen::VectorXd coordinates(const Eigen::VectorXd& state) const;
};

/// A tube at the frequency of one tone.
class PointTube {
 public:
  /// `frequency` in rad/sample, of the tube's cell. `tube` must outlive the object.
  PointTube(const Tube& tube, double frequency);

  /// The same tube at another frequency.
  void move_to(double frequency);

  /// The frame at this phase, rad, into `frame`.
  void at(double phase, PointFrame& frame) const;

 private:
  [[nodiscard]] const PhaseSeries& series_of(std::size_t number) const;

  const Tube* tube_;
  double frequency_ = NAN;
  // Harmonics of the curve, then of the lower triangle of the shape and those of the bounds of a covariance,
  // the powers of z summed up.
  std::vector<std::vector<std::complex<double>>> series_;
  std::size_t harmonics_ = 0;
};

/// A tracker on its signal in doubles: the constants are the middles of their intervals.
class PointTracker {
 public:
  /// `model` must outlive the tracker.
  explicit PointTracker(const TrackerModel& model);

  [[nodiscard]] int states() const { return model_->recursion->states; }
  [[nodiscard]] int channels() const { return model_->recursion->samples; }
  /// The samples at this phase, without noise, at the middle of the amplitudes.
  [[nodiscard]] Eigen::VectorXd samples(double phase);
  /// At an amplitude of the range: 0 is the least, 1 the largest.
  [[nodiscard]] Eigen::VectorXd samples(double phase, double place);
  /// The state at these coordinates; for a filter with a tube that bounds the covariance, with the covariance
  /// that follows from the middle of its bounds, or from this one `between` them: symmetric, of a norm of at
  /// most 1.
  [[nodiscard]] Eigen::VectorXd state(const PointFrame& frame, const Eigen::VectorXd& coordinates,
                                      const Eigen::MatrixXd& between = {});
  /// The next state.
  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& state, const Eigen::VectorXd& samples);
  /// The estimated frequency, rad/sample.
  [[nodiscard]] double frequency(const Eigen::VectorXd& state);

 private:
  const TrackerModel* model_;
  std::vector<double> signal_inputs_, step_inputs_, frequency_inputs_, registers_;
};

}  // namespace veritrack::model

// Derivatives of a tracker's step, in floating point: for proposals.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/model/step/tube.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::model {

/// All derivatives of the next state up to the third order, at a state and its samples.
struct StepDerivatives {
  Eigen::MatrixXd state;   ///< n x n
  Eigen::MatrixXd sample;  ///< n x samples
  /// One Hessian for each next state, over states and then samples.
  std::vector<Eigen::MatrixXd> second;
  /// n x n^3: the third derivatives of next state i in states j, k, l stand in row i, column (j n + k) n + l.
  Eigen::MatrixXd third;
};

/// A tracker of which the constants have values.
class StepMap {
 public:
  /// Throws std::invalid_argument when the number of constants is wrong.
  StepMap(const trackers::Recursion& recursion, const std::vector<double>& constants);

  [[nodiscard]] const trackers::Recursion& recursion() const { return recursion_; }
  [[nodiscard]] const std::vector<double>& constants() const { return constants_; }
  [[nodiscard]] int states() const { return recursion_.states; }
  [[nodiscard]] int samples() const { return recursion_.samples; }

  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& state, const Eigen::VectorXd& samples) const;
  /// n x (n + samples).
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& state, const Eigen::VectorXd& samples) const;
  /// `scale`: the size of changes of each state, by which the directions are weighed.
  [[nodiscard]] StepDerivatives derivatives(const Eigen::VectorXd& state, const Eigen::VectorXd& samples,
                                            const Eigen::VectorXd& scale) const;
  /// The estimated frequency, rad/sample, and its gradient over the states.
  [[nodiscard]] double frequency(const Eigen::VectorXd& state) const;
  [[nodiscard]] Eigen::RowVectorXd frequency_gradient(const Eigen::VectorXd& state) const;
  /// Its second derivatives.
  [[nodiscard]] Eigen::MatrixXd frequency_hessian(const Eigen::VectorXd& state) const;

 private:
  trackers::Recursion recursion_;
  std::vector<double> constants_;
};

/// The samples of one instant at this phase of the signal.
[[nodiscard]] Eigen::VectorXd samples_of(const Signal& signal, double amplitude, double phase);

}  // namespace veritrack::model

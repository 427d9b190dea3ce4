// Functions of the phase on a uniform grid of an odd number of phases, as trigonometric polynomials.
#pragma once

#include <Eigen/Core>

namespace veritrack::model {

/// The phases 2 pi j / size(). A function on the grid is a row of size() values, several are a matrix of
/// (components) x size().
class PhaseGrid {
 public:
  /// A grid of 2 harmonics + 1 phases.
  explicit PhaseGrid(int harmonics) : harmonics_(harmonics) {}

  [[nodiscard]] int harmonics() const { return harmonics_; }
  [[nodiscard]] int size() const { return 2 * harmonics_ + 1; }
  [[nodiscard]] double phase(int j) const;

  /// size() x size(): values on the grid times it are the values at phase + shift, of the trigonometric
  /// polynomial through the former, without its harmonics above `harmonics`.
  [[nodiscard]] Eigen::MatrixXd shift(double shift, int harmonics) const;
  [[nodiscard]] Eigen::MatrixXd shift(double shift) const { return this->shift(shift, harmonics_); }

 private:
  int harmonics_;
};

/// (components) x (harmonics + 1): c_h of the functions Re sum_h c_h exp(i h phi) whose values at any number
/// of uniform phases, more than 2 harmonics, are given; harmonics above are left out.
[[nodiscard]] Eigen::MatrixXcd harmonics_of(const Eigen::MatrixXd& values, int harmonics);

/// Re sum_h c_h exp(i h phi) for each row of coefficients.
[[nodiscard]] Eigen::VectorXd value_at(const Eigen::MatrixXcd& coefficients, double phase);

}  // namespace veritrack::model

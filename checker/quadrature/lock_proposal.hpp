// Proposals in floating point for the cells of a set: a multiplier, a level of the images, weights. Nothing
// rests on them: results that use them are verified in balls.
#pragma once

#include <array>

#include "checker/quadrature/lock_form.hpp"

namespace veritrack::checker::lock_proposal {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Matrix6 = std::array<std::array<double, lock_form::kSize>, lock_form::kSize>;

/// The nearest doubles to the lower triangle.
template <std::size_t Size>
std::array<std::array<double, Size>, Size> near(const SquareMatrix<Size>& x) {
  std::array<std::array<double, Size>, Size> y{};
  for (std::size_t i = 0; i < Size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      y[i][j] = x[i][j].near();
    }
  }
  return y;
}

/// The least t >= 0 with upper <= P_0 + t D_h and lower^-1 <= P_0^-1 + t D_l.
class LevelOf {
 public:
  /// P_0, D_h, P_0^-1 and D_l in the coordinates of the images.
  LevelOf(const Matrix3& centre, const Matrix3& above, const Matrix3& centre_inverse, const Matrix3& below);
  /// "Not a number" when `lower` is not definite.
  [[nodiscard]] double operator()(const Matrix3& upper, const Matrix3& lower) const;

 private:
  Matrix3 centre_, above_, centre_inverse_, below_;  ///< of D_h and D_l: L^-1, D = L L'
};

/// An affine function that is nowhere below the numbers at the corners of a box in (u, s): its value in the
/// middle, and its change over half the width of each variable.
struct LevelPlane {
  double middle = 0.0;
  std::array<double, kSides + 1> along{};
};
LevelPlane plane_above(const std::array<double, 16>& levels);

/// lock_form::left_over in doubles; minus infinity where that gives no bound.
double left_over(Matrix6 n);

/// The entries at the two ends of s, without constants and multiplier, and l there.
struct Ends {
  std::array<Matrix6, 2> parts;
  std::array<double, 2> rest;
};
/// The multiplier for which the smaller left_over of the two ends is largest.
double propose_multiplier(const Ends& ends, const Matrix6& constant, double deviation, double r);
/// The matrix for a multiplier.
Matrix6 form(const Matrix6& parts, const Matrix6& constant, double rest,
             const lock_form::Factors<double>& factors);

/// Weights for take_rest: how much each row affects left_over, and a little more.
std::array<double, lock_form::kSize> propose_weights(const Matrix6& n);

}  // namespace veritrack::checker::lock_proposal

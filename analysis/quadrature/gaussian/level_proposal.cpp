#include "analysis/quadrature/gaussian/level_proposal.hpp"

#include <Eigen/LU>

#include "analysis/rigor/symmetric_three.hpp"

namespace veritrack::quadrature {

namespace {

using Matrix = Eigen::Matrix3d;

Matrix whole(const SymmetricMatrix<double>& x) {
  Matrix m;
  m << x[0][0], x[1][0], x[2][0], x[1][0], x[1][1], x[2][1], x[2][0], x[2][1], x[2][2];
  return m;
}

/// The largest t with det(x - t y) = 0 for y > 0, and its vector v, v'y v = 1.
struct Largest {
  double value;
  Eigen::Vector3d vector;
};
Largest largest(const Matrix& x, const Matrix& y) {
  const rigor::ThreeEigensystem system = rigor::pencil_of_three(x, y);
  return {system.values[2], system.vectors.col(2)};
}

}  // namespace

LevelSlope propose_level(const LockSetting<double>& setting, const LevelStep<double>& step,
                         const std::array<LevelStep<double>, 3>& derivatives) {
  const Largest above = largest(whole(step.upper.covariance) - whole(symmetric_of(setting.centre)),
                                whole(symmetric_of(setting.spread_above)));
  const Matrix inverse = whole(step.lower.covariance).inverse();
  const Largest below = largest(inverse - whole(symmetric_of(setting.centre_inverse)),
                                whole(symmetric_of(setting.spread_below)));
  LevelSlope result;
  const bool up = above.value > below.value;
  result.level = up ? above.value : below.value;
  const Eigen::Vector3d pulled = inverse * below.vector;
  const auto slope = [&](const SymmetricMatrix<double>& upper, const SymmetricMatrix<double>& lower) {
    return up ? above.vector.dot(whole(upper) * above.vector) : -pulled.dot(whole(lower) * pulled);
  };
  for (std::size_t i = 0; i < result.along.size(); ++i) {
    result.along[i] = slope(derivatives[i].upper.covariance, derivatives[i].lower.covariance);
  }
  result.with_level = slope(step.upper.slope, step.lower.slope);
  return result;
}

}  // namespace veritrack::quadrature

// The least rate that multipliers can show, by Newton's method in floating point: for proposals only.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace veritrack::quadrature {

/// w_1 m_1 + ... + w_N m_N + c' (I - X_1/m_1 - ... - X_N/m_N)^-1 c, X_i >= 0, as a function of the logarithms
/// of the multipliers m_i. It is convex, as the inverse is operator monotone and convex.
template <int N>
class RateDescent {
 public:
  using Multipliers = Eigen::Matrix<double, N, 1>;
  using Gains = std::array<Eigen::Matrix3d, static_cast<std::size_t>(N)>;

  /// Its value there; infinity where the inverse is not positive definite, or nothing was found.
  struct Point {
    double value = std::numeric_limits<double>::infinity();
    Multipliers multipliers = Multipliers::Ones();
  };

  RateDescent(const Eigen::Vector3d& image, const Gains& gains, const Multipliers& weights)
      : image_(image), gains_(gains), weights_(weights.cwiseMax(1e-9)) {}

  [[nodiscard]] const Multipliers& weights() const { return weights_; }

  /// Goes down from multipliers that are sure to make the inverse definite.
  [[nodiscard]] Point least() const {
    constexpr int kSteps = 12;
    constexpr int kHalvings = 6;
    constexpr double kEnough = 1e-4;
    constexpr double kLongest = 2.0;
    Multipliers best = feasible();
    double least = value(best);
    if (!std::isfinite(least)) {
      return {};
    }
    for (int i = 0; i < kSteps; ++i) {
      Multipliers step = newton_step(best);
      step *= std::min(1.0, kLongest / step.cwiseAbs().maxCoeff());
      double trial = value(best + step);
      for (int halving = 0; halving < kHalvings && !(trial < least); ++halving) {
        step *= 0.5;
        trial = value(best + step);
      }
      if (!(trial < least)) {
        break;
      }
      const double gained = least - trial;
      best += step;
      least = trial;
      if (gained < kEnough * least) {
        break;
      }
    }
    return {least, best.array().exp()};
  }

 private:
  [[nodiscard]] const Eigen::Matrix3d& gain(Eigen::Index i) const {
    return gains_[static_cast<std::size_t>(i)];
  }

  /// The logarithms of multipliers for which I - sum X_i/m_i is positive definite.
  [[nodiscard]] Multipliers feasible() const {
    constexpr double kRoom = 1.5;
    Multipliers roots;
    for (Eigen::Index i = 0; i < N; ++i) {
      roots[i] = std::sqrt(std::max(gain(i).trace(), 1e-300) / weights_[i]);
    }
    return (kRoom * roots.dot(weights_) * roots).array().log();
  }

  [[nodiscard]] double value(const Multipliers& logarithms) const {
    const Multipliers m = logarithms.array().exp();
    const Eigen::LLT<Eigen::Matrix3d> gap(left_by(m));
    if (gap.info() != Eigen::Success) {
      return std::numeric_limits<double>::infinity();
    }
    return weights_.dot(m) + image_.dot(gap.solve(image_));
  }

  [[nodiscard]] Multipliers newton_step(const Multipliers& logarithms) const {
    const Multipliers m = logarithms.array().exp();
    const Eigen::Matrix3d inverse = left_by(m).inverse();
    const Eigen::Vector3d y = inverse * image_;
    Eigen::Matrix<double, 3, N> pushed;
    for (Eigen::Index i = 0; i < N; ++i) {
      pushed.col(i) = gain(i) * y / m[i];
    }
    const Multipliers pulled = pushed.transpose() * y;
    const Multipliers held = weights_.cwiseProduct(m);
    Eigen::Matrix<double, N, N> curvature = 2.0 * pushed.transpose() * inverse * pushed;
    curvature.diagonal() += held + pulled;
    return curvature.ldlt().solve(pulled - held);
  }

  [[nodiscard]] Eigen::Matrix3d left_by(const Multipliers& m) const {
    Eigen::Matrix3d left = Eigen::Matrix3d::Identity();
    for (Eigen::Index i = 0; i < N; ++i) {
      left -= gain(i) / m[i];
    }
    return left;
  }

  Eigen::Vector3d image_;
  Gains gains_;
  Multipliers weights_;
};

}  // namespace veritrack::quadrature

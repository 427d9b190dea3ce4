#include "analysis/quadrature/leak/steady_multipliers.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace veritrack::quadrature {

namespace {

/// mu, lambda, sigma and tau.
using Four = Eigen::Vector4d;
constexpr Eigen::Index kTau = 3;
constexpr Eigen::Index kGains = 3;

/// The rate squared that multipliers certify: with A = I - sum_i X_i/m_i it is
///     (image + S d)' A^-1 (image + S d) + mu (1 - |q + d|^2) + tau (size^2 - |d|^2) + lambda eta^2 + sigma
///     V^2
/// at the d where that is the largest, for which (mu + tau) I - S' A^-1 S must be positive definite. It is
/// convex in the multipliers.
struct Rate {
  double squared = std::numeric_limits<double>::infinity();
  Four slope = Four::Zero();  ///< its derivatives by the multipliers
  Eigen::Matrix4d curvature = Eigen::Matrix4d::Zero();
};

class CellRate {
 public:
  explicit CellRate(const SteadyCellReach& cell)
      : image_(cell.reach.image[0], cell.reach.image[1], cell.reach.image[2]),
        slopes_(cell.slopes),
        middle_(cell.middle),
        weights_(
            Four(1.0, cell.reach.eta_squared, cell.reach.noise_squared, cell.size_squared).cwiseMax(1e-9)) {
    const Eigen::Vector3d hidden(cell.reach.hidden[0], cell.reach.hidden[1], cell.reach.hidden[2]);
    gains_ = {hidden * hidden.transpose(), cell.reach.gram.matrix(), cell.reach.noise.matrix()};
  }

  /// Multipliers for which the rate is finite.
  [[nodiscard]] Four feasible() const {
    Four m;
    for (Eigen::Index i = 0; i < kGains; ++i) {
      const double trace = gain(i).trace() + (i == 0 ? slopes_.squaredNorm() : 0.0);
      m[i] = std::sqrt(std::max(trace, 1e-300) / weights_[i]);
    }
    m.head<3>() *= 1.5 * m.head<3>().dot(weights_.head<3>());
    m[kTau] = m[0];
    return m;
  }

  [[nodiscard]] Rate at(const Four& m) const {
    Rate rate;
    const Eigen::LLT<Eigen::Matrix3d> gap(Eigen::Matrix3d::Identity() - gain(0) / m[0] - gain(1) / m[1] -
                                          gain(2) / m[2]);
    if (gap.info() != Eigen::Success) {
      return rate;
    }
    const Eigen::Matrix3d inverse = gap.solve(Eigen::Matrix3d::Identity());
    const Eigen::LLT<Eigen::Matrix2d> bend((m[0] + m[kTau]) * Eigen::Matrix2d::Identity() -
                                           slopes_.transpose() * inverse * slopes_);
    if (bend.info() != Eigen::Success) {
      return rate;
    }
    const Eigen::Vector2d d = bend.solve(slopes_.transpose() * inverse * image_ - m[0] * middle_);
    const Eigen::Vector2d place = middle_ + d;
    const Eigen::Vector3d image = image_ + slopes_ * d;
    const Eigen::Vector3d y = inverse * image;
    rate.slope = weights_;
    rate.slope[0] -= place.squaredNorm();
    rate.slope[kTau] -= d.squaredNorm();
    rate.squared = image.dot(y) + m.dot(rate.slope);
    Eigen::Matrix<double, 3, 4> pushed = Eigen::Matrix<double, 3, 4>::Zero();
    Four pulled = Four::Zero();
    for (Eigen::Index i = 0; i < kGains; ++i) {
      pushed.col(i) = gain(i) * y / (m[i] * m[i]);
      pulled[i] = y.dot(pushed.col(i));
    }
    // Half the derivatives by d of those by the multipliers.
    Eigen::Matrix<double, 2, 4> cross = -slopes_.transpose() * inverse * pushed;
    cross.col(0) -= place;
    cross.col(kTau) -= d;
    rate.slope -= pulled;
    rate.curvature = 2.0 * (pushed.transpose() * inverse * pushed + cross.transpose() * bend.solve(cross));
    rate.curvature.diagonal() += 2.0 * pulled.cwiseQuotient(m);
    return rate;
  }

  [[nodiscard]] const Four& weights() const { return weights_; }

 private:
  [[nodiscard]] const Eigen::Matrix3d& gain(Eigen::Index i) const {
    return gains_[static_cast<std::size_t>(i)];
  }

  Eigen::Vector3d image_;
  Eigen::Matrix<double, 3, 2> slopes_;
  Eigen::Vector2d middle_;
  Four weights_;
  std::array<Eigen::Matrix3d, 3> gains_;
};

/// Newton's step of the logarithms of the multipliers; of the curvature that logarithms add only what is
/// positive is taken.
Four newton_step(const Rate& rate, const Four& m) {
  constexpr double kLongest = 3.0;
  const Four fall = -m.cwiseProduct(rate.slope);
  Eigen::Matrix4d curvature = m.asDiagonal() * rate.curvature * m.asDiagonal();
  curvature.diagonal() += (-fall).cwiseMax(0.0) + 1e-6 * fall.cwiseAbs() + Four::Constant(1e-12);
  return curvature.ldlt().solve(fall).cwiseMax(-kLongest).cwiseMin(kLongest);
}

}  // namespace

SteadyRate propose_cell_rate(const SteadyCellReach& cell, double target_squared) {
  constexpr int kSteps = 25;
  constexpr int kHalvings = 8;
  constexpr double kEnough = 1e-5;
  const CellRate rates(cell);
  Four m = rates.feasible();
  Rate best = rates.at(m);
  for (int i = 0; i < kSteps && std::isfinite(best.squared); ++i) {
    Four step = newton_step(best, m);
    Rate found;
    for (int halving = 0; halving < kHalvings && !(found.squared < best.squared); ++halving) {
      found = rates.at(m.cwiseProduct(step.array().exp().matrix()));
      step *= 0.5;
    }
    if (!(found.squared < best.squared)) {
      break;
    }
    m = m.cwiseProduct((2.0 * step).array().exp().matrix());
    const bool slow = found.squared > (1.0 - kEnough) * best.squared;
    best = found;
    if (slow) {
      break;
    }
  }
  const double left = target_squared - best.squared;
  for (Eigen::Index i = 0; i < kGains && left > 0.0; ++i) {
    constexpr double kShare = 0.1;  // of what is left, for each of the multipliers
    m[i] += std::min(kShare * left / rates.weights()[i], m[i]);
  }
  return {best.squared, {m[0], m[1], m[2], m[kTau]}};
}

}  // namespace veritrack::quadrature

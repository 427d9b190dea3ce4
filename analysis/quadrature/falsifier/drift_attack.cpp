#include "analysis/quadrature/falsifier/drift_attack.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "analysis/search/maximize.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d matrix_of(const LevelCovariance<double>& p) {
  Matrix3d m;
  m << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return m;
}

/// A set as matrices.
class LockFunction {
 public:
  LockFunction(const LockSet& set, const trackers::ToneModel<double>& design)
      : set_(set),
        design_(design),
        centre_(matrix_of(set.centre)),
        centre_inverse_(centre_.inverse()),
        above_(matrix_of(set.spread_above)),
        below_(matrix_of(set.spread_below)) {
    metric_ << set.metric.amplitude, 0.0, 0.0, 0.0, set.metric.phase, set.metric.coupling, 0.0, 0.0,
        set.metric.frequency;
  }

  [[nodiscard]] Matrix3d high(double s) const { return centre_ + s * above_; }
  [[nodiscard]] Matrix3d low(double s) const { return (centre_inverse_ + s * below_).inverse(); }
  [[nodiscard]] Vector3d error_of(const Vector3d& u) const {
    return metric_.triangularView<Eigen::Upper>().solve(u);
  }

  [[nodiscard]] double covariance_level(const Matrix3d& p) const {
    const auto largest = [](const Matrix3d& x, const Matrix3d& y) {
      return rigor::pencil_eigensystem(x, y).values[2];
    };
    return std::max({0.0, largest(p - centre_, above_), largest(p.inverse() - centre_inverse_, below_)});
  }

  [[nodiscard]] double excess(const DriftPoint& point) const {
    const Vector3d& e = point.error;
    Matrix3d f = Matrix3d::Identity();
    f(0, 2) = -e[1];
    f(1, 2) = 1.0 + e[0];
    const Matrix3d predicted = f * point.covariance * f.transpose() +
                               Vector3d(design_.q1, design_.q1, design_.q2).asDiagonal().toDenseMatrix();
    const Eigen::Matrix2d innovation =
        predicted.topLeftCorner<2, 2>() + design_.r * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 3, 2> gain = predicted.leftCols<2>() * innovation.inverse();
    const Matrix3d filtered = predicted - gain * predicted.topRows<2>();
    const Vector3d before(1.0 + e[0] - std::cos(e[2]), e[1] + std::sin(e[2]), e[2]);
    Matrix3d turn = Matrix3d::Identity();
    turn(0, 0) = turn(1, 1) = std::cos(e[2]);
    turn(1, 0) = std::sin(e[2]);
    turn(0, 1) = -turn(1, 0);
    // T times the mean and the deviation of what comes next.
    const Vector3d mean = metric_ * turn * (before - gain * before.head<2>());
    const Eigen::Matrix<double, 3, 2> spread = set_.noise_deviation * metric_ * turn * gain;
    const Vector3d walked = set_.frequency_walk * metric_.col(2);
    const Matrix3d left = Matrix3d::Identity() - spread * spread.transpose() - walked * walked.transpose();
    const Eigen::LLT<Matrix3d> factor(left);
    if (factor.info() != Eigen::Success) {
      return std::numeric_limits<double>::infinity();
    }
    const double log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    const double next = covariance_level(turn * filtered * turn.transpose());
    const double now = covariance_level(point.covariance);
    const double level = 0.5 * (metric_ * e).squaredNorm() + 0.5 * set_.weight * now * now;
    return 0.5 * mean.dot(factor.solve(mean)) - 0.5 * log_determinant + 0.5 * set_.weight * next * next -
           level - std::log(set_.decay + set_.drift * std::exp(-level));
  }

 private:
  const LockSet& set_;
  const trackers::ToneModel<double>& design_;
  Matrix3d centre_, centre_inverse_, above_, below_, metric_;
};

/// Four numbers for the direction in (T e, s), one for the share of the level, six for the covariance.
constexpr Eigen::Index kNumbers = 11;

/// The state of the set that these numbers stand for.
DriftPoint point_of(const LockSet& set, const LockFunction& function, const Eigen::VectorXd& x) {
  Eigen::Vector4d direction = x.head<4>();
  direction /= std::max(direction.norm(), 1e-12);
  const double radius = std::sqrt(2.0 * set.level) * std::fabs(std::sin(x[4]));
  const double s = radius * std::fabs(direction[3]) / std::sqrt(set.weight);
  // Between lo(s) and hi(s), as Y goes from -I to I.
  const Matrix3d turn =
      (Eigen::AngleAxisd(x[5], Vector3d::UnitX()) * Eigen::AngleAxisd(x[6], Vector3d::UnitY()) *
       Eigen::AngleAxisd(x[7], Vector3d::UnitZ()))
          .toRotationMatrix();
  const Matrix3d share = turn * x.segment<3>(8).array().sin().matrix().asDiagonal() * turn.transpose();
  const Matrix3d low = function.low(s);
  const Matrix3d half = 0.5 * (function.high(s) - low);
  const rigor::Eigensystem eigen = rigor::symmetric_eigensystem(half);
  const Matrix3d root = eigen.vectors * eigen.values.cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
  const Matrix3d p = low + half + root * share * root;
  return {function.error_of(radius * direction.head<3>()), 0.5 * (p + p.transpose())};
}

}  // namespace

double drift_excess(const LockSet& set, const trackers::ToneModel<double>& design, const DriftPoint& point) {
  return LockFunction(set, design).excess(point);
}

DriftAttack attack_drift(const LockSet& set, const trackers::ToneModel<double>& design, int starts) {
  const rigor::NearestRounding nearest;
  const LockFunction function(set, design);
  trackers::RandomStream random(20261124);
  DriftAttack result;
  result.closest = -std::numeric_limits<double>::infinity();
  const auto value = [&](const Eigen::VectorXd& x) {
    const DriftPoint point = point_of(set, function, x);
    // At s = 0 the square root of nothing may be NaN.
    const double excess = point.covariance.allFinite() ? function.excess(point) : -1.0;
    ++result.evaluations;
    if (excess > result.closest) {
      result.closest = excess;
      result.point = point;
    }
    return excess;
  };
  search::SearchSpace space{Eigen::VectorXd(kNumbers), Eigen::VectorXd::Constant(kNumbers, 0.2),
                            Eigen::VectorXd::Constant(kNumbers, -20.0),
                            Eigen::VectorXd::Constant(kNumbers, 20.0), 1200};
  for (int start = 0; start < starts; ++start) {
    for (Eigen::Index i = 0; i < kNumbers; ++i) {
      space.start[i] = i < 4 ? random.normal() : 2.0 * random.uniform() * 3.0;
    }
    static_cast<void>(search::climb(value, space));
  }
  return result;
}

}  // namespace veritrack::quadrature

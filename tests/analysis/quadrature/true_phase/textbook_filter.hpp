// The filter (2.3)-(2.9) of the thesis as it is written there, in doubles: shares no code with what is
// tested.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::test {

struct TextbookFilter {
  double q = 0.0, r = 0.0;
  Eigen::Vector3d x;
  Eigen::Matrix3d p;

  void step(const Eigen::Vector2d& y) {
    const double c = std::cos(x(2));
    const double s = std::sin(x(2));
    Eigen::Matrix3d f;
    f << c, -s, -s * x(0) - c * x(1), s, c, c * x(0) - s * x(1), 0, 0, 1;
    x = Eigen::Vector3d(c * x(0) - s * x(1), s * x(0) + c * x(1), x(2));
    p = f * p * f.transpose() + q * Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 2, 3> h;
    h << 1, 0, 0, 0, 1, 0;
    const Eigen::Matrix2d innovation = h * p * h.transpose() + r * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 3, 2> gain = p * h.transpose() * innovation.inverse();
    x += gain * (y - h * x);
    p = (Eigen::Matrix3d::Identity() - gain * h) * p;
  }

  [[nodiscard]] static Eigen::Matrix3d turn(double angle) {
    Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
    result.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return result;
  }
  /// (Re d, Im d, nu) of cell_forms.hpp, and the covariance in the frame of the true phase.
  [[nodiscard]] Eigen::Vector3d errors(double phase, double frequency) const {
    return turn(-phase) * Eigen::Vector3d(x(0), x(1), x(2) - frequency) - Eigen::Vector3d(1, 0, 0);
  }
  [[nodiscard]] Eigen::Matrix3d covariance(double phase) const { return turn(-phase) * p * turn(phase); }
  [[nodiscard]] static TextbookFilter with(const trackers::ToneModel<double>& design,
                                           const Eigen::Vector3d& errors, const Eigen::Matrix3d& covariance,
                                           double phase, double frequency) {
    const Eigen::Vector3d turned = turn(phase) * (errors + Eigen::Vector3d(1, 0, 0));
    return {design.q1, design.r, turned + Eigen::Vector3d(0, 0, frequency),
            turn(phase) * covariance * turn(-phase)};
  }
};

/// The measurement of a tone of that phase with noise.
inline Eigen::Vector2d measured(double phase, const Eigen::Vector2d& noise) {
  return Eigen::Vector2d(std::cos(phase), std::sin(phase)) + noise;
}

/// Is the largest eigenvalue of lower - upper at most a rounding error?
inline bool is_below(const Eigen::Matrix3d& lower, const Eigen::Matrix3d& upper) {
  constexpr double kRounding = 1e-12;
  return oracle::least_eigenvalue(upper - lower) >= -kRounding;
}

/// Figure 3.5 without a leak and what its design file assumes.
inline quadrature::EllipsoidQuestion figure_3_5() {
  quadrature::EllipsoidQuestion question;
  question.design = {0.0023, 0.0023, 0.05, 0.0};
  question.noise = 0.001;
  question.amplitude_error = question.phase_error = question.frequency_error = 0.005;
  Eigen::Matrix3d p = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 1000; ++k) {
    TextbookFilter filter = TextbookFilter::with(question.design, Eigen::Vector3d::Zero(), p, 0.0, 0.0);
    filter.step(measured(0.0, Eigen::Vector2d::Zero()));
    p = filter.p;
  }
  p = 0.5 * (p + p.transpose()).eval();
  question.start_lowest = 0.99 * p;
  question.start_highest = 1.01 * p;
  return question;
}

}  // namespace veritrack::test

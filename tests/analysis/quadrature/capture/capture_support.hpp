// Shared by the tests of capture: designs, sets to be captured in, and the tracker itself as oracle.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "analysis/quadrature/capture/capture.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::test {

using quadrature::CaptureProblem;
using quadrature::CertifiedSet;
using quadrature::StartBox;
using rigor::Interval;

/// A design with a set about its lock. The set is only a target here: nothing depends on its being invariant.
struct CaptureExample {
  double q, r;
  std::array<double, 4> metric;  ///< t_a, t22, t23, t33
  double radius;
  std::array<double, 4> lower, upper;  ///< P11, P22, P23, P33
};

inline const std::array<CaptureExample, 4>& capture_examples() {
  static const std::array<CaptureExample, 4> examples = {{
      {0.0005,
       0.01,
       {40.55, 22.80, -11.97, 48.05},
       10.0,
       {0.0010, 0.0016, 0.0003, 0.00088},
       {0.006, 0.008, 0.0038, 0.0049}},
      {0.0013,
       0.01,
       {116.8, 79.48, -80.84, 102.56},
       30.0,
       {0.00187, 0.00255, 0.0004, 0.00195},
       {0.0078, 0.0084, 0.0046, 0.0100}},
      {0.0065,
       0.01,
       {20.58, 14.008, -1.786, 10.52},
       4.0,
       {0.0042, 0.0045, 0.0006, 0.0075},
       {0.0095, 0.0097, 0.0047, 0.03}},
      {0.0023,
       0.05,
       {15.36, 9.137, -3.22, 16.05},
       3.0,
       {0.0045, 0.0088, 0.0021, 0.0045},
       {0.025, 0.039, 0.0172, 0.0179}},
  }};
  return examples;
}

inline rigor::Matrix<3> block_covariance(const std::array<double, 4>& p) {
  rigor::Matrix<3> matrix;
  matrix << p[0], 0.0, 0.0, 0.0, p[1], p[2], 0.0, p[2], p[3];
  return matrix;
}

inline CertifiedSet target_set(const CaptureExample& example) {
  CertifiedSet set;
  set.metric << example.metric[0], 0.0, 0.0, 0.0, example.metric[1], example.metric[2], 0.0, 0.0,
      example.metric[3];
  set.radius = example.radius;
  set.covariance_lower = block_covariance(example.lower);
  set.covariance_upper = block_covariance(example.upper);
  return set;
}

/// The covariance that the tracker settles to on a constant signal of amplitude 1, in the frame of the
/// estimated phase, by iteration.
inline rigor::Matrix<3> steady_covariance(double q, double r) {
  trackers::QuadratureEkf<double> tracker(
      {q, q, r, 0.0},
      {1.0, 0.0, 0.0,
       trackers::FactoredCovariance<double>::from_matrix(0.01 * rigor::Matrix<3>::Identity())});
  for (int k = 0; k < 2000; ++k) {
    tracker.step(1.0, 0.0);
  }
  return tracker.filtered().covariance.matrix();
}

inline CaptureProblem capture_problem(const CaptureExample& example) {
  const rigor::UpwardRounding upward;
  CaptureProblem problem;
  problem.design = {Interval(example.q), Interval(example.q), Interval(example.r), Interval(0.0)};
  rigor::Matrix<3> covariance;
  {
    const rigor::NearestRounding nearest;
    covariance = steady_covariance(example.q, example.r);
  }
  problem.initial_covariance = rigor::to_interval(covariance);
  return problem;
}

/// The tracker of trackers/quadrature/quadrature_ekf.hpp on e^{i omega k}, with its errors.
class TrackedRun {
 public:
  TrackedRun(const CaptureProblem& problem, double omega, double amplitude_error, double phase_error,
             double frequency_error)
      : omega_(omega),
        tracker_({midpoint(problem.design.q1), midpoint(problem.design.q2), midpoint(problem.design.r),
                  midpoint(problem.design.epsilon)},
                 start(problem, omega, amplitude_error, phase_error, frequency_error)) {}

  /// One sample with the noise (in the frame of the signal's phase) and the slew.
  void step(double noise_1 = 0.0, double noise_2 = 0.0, double slew = 0.0) {
    phase_ = std::remainder(phase_ + omega_, 6.283185307179586476925);
    omega_ += slew;
    const double cosine = std::cos(phase_);
    const double sine = std::sin(phase_);
    tracker_.step((1.0 + noise_1) * cosine - noise_2 * sine, (1.0 + noise_1) * sine + noise_2 * cosine);
  }

  /// (a, psi, nu), the phase in [-pi, pi].
  [[nodiscard]] rigor::Vector<3> error() const {
    const auto& now = tracker_.filtered();
    return {std::hypot(now.in_phase, now.quadrature) - 1.0,
            std::remainder(std::atan2(now.quadrature, now.in_phase) - phase_, 6.283185307179586476925),
            now.frequency - omega_};
  }
  /// In the frame of the estimated phase.
  [[nodiscard]] rigor::Matrix<3> covariance() const {
    const auto& now = tracker_.filtered();
    const double angle = std::atan2(now.quadrature, now.in_phase);
    return turn(-angle) * now.covariance.matrix() * turn(-angle).transpose();
  }
  /// Whether errors and covariance lie in the set, a rounding error aside; `turns` times 2 pi are taken from
  /// nu.
  [[nodiscard]] bool is_in(const CertifiedSet& set, int turns = 0) const {
    rigor::Vector<3> e = error();
    e[2] -= 6.283185307179586476925 * turns;
    const rigor::Matrix<3> p = covariance();
    return (set.metric * e).norm() <= set.radius * (1.0 + 1e-9) &&
           oracle::least_eigenvalue(p - set.covariance_lower) > -1e-12 &&
           oracle::least_eigenvalue(set.covariance_upper - p) > -1e-12;
  }

 private:
  static rigor::Matrix<3> turn(double angle) {
    rigor::Matrix<3> u = rigor::Matrix<3>::Identity();
    u.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return u;
  }
  static trackers::QuadratureEstimate<double> start(const CaptureProblem& problem, double omega, double a,
                                                    double psi, double nu) {
    const rigor::Matrix<3> p =
        turn(psi) * rigor::midpoint(problem.initial_covariance) * turn(psi).transpose();
    return {(1.0 + a) * std::cos(psi), (1.0 + a) * std::sin(psi), omega + nu,
            trackers::FactoredCovariance<double>::from_matrix(p)};
  }

  double phase_ = 0.0;
  double omega_;
  trackers::QuadratureEkf<double> tracker_;
};

inline Interval around(double center, double half_width) {
  return Interval::from_bounds(center - half_width, center + half_width);
}

/// A member of the interval: an end or anything between.
inline double member(const Interval& range, Random& random) {
  const std::uint64_t choice = random.below(4);
  return choice == 0   ? range.lower()
         : choice == 1 ? range.upper()
                       : range.lower() + (range.upper() - range.lower()) * random.uniform();
}

}  // namespace veritrack::test

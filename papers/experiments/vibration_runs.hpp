// The simulations of chapter 5 of B. F. La Scala's thesis (trackers/regulator/): the plant x_k = 0.5 x_{k-1}
// + 3 u_{k-1}, a vibration of pi/6 rad/sample, and the self-tuning regulator with either estimator, for the
// order 3 that is right (Example 1) and for 5 (Example 2).
//
// e_{-1}, e_{-2}, theta_0, P_{-1} and the Lambda of the monitored estimator are unpublished. P_{-1} is a
// multiple of I here.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace veritrack::experiments {

inline constexpr double kVibration = 0.52359877559829882;  // pi/6, rad/sample

enum class VibrationOrder : std::uint8_t { three, five };

/// numerator c - a, then denominator b, of the ideal controller; zero beyond the order 3.
[[nodiscard]] Eigen::VectorXd ideal_parameters(VibrationOrder order);

/// The unpublished conditions.
struct VibrationStart {
  double first = 1.0, second = 0.0;  ///< e_{-1} and e_{-2}, units of the output
  double covariance = 1.0;           ///< P_{-1} = this times I; EFRA keeps [0.011, 10.6]
  Eigen::VectorXd parameters;        ///< theta_0; b_0 of it is not 0
};

/// The knowledge in theta_0.
enum class FirstGuess : std::uint8_t {
  nothing,    ///< zero, except b_0, uniform in [1, 4]
  near_ideal  ///< the ideal one, each entry with a normal error of deviation 0.5
};
/// Drawn: e normal with deviation 1, log P_{-1} uniform from 0.1 to 10, and theta_0.
[[nodiscard]] VibrationStart drawn_start(VibrationOrder order, FirstGuess guess, std::uint64_t seed);

enum class Estimator : std::uint8_t {
  efra,      ///< alpha = 0.5, beta = 0.005, lambda = 0.95, delta = 0.005
  monitored  ///< r_{-1} = 1, and Lambda as given
};

/// A run from rest, k = 0, 1, ...
struct VibrationRun {
  std::vector<double> output;               ///< y_k
  std::vector<Eigen::VectorXd> parameters;  ///< theta_k: numerator, then denominator, of the controller
};
[[nodiscard]] VibrationRun vibration_run(VibrationOrder order, Estimator estimator,
                                         const VibrationStart& start, int samples, double limit = 1e3);
/// theta after this many samples.
[[nodiscard]] Eigen::VectorXd limiting_parameters(VibrationOrder order, Estimator estimator,
                                                  const VibrationStart& start, int samples,
                                                  double limit = 1e3);

/// |D(e^{i omega})| by the sum of its coefficients' sizes, D the denominator b_0 + b_1 z^-1 + ...: zero when
/// the controller has the vibration's pole.
[[nodiscard]] double pole_error(const Eigen::VectorXd& parameters);

}  // namespace veritrack::experiments

// The usual measures of a linear loop: modes, the response to a step, the noise that passes. In floating
// point: nothing here is proved.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace veritrack::linear {

/// x+ = A x + B u, y = c x.
struct LinearLoop {
  Eigen::MatrixXd a;
  Eigen::MatrixXd noise;        ///< a column for each component of white noise of deviation 1
  Eigen::VectorXd step;         ///< x after a step of the input by 1
  Eigen::RowVectorXd estimate;  ///< the error of the estimate
  /// The share of noise of amplitude 1 at one frequency that turns with it: with one channel half of its
  /// power.
  double tone_share = 1.0;
};

/// A real mode, or a pair.
struct LoopMode {
  std::complex<double> multiplier;
  /// Samples in which it decays by a factor e; 0: at once; below 0, or infinite, where it does not decay.
  double time_constant = 0.0;
  double damping = 1.0;    ///< -Re s/|s| with s = ln(multiplier)
  double frequency = 0.0;  ///< |s|, rad/sample
};
[[nodiscard]] LoopMode mode_of(const std::complex<double>& multiplier);
[[nodiscard]] std::vector<LoopMode> modes_of(const LinearLoop& loop);

/// Deviation of the estimate for white noise of deviation 1 in each component.
[[nodiscard]] double noise_deviation(const LinearLoop& loop, std::size_t samples);

/// 1 + the error after a step of the input, which is -1 at first: the share that has been followed, by
/// sample.
[[nodiscard]] std::vector<double> followed_share(const LinearLoop& loop, std::size_t samples);

/// |y| for noise of amplitude 1 that turns by `frequency` rad/sample.
[[nodiscard]] double noise_gain(const LinearLoop& loop, double frequency);

}  // namespace veritrack::linear

// Proposals of the search for sets about the exact lock: in floating point, and not evidence of anything.
#pragma once

#include <optional>
#include <vector>

#include "analysis/dft_block/lock_set.hpp"

namespace veritrack::dft_block {

/// The smallest eigenvalue of the symmetric part.
[[nodiscard]] double smallest_eigenvalue(const rigor::Matrix<3>& a);

/// A block from one error, in the frame of a set: X is `centre` plus or minus up to `spread`.
struct BlockSample {
  rigor::Matrix<3> step;         ///< F (I - centre secant)
  rigor::Matrix<3> secant;       ///< of the bins between tone and estimate
  rigor::Matrix<3> information;  ///< J = H'R^-1 H
  rigor::Matrix<3> centre, spread;
  rigor::Matrix<3> turned;  ///< F spread F'
};

/// Proposes sets for one problem. All in doubles; each call opens its own nearest rounding.
class LockSearch {
 public:
  /// The frame is a factor of the steady covariance in the middle of the band and of the amplitudes.
  explicit LockSearch(const LockProblem& problem);

  /// Bounds of the covariance for such errors, by the factor `room` from those of samples; empty when there
  /// are none.
  [[nodiscard]] std::optional<LockBounds> set_for(const ErrorSet& errors, double room = 1.03) const;
  [[nodiscard]] std::optional<LockBounds> set_for(double radius) const {
    return set_for(ErrorSet::ball(radius));
  }
  /// The rate of a set for errors up to that radius, a little above that of samples; empty unless below 1.
  [[nodiscard]] std::optional<LockRate> rate_for(const LockBounds& set, double radius) const;
  /// The best growth for that tilt, and a floor, a little worse than those of samples; empty unless the
  /// growth is below 1.
  [[nodiscard]] std::optional<LockDrift> drift_for(const LockBounds& set, double radius, double tilt) const;
  /// A block of a tone of that amplitude from an error with C^-1 z = direction: X between the set's bounds.
  [[nodiscard]] BlockSample sample_at(const LockBounds& set, double amplitude,
                                      const rigor::Vector<3>& direction, double offset) const;
  /// Blocks from `directions` errors at the border, and at `inner` of that unless it is 0, at `offsets` + 1
  /// offsets and both amplitudes.
  [[nodiscard]] std::vector<BlockSample> samples(const LockBounds& set, const ErrorSet& errors, double inner,
                                                 int directions, int offsets) const;
  /// F, and Q at an amplitude, in the frame.
  [[nodiscard]] rigor::Matrix<3> turn_in_frame() const;
  [[nodiscard]] std::vector<rigor::Matrix<3>> process_noises_in_frame() const;
  [[nodiscard]] const rigor::Matrix<3>& frame() const { return frame_; }
  /// The steady covariance, x1 relative to the tone's, phase at the middle of the block.
  [[nodiscard]] const rigor::Matrix<3>& steady() const { return steady_; }

 private:
  struct Model {
    double q1, q2, q3, r;
    int half_width;
    double amplitude_low, amplitude_high, offset_low, offset_high;
  };
  [[nodiscard]] rigor::Matrix<3> process_noise(double amplitude) const;
  [[nodiscard]] rigor::Matrix<3> jacobian(double amplitude, double x1, double offset) const;
  [[nodiscard]] rigor::Matrix<3> secant(double amplitude, const rigor::Vector<3>& error, double offset) const;

  Model model_;
  rigor::Matrix<3> steady_, frame_;
  rigor::Matrix<3> turn_;  ///< F, not in the frame
};

}  // namespace veritrack::dft_block

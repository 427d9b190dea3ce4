// Proposals of the search for sets about the exact lock: in floating point, and not evidence of anything.
#pragma once

#include <optional>
#include <vector>

#include "analysis/dft_block/lock_set.hpp"

namespace veritrack::dft_block {

/// Proposes sets for one problem. All in doubles; each call opens its own nearest rounding.
class LockSearch {
 public:
  /// The frame is a factor of the steady covariance in the middle of the band and of the amplitudes.
  explicit LockSearch(const LockProblem& problem);

  /// Bounds of the covariance for errors up to that radius in the frame; empty when there are none.
  [[nodiscard]] std::optional<LockBounds> set_for(double radius) const;
  /// The rate of a set for errors up to that radius, a little above that of samples; empty unless below 1.
  [[nodiscard]] std::optional<LockRate> rate_for(const LockBounds& set, double radius) const;
  /// The best growth for that tilt, and a floor, a little worse than those of samples; empty unless the
  /// growth is below 1.
  [[nodiscard]] std::optional<LockDrift> drift_for(const LockBounds& set, double radius, double tilt) const;
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

// Sets of errors and covariances about the exact lock of the block tracker that it never leaves, whatever the
// bounded noise and the bounded change of the offset: docs/block-tracker.md, sections 2 to 4.
//
// Errors z = (x1/x1_true - 1, phase error at the middle of the block, offset error) of the prediction of a
// block, with the covariance of that prediction in the same coordinates, x1 relative to the tone's. With the
// lower triangular C: z = C e, P = C S C'. The set: |e| <= radius, I/below <= S <= above I. After one block
// |e| is at most rate |e|, plus the contributions of noise and slew.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::dft_block {

/// A design and the assumptions on its tone, the same for every block except for the offset, which moves.
struct LockProblem {
  rigor::Interval q1, q2, q3, r;  ///< of the filter
  int half_width = 0;             ///< L, 1 to kMostHalfWidth
  rigor::Interval amplitude;      ///< of the tone, all values, signal units
  rigor::Interval offset;         ///< at every block, all values, bins
  rigor::Interval noise;          ///< length of the noise in all bins of a block, at most, signal units
  rigor::Interval slew;           ///< |offset_{k+1} - offset_k|, at most, bins
};

/// The errors with |e| <= radius and |e_i| <= limits_i.
struct ErrorSet {
  double radius = 0.0;
  rigor::Vector<3> limits;

  static ErrorSet ball(double radius) { return {radius, rigor::Vector<3>::Constant(radius)}; }
};

/// Exact doubles, proposed by anyone: the effect of one block on such errors, coordinate by coordinate, once
/// the covariances are nearer to the steady ones: e+ = (reference + E) e + noise, |E_ij| <= excess_ij, and of
/// noise of length 1 the coordinate c'e gets sqrt(c' noise c / r) at most. docs/block-tracker.md, section 4.
struct LateStage {
  ErrorSet errors;
  double above = 0.0, below = 0.0;            ///< I/below <= S <= above I in this stage
  double next_above = 0.0, next_below = 0.0;  ///< and after one block from there, which is nearer
  double noise_weight = 0.0;                  ///< splits the square of two parts of the noise's gain
  rigor::Matrix<3> reference, excess, noise;
};

/// Also proposed.
struct LockBounds {
  rigor::Matrix<3> frame;  ///< C
  double above = 0.0;
  double below = 0.0;
  double floor = 0.0;  ///< the process noise is at least floor I in the coordinates e

  /// The same frame with a stage's bounds on the covariance.
  [[nodiscard]] LockBounds with(const LateStage& stage) const {
    return {frame, stage.above, stage.below, floor};
  }
};

/// Also proposed: the effect of one block on errors up to a radius.
struct LockRate {
  double radius = 0.0;
  double rate = 0.0;
  double weight = 0.0;  ///< of Petersen's lemma
};

/// Also proposed: the average effect of one block, in Gaussian noise, on W = exp(theta |e|^2 / 2) for errors
/// up to a radius. With X, A and N of docs/block-tracker.md, section 7: A'(I - tilt F X N N'X F')^-1 A <=
/// growth I, and floor <= I - tilt F X N N'X F'. The noise has theta (variance of each part of a bin) = tilt
/// r.
struct LockDrift {
  double radius = 0.0;
  double tilt = 0.0;
  double growth = 0.0;
  double weight = 0.0;        ///< of Petersen's lemma
  rigor::Matrix<3> floor;     ///< symmetric
  double floor_weight = 0.0;  ///< of the same lemma, for the floor
};

/// The set and the problem in its coordinates.
class LockFrame {
 public:
  /// Empty when the frame is not certainly regular.
  static std::optional<LockFrame> make(const LockProblem& problem, const LockBounds& set);

  /// True only when the covariances stay between their bounds and errors fall at that rate, for all errors up
  /// to that radius, all offsets and amplitudes, without noise and slew: at most `most_cells` cells. Needs
  /// the upward mode.
  [[nodiscard]] bool verify(const LockRate& rate, std::int64_t most_cells) const;
  /// The same for a stage, whose bounds on covariances are this set's.
  [[nodiscard]] bool verify(const LateStage& stage, std::int64_t most_cells) const;
  /// True only when the covariances stay between their bounds, and growth and floor have their stated
  /// properties, likewise.
  [[nodiscard]] bool verify(const LockDrift& drift, std::int64_t most_cells) const;
  /// C^-1 (0, pi, 1)': added to e by a bin of slew.
  [[nodiscard]] rigor::IntervalVector<3> slew_direction() const;

  [[nodiscard]] const rigor::IntervalMatrix<3>& frame() const { return frame_; }  ///< C
  [[nodiscard]] const LockProblem& problem() const { return problem_; }
  /// An upper bound on what noise and slew add to |e| in a block. Needs the upward mode.
  [[nodiscard]] rigor::Interval disturbance() const;
  /// An upper bound on |e| of all errors with |z_i| <= bounds_i.
  [[nodiscard]] rigor::Interval length_of(const rigor::IntervalVector<3>& bounds) const;
  /// Upper bounds on |z_i| of all errors with |e| <= 1.
  [[nodiscard]] rigor::Interval reach(int i) const;
  /// True only when the covariance P(1|0) of (x1, phase at the start of the block, offset) is within the set,
  /// for every amplitude.
  [[nodiscard]] bool holds(const rigor::IntervalMatrix<3>& covariance) const;

 private:
  LockFrame() = default;
  /// (x1 error, phase error, offset error, offset, amplitude).
  using Cell = rigor::IntervalVector<5>;
  [[nodiscard]] bool is_outside(const Cell& cell, const ErrorSet& errors) const;
  struct NextBounds {
    double above, below;
  };
  /// The effect of a block over a cell, in the frame: X is `centre` plus or minus up to `spread`, `step` is F
  /// (I - centre secant), J = factor factor'.
  struct BlockOverCell {
    rigor::IntervalMatrix<3> centre, spread, secant, factor, step;
  };
  /// Empty unless the next covariances are between `next`'s bounds.
  [[nodiscard]] std::optional<BlockOverCell> block_over(const Cell& cell, const NextBounds& next) const;
  [[nodiscard]] std::optional<BlockOverCell> block_over(const Cell& cell) const {
    return block_over(cell, {set_.above, set_.below});
  }
  [[nodiscard]] bool is_late_over(const Cell& cell, const LateStage& stage) const;
  [[nodiscard]] bool falls_over(const Cell& cell, const LockRate& rate) const;
  [[nodiscard]] bool drifts_over(const Cell& cell, const LockDrift& drift) const;
  [[nodiscard]] bool verify_cells(const ErrorSet& errors, std::int64_t most_cells,
                                  const std::function<bool(const Cell&)>& is_verified) const;
  /// F P F'
  [[nodiscard]] rigor::IntervalMatrix<3> moved(const rigor::IntervalMatrix<3>& p) const {
    return turn_ * p * turn_.transpose();
  }
  /// Q of (x1 relative, phase at the middle of the block, offset), in the frame.
  [[nodiscard]] rigor::IntervalMatrix<3> process_noise(const rigor::Interval& amplitude) const;

  LockProblem problem_;
  LockBounds set_;
  rigor::IntervalMatrix<3> frame_, inverse_, turn_;
};

/// The amplitude is that of x1 = 1: x1^2 = amplitude / (4 pi).
[[nodiscard]] rigor::Interval squared_root_amplitude(const rigor::Interval& amplitude);

}  // namespace veritrack::dft_block

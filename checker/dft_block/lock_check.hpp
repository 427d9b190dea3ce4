// Whether a set of errors and covariances about the exact lock of the block tracker is never left, and how
// fast its errors fall: docs/block-tracker.md, sections 2 to 4.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "checker/dft_block/tone_polynomial.hpp"
#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

using Vector3 = std::array<Ball, 3>;

/// A design and the assumptions on its tone.
struct BlockProblem {
  Ball q1, q2, q3, r;
  int half_width = 0;
  Ball amplitude_low, amplitude_high;
  Ball offset_low, offset_high;
  Ball noise, slew;
};

/// A set as the certificate proposes it: C, and the covariance between C C'/below and above C C'.
struct BlockSet {
  Matrix3 frame;
  Ball above, below;
  Ball floor;  ///< C^-1 Q C^-T is at least floor I
};

/// A set of errors with |C^-1 z| <= radius.
struct BlockRate {
  Ball radius, rate, weight;
};

/// Errors with |C^-1 z| <= radius, each coordinate of it at most its limit.
struct BlockErrorSet {
  Ball radius;
  Vector3 limits;
};

/// Such errors and covariances nearer to the steady one, with what a block does to them:
/// each entry of A = F (1 - X secant) is within `excess` of that of `reference`, F X N N'X F' <= noise, and
/// the next covariance is between C C'/next_below and next_above C C'.
struct BlockStage {
  BlockSet set;
  BlockErrorSet errors;
  Ball next_above, next_below, noise_weight;
  Matrix3 reference, excess, noise;
};

/// A set of errors with |C^-1 z| <= radius, in Gaussian noise: see lock_loss_check.hpp.
struct BlockDrift {
  Ball radius, tilt, growth, weight, floor_weight;
  Matrix3 floor;
};

/// J = H'R^-1 H in the coordinates of section 2, where the estimate is x times the tone's root amplitude;
/// weight is A^2/(4 r).
Matrix3 block_information(const MeetingSums& sums, const Ball& weight, const Ball& x);
/// N with N N' = J, where that is defined: not finite otherwise.
Matrix3 root_of_block_information(const MeetingSums& sums, const Ball& weight, const Ball& x);

class BlockLock {
 public:
  BlockLock(const BlockProblem& problem, const BlockSet& set);

  /// True only when it is verified for all errors, offsets and amplitudes; `cells` counts the cells.
  [[nodiscard]] bool falls(const BlockRate& rate, std::int64_t& cells) const;
  /// The same for what is said of a stage, of which the set is this one.
  [[nodiscard]] bool stays_near(const BlockStage& stage, std::int64_t& cells) const;
  /// True only when it is verified for the drift that, with A = F (1 - X secant) and J = N N', A'(1 - tilt F
  /// X N N'X F')^-1 A <= growth and floor <= 1 - tilt F X N N'X F', likewise.
  [[nodiscard]] bool drifts(const BlockDrift& drift, std::int64_t& cells) const;
  /// C^-1 (0, pi, 1)': added to C^-1 z by a change of the offset by a bin.
  [[nodiscard]] Vector3 slew_direction() const;
  /// The row of C that makes the offset error of C^-1 z.
  [[nodiscard]] const Vector3& offset_row() const { return set_.frame[2]; }
  /// The noise's length in units of its deviation in the filter, and the slew, at most.
  [[nodiscard]] Ball noise_unit() const { return problem_.noise / sqrt(problem_.r); }
  [[nodiscard]] const Ball& slew() const { return problem_.slew; }
  [[nodiscard]] const BlockSet& set() const { return set_; }
  /// An upper bound on what is added to |C^-1 z| in a block.
  [[nodiscard]] Ball disturbance() const;
  /// An upper bound on |C^-1 z| for |z_i| <= bounds_i.
  [[nodiscard]] Ball length_of(const Vector3& bounds) const;
  /// Upper bounds on |z_i| for |C^-1 z| <= 1.
  [[nodiscard]] Ball reach(std::size_t i) const;
  /// True only when P(1|0), the covariance of (x1, phase at the start, offset), is in the set for every
  /// amplitude.
  [[nodiscard]] bool holds(const Matrix3& covariance) const;

 private:
  struct Cell;
  [[nodiscard]] bool is_outside(const Cell& cell, const BlockErrorSet& errors) const;
  struct OverCell;
  using InCell = std::function<bool(const Cell&, const TonePolynomial&)>;
  /// The effect of a block over a cell; empty unless the next covariances are between these bounds.
  [[nodiscard]] std::optional<OverCell> over(const Cell& cell, const TonePolynomial& tone,
                                             const Ball& next_above, const Ball& next_below) const;
  [[nodiscard]] std::optional<OverCell> over(const Cell& cell, const TonePolynomial& tone) const;
  [[nodiscard]] bool stays_near_in(const Cell& cell, const TonePolynomial& tone,
                                   const BlockStage& stage) const;
  [[nodiscard]] bool falls_in(const Cell& cell, const TonePolynomial& tone, const BlockRate& rate) const;
  [[nodiscard]] bool drifts_in(const Cell& cell, const TonePolynomial& tone, const BlockDrift& drift) const;
  /// Whether it is true in cells that cover all errors, amplitudes, and the offsets between these two; and in
  /// the whole band.
  [[nodiscard]] bool true_near(const Ball& low, const Ball& high, const BlockErrorSet& errors,
                               const InCell& is_true, std::int64_t& cells) const;
  [[nodiscard]] bool true_everywhere(const BlockErrorSet& errors, const InCell& is_true,
                                     std::int64_t& cells) const;
  [[nodiscard]] Matrix3 process_noise(const Ball& amplitude) const;

  BlockProblem problem_;
  BlockSet set_;
  Matrix3 back_;  ///< C^-1
  Matrix3 turn_;  ///< C^-1 F C
};

}  // namespace veritrack::checker

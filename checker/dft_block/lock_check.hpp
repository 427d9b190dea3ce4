// Whether a set of errors and covariances about the exact lock of the block tracker is never left, and how
// fast its errors fall: docs/block-tracker.md, sections 2 to 4.
#pragma once

#include <array>
#include <cstdint>

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

using Vector3 = std::array<Ball, 3>;

/// A design and what is assumed of its tone.
struct BlockProblem {
  Ball q1, q2, q3, r;
  int half_width = 0;
  Ball amplitude_low, amplitude_high;
  Ball offset_low, offset_high;
  Ball noise, slew;
};

/// What the certificate proposes of a set: C, and the covariance between C C'/below and above C C'.
struct BlockSet {
  Matrix3 frame;
  Ball above, below;
  Ball floor;  ///< C^-1 Q C^-T is at least floor I
};

/// Of errors with |C^-1 z| <= radius.
struct BlockRate {
  Ball radius, rate, weight;
};

class BlockLock {
 public:
  BlockLock(const BlockProblem& problem, const BlockSet& set);

  /// True only when it is verified for all errors, offsets and amplitudes; `cells` counts.
  [[nodiscard]] bool falls(const BlockRate& rate, std::int64_t& cells) const;
  /// Added to |C^-1 z| in a block, at most.
  [[nodiscard]] Ball disturbance() const;
  /// |C^-1 z| of |z_i| <= bounds_i, at most.
  [[nodiscard]] Ball length_of(const Vector3& bounds) const;
  /// |z_i| of |C^-1 z| <= 1, at most.
  [[nodiscard]] Ball reach(std::size_t i) const;
  /// True only when P(1|0), of (x1, phase at the start, offset), is in the set for every amplitude.
  [[nodiscard]] bool holds(const Matrix3& covariance) const;

 private:
  struct Cell;
  [[nodiscard]] bool is_outside(const Cell& cell, const Ball& radius) const;
  [[nodiscard]] bool falls_in(const Cell& cell, const class TonePolynomial& tone,
                              const BlockRate& rate) const;
  [[nodiscard]] bool falls_near(const Ball& low, const Ball& high, const BlockRate& rate,
                                std::int64_t& cells) const;
  [[nodiscard]] Matrix3 process_noise(const Ball& amplitude) const;

  BlockProblem problem_;
  BlockSet set_;
  Matrix3 back_;  ///< C^-1
  Matrix3 turn_;  ///< C^-1 F C
};

}  // namespace veritrack::checker

// The errors of the block tracker over time: first by the one rate of its set, then coordinate by coordinate
// in stages nearer to the exact lock. docs/block-tracker.md, section 4.
#pragma once

#include <vector>

#include "analysis/dft_block/lock_set.hpp"

namespace veritrack::dft_block {

/// Upper bounds on |e| and on its coordinates.
struct ErrorBounds {
  rigor::Interval length;
  rigor::IntervalVector<3> coordinates;

  /// Errors up to some multiple of these.
  [[nodiscard]] ErrorSet enlarged(double factor) const;
};

/// Upper bounds in a stage, each of them valid from that block of the stage on, for ever.
class LateErrors {
 public:
  /// In block 0 of the stage, and later, |e| and the coordinates are at most these. Needs the upward mode, as
  /// its calls do.
  LateErrors(const LockFrame& frame, const LateStage& stage, const ErrorBounds& start);

  /// One block later.
  void advance();
  /// On |e|, on its coordinates, and on the offset error, bins.
  [[nodiscard]] ErrorBounds bounds() const;
  [[nodiscard]] const rigor::Interval& offset_error() const { return offset_error_; }

 private:
  rigor::IntervalMatrix<3> reference_, excess_, noise_;
  rigor::IntervalVector<3> slew_direction_;
  rigor::Interval noise_unit_, slew_, start_;
  /// Rows: the coordinates of e and the offset error, of the power of the reference that is next.
  rigor::IntervalMatrix<4, 3> power_;
  std::vector<rigor::IntervalMatrix<4, 3>> kernels_;  ///< |rows of reference^k| excess
  rigor::IntervalVector<4> driven_;                   ///< what noise and slew of the window's blocks add
  std::vector<rigor::IntervalVector<3>> coordinates_;
  rigor::Interval offset_error_;
};

/// The proposal and its consequences for errors that begin at |e| <= `start`.
struct Timeline {
  std::vector<rigor::Interval> offset_error;  ///< from block 1 + i on, for ever, bins
  rigor::Interval ultimate;                   ///< in the long run, bins
  ErrorBounds late;                           ///< in the long run
};

/// Bounds from the verified set with its rate, and from the verified stages that are reached, in their order.
/// Needs the upward mode.
[[nodiscard]] Timeline timeline_of(const LockFrame& frame, const LockBounds& set, const LockRate& rate,
                                   const std::vector<LateStage>& stages, const rigor::Interval& start);

/// The blocks until covariances between I/below and above I are between a stage's bounds, at most; negative
/// when they need not come there.
[[nodiscard]] int blocks_to_approach(double above, double below, const LateStage& stage);

}  // namespace veritrack::dft_block

// All operations of IntervalLanes on arrays, in units that are compiled for one set of instructions each:
// part of interval_lanes_test.cpp.
#pragma once

namespace veritrack::test {

constexpr int kMostLanes = 8;

/// Two intervals a lane, and a number.
struct LaneOperands {
  double x_lower[kMostLanes], x_upper[kMostLanes];  // NOLINT: plain, shared by units for different processors
  double y_lower[kMostLanes], y_upper[kMostLanes];  // NOLINT
  double point[kMostLanes];                         // NOLINT
};

/// What an operation gives in each lane. Those that give a number have it twice, those that give a mask have
/// 1 or 0.
struct LaneResult {
  double lower[kMostLanes], upper[kMostLanes];  // NOLINT
};

enum LaneOperation {
  kSum,
  kDifference,
  kNegative,
  kProduct,
  kQuotient,
  kSquare,
  kRoot,
  kHull,
  kMax,
  kAbs,
  kPoint,
  kScaled,
  kSymmetric,
  kMidpoint,
  kMagnitude,
  kIsFinite,
  kIsLess,
  kIsPositive,
  kSine,
  kCosine,
  kSineRatio,
  kArctangentRatio,
  kOperations
};

/// The functions fill in all results for the lanes that they have. The upward mode is held.
using ApplyLanes = void(const LaneOperands& operands, LaneResult* results);
ApplyLanes apply_sse2, apply_avx2, apply_avx512;

}  // namespace veritrack::test

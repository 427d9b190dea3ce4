// See lane_operations.hpp. For units with their own set of instructions.
#pragma once

#include "analysis/rigor/interval_lanes.hpp"
#include "tests/analysis/rigor/lane_operations.hpp"

namespace veritrack::test {

template <int Lanes>
void apply_lanes(const LaneOperands& operands, LaneResult* results) {
  using R = rigor::Registers<Lanes>;
  using Set = rigor::IntervalLanes<Lanes>;
  for (int first = 0; first < kMostLanes; first += Lanes) {
    const Set x = Set::load(operands.x_lower + first, operands.x_upper + first);
    const Set y = Set::load(operands.y_lower + first, operands.y_upper + first);
    const auto points = R::load(operands.point + first);
    const auto keep = [&](LaneOperation operation, const Set& result) {
      result.store(results[operation].lower + first, results[operation].upper + first);
    };
    const auto keep_number = [&](LaneOperation operation, const typename R::Numbers& result) {
      R::store(results[operation].lower + first, result);
      R::store(results[operation].upper + first, result);
    };
    const auto keep_mask = [&](LaneOperation operation, const typename R::Mask& mask) {
      keep_number(operation, R::select(mask, R::all(1.0), R::all(0.0)));
    };
    keep(kSum, x + y);
    keep(kDifference, x - y);
    keep(kNegative, -x);
    keep(kProduct, x * y);
    keep(kQuotient, x / y);
    keep(kSquare, square(x));
    keep(kRoot, sqrt(x));
    keep(kHull, hull(x, y));
    keep(kMax, max(x, y));
    keep(kAbs, abs(x));
    keep(kPoint, Set::at(points));
    keep(kScaled, scaled(x, points));
    keep(kSymmetric, Set::symmetric(points));
    keep_number(kMidpoint, midpoint(x));
    keep_number(kMagnitude, magnitude(x));
    keep_mask(kIsFinite, is_finite(x));
    keep_mask(kIsLess, certainly_less(x, y));
    keep_mask(kIsPositive, certainly_positive(x));
    const auto [sine, cosine] = sin_cos(x);
    keep(kSine, sine);
    keep(kCosine, cosine);
    keep(kSineRatio, sine_ratio(x));
    keep(kArctangentRatio, arctangent_ratio(x));
  }
}

}  // namespace veritrack::test

// The oracle is Interval: lane by lane the same bounds, whatever stands in the other lanes.
#include "analysis/rigor/interval_lanes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/elementary_ratios.hpp"
#include "tests/analysis/rigor/lane_operations.hpp"
#include "tests/analysis/rigor/operands.hpp"
#include "trackers/instruction_set.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;
using trackers::InstructionSet;

namespace {

/// Bounded, unbounded, empty, points; often with ends that are zero, infinite, or near overflow and
/// underflow. Many are of the size of one, so that elementary functions have something to do.
Interval some_lane(Operands& operands) {
  constexpr double kSpecial[] = {0.0,      -0.0,      kInfinity, -kInfinity,
                                 kLargest, -kLargest, kSmallest, -kSmallest};
  const bool moderate = operands.random().below(2) == 0;
  const auto end = [&] {
    const std::uint64_t choice = operands.random().below(16);
    return choice >= 8 && !moderate ? kSpecial[choice - 8]
           : moderate               ? operands.random().uniform(-3.5, 3.5)
                                    : operands.number();
  };
  const double a = end();
  const double b = operands.random().below(4) == 0 ? a : end();
  return operands.random().below(16) == 0 ? bounds(a, b) : bounds(std::min(a, b), std::max(a, b));
}

Interval of_number(double x) {
  return Interval::from_bounds(x, x);
}
Interval of_truth(bool x) {
  return Interval(x ? 1.0 : 0.0);
}

std::array<Interval, kOperations> expected(const Interval& x, const Interval& y, double point) {
  std::array<Interval, kOperations> all;
  all[kSum] = x + y;
  all[kDifference] = x - y;
  all[kNegative] = -x;
  all[kProduct] = x * y;
  all[kQuotient] = x / y;
  all[kSquare] = square(x);
  all[kRoot] = rigor::sqrt(x);
  all[kHull] = hull(x, y);
  all[kMax] = rigor::max(x, y);
  all[kAbs] = rigor::abs(x);
  all[kPoint] = Interval(point);
  all[kScaled] = x * Interval(point);
  all[kSymmetric] = rigor::symmetric(point);
  all[kMidpoint] = of_number(midpoint(x));
  all[kMagnitude] = of_number(magnitude(x));
  all[kIsFinite] = of_truth(is_finite(x));
  all[kIsLess] = of_truth(certainly_less(x, y));
  all[kIsPositive] = of_truth(certainly_positive(x));
  const auto [sine, cosine] = rigor::sin_cos(x);
  all[kSine] = sine;
  all[kCosine] = cosine;
  all[kSineRatio] = rigor::sine_ratio(x);
  all[kArctangentRatio] = rigor::arctangent_ratio(x);
  return all;
}

/// The same numbers, or no number at both ends. An infinite magnitude is no point, so it has no Interval.
bool same(const LaneResult& found, int lane, const Interval& wanted, int operation) {
  const double lower = found.lower[lane];
  const double upper = found.upper[lane];
  if (operation == kMagnitude && std::isinf(lower)) {
    return is_empty(wanted) && lower > 0.0;
  }
  return is_empty(wanted) ? std::isnan(lower) && std::isnan(upper)
                          : lower == wanted.lower() && upper == wanted.upper();
}

}  // namespace

TEST_CASE("each lane has the bounds of a single interval, for every set of instructions") {
  const std::array<std::pair<InstructionSet, ApplyLanes*>, 3> sets{{{InstructionSet::sse2, apply_sse2},
                                                                    {InstructionSet::avx2, apply_avx2},
                                                                    {InstructionSet::avx512, apply_avx512}}};
  Operands operands(43);
  Misses misses;
  const rigor::UpwardRounding mode;
  for (std::int64_t round = effort(10'000); round > 0; --round) {
    LaneOperands lanes;
    std::array<std::array<Interval, kOperations>, kMostLanes> wanted;
    for (int lane = 0; lane < kMostLanes; ++lane) {
      const Interval x = some_lane(operands);
      const Interval y = some_lane(operands);
      const double point = operands.random().below(8) == 0 ? kNaN : some_lane(operands).upper();
      lanes.x_lower[lane] = x.lower();
      lanes.x_upper[lane] = x.upper();
      lanes.y_lower[lane] = y.lower();
      lanes.y_upper[lane] = y.upper();
      lanes.point[lane] = point;
      wanted[static_cast<std::size_t>(lane)] = expected(x, y, point);
    }
    for (const auto& [set, apply] : sets) {
      if (!trackers::has(set)) {
        continue;
      }
      std::array<LaneResult, kOperations> found;
      apply(lanes, found.data());
      for (int lane = 0; lane < kMostLanes; ++lane) {
        for (int operation = 0; operation < kOperations; ++operation) {
          const auto index = static_cast<std::size_t>(operation);
          const Interval& want = wanted[static_cast<std::size_t>(lane)][index];
          if (!same(found[index], lane, want, operation)) {
            misses.expect(false, ("operation " + std::to_string(operation)).c_str(),
                          bounds(lanes.x_lower[lane], lanes.x_upper[lane]),
                          bounds(lanes.y_lower[lane], lanes.y_upper[lane]));
          }
        }
      }
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

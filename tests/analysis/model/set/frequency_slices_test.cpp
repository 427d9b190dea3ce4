#include "analysis/model/set/frequency_slices.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

/// Slices side by side over [0.25, 0.75], the one from 0.5 on left out where there is a gap.
std::vector<FrequencySlice> random_slices(test::Random& random, bool has_gap) {
  std::vector<double> ends{0.25, 0.5, 0.625, 0.75};
  for (int i = 0; i < 5; ++i) {
    ends.push_back(random.uniform(0.25, 0.5));
    ends.push_back(random.uniform(0.625, 0.75));
  }
  std::sort(ends.begin(), ends.end());
  std::vector<FrequencySlice> slices;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!has_gap || ends[i] != 0.5) {
      const double middle = random.uniform(-1.0, 1.0);
      slices.push_back({ends[i], ends[i + 1],
                        Interval::from_bounds(middle, middle + random.uniform(0.0, 1.0)),
                        random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)});
    }
  }
  return slices;
}

const FrequencySlice* slice_at(const std::vector<FrequencySlice>& slices, double frequency) {
  const auto found = std::find_if(slices.begin(), slices.end(), [&](const FrequencySlice& slice) {
    return slice.low < frequency && frequency < slice.high;
  });
  return found != slices.end() ? &*found : nullptr;
}

TEST_CASE("at every frequency the worst of lists is the worst of their slices there") {
  test::Random random(36);
  for (const bool has_gap : {false, true}) {
    const std::vector<std::vector<FrequencySlice>> lists{
        random_slices(random, false), random_slices(random, has_gap), random_slices(random, false)};
    const std::vector<FrequencySlice> worst = worst_of(lists);
    int inside = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const double frequency = random.uniform(0.25, 0.75);
      const FrequencySlice* found = slice_at(worst, frequency);
      double low = INFINITY, high = -INFINITY, ripple = 0.0, reach = INFINITY;
      bool is_covered = true;
      for (const std::vector<FrequencySlice>& list : lists) {
        const FrequencySlice* here = slice_at(list, frequency);
        is_covered = is_covered && here != nullptr;
        if (here != nullptr) {
          low = std::min(low, here->bias.lower());
          high = std::max(high, here->bias.upper());
          ripple = std::max(ripple, here->ripple);
          reach = std::min(reach, here->reach);
        }
      }
      REQUIRE((found != nullptr) == is_covered);
      if (found != nullptr) {
        ++inside;
        CHECK(found->bias.lower() == low);
        CHECK(found->bias.upper() == high);
        CHECK(found->ripple == ripple);
        CHECK(found->reach == reach);
      }
    }
    CHECK((inside == 2000) == !has_gap);
    CHECK(inside > 1000);
  }
  CHECK(worst_of({}).empty());
}

TEST_CASE("neighbours that overlap by rounding make no slice of their own, and both count where they meet") {
  constexpr double kLittle = 1e-12;
  const std::vector<FrequencySlice> one{{1.0, 2.0, Interval(0.0), 0.5, 0.25},
                                        {2.0 - kLittle, 3.0, Interval(1.0), 0.25, 0.125}};
  const std::vector<FrequencySlice> other{{1.0, 3.0, Interval(0.5), 0.0, 1.0}};
  const std::vector<FrequencySlice> worst = worst_of({one, other});
  REQUIRE(worst.size() == 2);
  CHECK(worst[0].bias.upper() == 0.5);
  CHECK(worst[0].ripple == 0.5);
  CHECK(worst[1].bias.lower() == 0.5);
  CHECK(worst[1].reach == 0.125);
}

TEST_CASE("what one list does not know is not known of all") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<FrequencySlice> known{{1.0, 2.0, Interval(0.0), 0.5, 0.25}};
  const std::vector<FrequencySlice> unknown{{1.0, 2.0, Interval::empty(), nan, 0.0}};
  for (const auto& lists : {std::vector{known, unknown}, std::vector{unknown, known}}) {
    const std::vector<FrequencySlice> worst = worst_of(lists);
    REQUIRE(worst.size() == 1);
    CHECK(rigor::is_empty(worst.front().bias));
    CHECK(worst.front().ripple == INFINITY);
    CHECK(worst.front().reach == 0.0);
  }
  CHECK(larger_bound(1.0, 2.0) == 2.0);
  CHECK(larger_bound(nan, 2.0) == INFINITY);
  CHECK(larger_bound(1.0, nan) == INFINITY);
}

}  // namespace
}  // namespace veritrack::model

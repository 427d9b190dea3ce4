#include "analysis/kkl_observer/kkl_caption_window.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace veritrack::kkl_observer {
namespace {

const Eigen::Vector4d kRates(1.0, 2.0, 3.0, 4.0);

TEST_CASE("the numbers are the same up to the largest ell, and others above") {
  const CaptionStatistics small = caption_statistics(kRates, 1e-6, 10.0);
  // With the disturbance less than what a theorem gives for the signal alone (docs/kkl-observer.md).
  CHECK(small.largest_ell < 0.00292);
  CHECK(small.largest_ell > 0.0025);
  const CaptionStatistics below = caption_statistics(kRates, 0.9999 * small.largest_ell, 10.0);
  CHECK(below.frequency.mean == small.frequency.mean);
  CHECK(below.amplitude.deviation == small.amplitude.deviation);
  const CaptionStatistics above = caption_statistics(kRates, 1.01 * small.largest_ell, 10.0);
  CHECK(above.frequency.mean != small.frequency.mean);
}

TEST_CASE("a moment without an estimate leaves no mean; the other moments have one") {
  const CaptionStatistics proved = caption_statistics(kRates, 3e-4, 100.0);
  CHECK(proved.without_estimate == 0.0);
  CHECK(proved.frequency_where_any.mean == proved.frequency.mean);
  CHECK(proved.amplitude_where_any.deviation == proved.amplitude.deviation);
  const CaptionStatistics printed = caption_statistics(kRates, 5.0, 100.0);
  CHECK(printed.without_estimate > 0.7);
  CHECK(printed.without_estimate < 0.8);
  CHECK(std::isnan(printed.frequency.mean));
  CHECK(std::isnan(printed.amplitude.deviation));
  CHECK(printed.frequency_where_any.mean < 0.2);
  CHECK(printed.amplitude_where_any.mean > 3.0);
}

TEST_CASE("drawn windows lie where they are said to lie, each elsewhere") {
  double before = 0.0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const CaptionWindow window = drawn_caption_window(seed);
    CHECK(window.begin >= 5.0);
    CHECK(window.begin < 15.0);
    CHECK(window.end - window.begin > 14.999);
    CHECK(window.end - window.begin < 25.001);
    CHECK(window.phase >= 0.0);
    CHECK(window.phase < 2.0 * std::numbers::pi);
    CHECK(window.phase != before);
    before = window.phase;
  }
}

}  // namespace
}  // namespace veritrack::kkl_observer

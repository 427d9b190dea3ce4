#include "reports/recording/sample_ranges.hpp"

#include <doctest/doctest.h>

#include "reports/recording/recording_units.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("neighbours are one range, and what is further away another") {
  SampleRanges ranges(3);
  ranges.add(10, 10);
  ranges.add(11, 11);
  ranges.add(14, 20);
  ranges.add(24, 24);
  CHECK(ranges.count() == 2);
  CHECK(ranges.samples() == 10);
  CHECK(listed(ranges, 5) == "samples 10 to 20 and 24");
  CHECK(listed(SampleRanges(), 5) == "none");
  SampleRanges one;
  one.add(7, 7);
  CHECK(listed(one, 5) == "sample 7");
}

TEST_CASE("only the first ranges are kept, and all are counted") {
  SampleRanges ranges;
  for (int k = 0; k < 1000; ++k) {
    ranges.add(10 * k, 10 * k + 1);
  }
  CHECK(ranges.count() == 1000);
  CHECK(ranges.kept().size() == SampleRanges::kKept);
  CHECK(ranges.kept().back().first == 990);
  CHECK(ranges.kept().back().last == 991);
  CHECK(ranges.samples() == 2000);
  CHECK(listed(ranges, 2) == "samples 0 to 1, 10 to 11, and 998 more ranges");
}

TEST_CASE("frequencies are in Hz, too, when the sample rate is known") {
  CHECK(RecordingUnits(std::nullopt).frequency(0.5) == "0.5 rad/sample");
  CHECK(RecordingUnits(1000.0).frequency(0.31415926535897931) == "0.31416 rad/sample (50 Hz)");
  CHECK(RecordingUnits(1000.0).sample(250) == "sample 250 (0.25 s)");
}

}  // namespace
}  // namespace veritrack::reports

#include "analysis/model/set/searched_band.hpp"

#include <doctest/doctest.h>

#include <string>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

TEST_CASE("a band is searched as far as it can be reached") {
  const rigor::UpwardRounding upward;
  const SearchedBand inside = searched_band(Interval::from_bounds(0.2, 0.5), 1);
  CHECK(inside.low == 0.2);
  CHECK(inside.high == 0.5);
  CHECK(inside.out_of_reach.empty());
  const SearchedBand low = searched_band(Interval::from_bounds(0.0, 0.5), 1);
  CHECK(low.low > 0.0);
  CHECK(low.low < 0.01);
  CHECK(low.high == 0.5);
  REQUIRE(low.out_of_reach.size() == 1);
  CHECK(low.out_of_reach.front().find("at 0 the samples are constant") != std::string::npos);
  for (const double end : {3.1416, 3.1415926535897936}) {
    const SearchedBand high = searched_band(Interval::from_bounds(1.0, end), 1);
    CHECK(high.low == 1.0);
    CHECK(high.high < 3.1415926);
    CHECK(high.high > 3.1);
    REQUIRE(high.out_of_reach.size() == 1);
    CHECK(high.out_of_reach.front().find("half the sample rate") != std::string::npos);
  }
  CHECK(searched_band(Interval::from_bounds(0.0, 3.1416), 2).out_of_reach.size() == 2);
  for (const Interval& none : {Interval(0.3), Interval::from_bounds(0.1, 3.2),
                               Interval::from_bounds(-0.1, 0.2), Interval::empty()}) {
    const SearchedBand nothing = searched_band(none, 1);
    CHECK(nothing.is_empty());
  }
}

}  // namespace
}  // namespace veritrack::model

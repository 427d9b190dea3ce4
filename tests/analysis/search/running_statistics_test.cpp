#include "analysis/search/running_statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

namespace veritrack::search {

TEST_CASE("mean and deviation are those of the sums, and one number that is none spoils them") {
  RunningStatistics statistics;
  for (const double value : {1.0, 2.0, 4.0, 9.0}) {
    statistics.add(value);
  }
  CHECK(statistics.count() == 4.0);
  CHECK(statistics.mean() == doctest::Approx(4.0));
  CHECK(statistics.deviation() == doctest::Approx(std::sqrt((9.0 + 4.0 + 0.0 + 25.0) / 4.0)));
  statistics.add(std::numeric_limits<double>::quiet_NaN());
  CHECK(std::isnan(statistics.mean()));
  CHECK(std::isnan(statistics.deviation()));
}

}  // namespace veritrack::search

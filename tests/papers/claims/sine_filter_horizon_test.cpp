#include "papers/claims/sine_filter_horizon.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

using namespace veritrack;

TEST_CASE("the enclosure holds the estimates of simulated runs, for noise at random and at its bound") {
  rigor::Interval found;
  {
    const rigor::UpwardRounding upward;
    found = theorems::frequency_after({"1", "2", "1e-4", "0.01", 150});
    REQUIRE(rigor::is_finite(found));
    CHECK(rigor::width(found) < 1e-3);
  }
  test::Random random(2'002);
  for (std::int64_t run = 0; run < test::effort(50); ++run) {
    trackers::SineKnownAmplitudeEkf<double> filter(
        {0.1, 0.01, 0.0, 0.0, 1}, 1.0, {Eigen::Vector2d(0.0, 2.0), Eigen::Vector2d(0.0, 1.0).asDiagonal()});
    for (int k = 1; k <= 150; ++k) {
      const double drawn = random.uniform(-1.0, 1.0);
      const double noise = run % 2 == 0 ? drawn : std::copysign(1.0, drawn);
      filter.step(std::sin(0.1 * k) + 1e-4 * noise);
    }
    CHECK(rigor::contains(found, filter.filtered().state(1)));
  }
}

TEST_CASE("an enclosure that is lost is empty") {
  const rigor::UpwardRounding upward;
  CHECK(rigor::is_empty(theorems::frequency_after({"1", "2", "0.01", "0.01"})));
}

#include "analysis/model/step/tube.hpp"

#include <doctest/doctest.h>

namespace veritrack::model {
namespace {

TEST_CASE("a series in the phase and the place, by hand") {
  // 2 + 3 z, and Re((1 - 2i) z exp(i phi)) = z (cos phi + 2 sin phi); (cos, sin) = (3/5, 4/5), z = 1/2.
  const PhaseSeries series{{{2.0, 3.0}, {0.0, {1.0, -2.0}}}};
  const std::vector<std::pair<double, double>> harmonics{{1.0, 0.0}, {0.6, 0.8}};
  CHECK(series.at(harmonics, {1.0, 0.5}) == doctest::Approx(3.5 + 0.5 * (0.6 + 1.6)));
  CHECK(PhaseSeries{}.at(harmonics, {1.0}) == 0.0);
}

TEST_CASE("a tube bounds a covariance when it has bounds of one") {
  Tube tube;
  CHECK_FALSE(tube.bounds_covariance());
  tube.covariance_high = {PhaseSeries{}};
  CHECK(tube.bounds_covariance());
  CHECK_FALSE(tube == Tube{});
}

}  // namespace
}  // namespace veritrack::model

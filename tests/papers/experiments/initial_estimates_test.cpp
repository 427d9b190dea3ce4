#include "papers/experiments/initial_estimates.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::experiments {
namespace {

TEST_CASE("at high ratios the initial estimate errs as the Cramer-Rao bound of its bins says, without bias") {
  // At 0 the bins have 1/1 + 1/4 to either side: v/2.5, v = 2/(2048 * 10).
  const InitialEstimates middle = initial_estimates(0.0, 10.0, 2000);
  CHECK(middle.bound == doctest::Approx(std::sqrt(2.0 / 20480.0 / 2.5)));
  CHECK(middle.error.deviation == doctest::Approx(middle.bound).epsilon(0.1));
  for (const double offset : {0.0, 0.5, 1.0, 1.42}) {
    CAPTURE(offset);
    const InitialEstimates found = initial_estimates(offset, 10.0, 2000);
    CHECK(std::fabs(found.error.mean) < 4.0 * found.error.mean_error);
  }
}

TEST_CASE("at the end of the range it is biased inward, by about 0.4 of the bound") {
  // Half of a normal law is cut off: its mean is 1/sqrt(2 pi) deviations off.
  const InitialEstimates end = initial_estimates(2.0, 10.0, 2000);
  CHECK(end.error.mean / end.bound == doctest::Approx(-0.3989).epsilon(0.15));
}

}  // namespace
}  // namespace veritrack::experiments

#include "certificates/quadrature/frequency_error_bounds.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/certificates/test_design.hpp"

namespace {

using namespace veritrack;

/// No run may leave the bound, rounding aside; disturbed ones must not be at rest.
void check_runs(const certificates::FrequencyErrorBounds& tube) {
  REQUIRE(!tube.runs.empty());
  double last = 0.0;
  for (const std::vector<double>& run : tube.runs) {
    REQUIRE(run.size() == tube.bound.size());
    for (std::size_t k = 0; k < run.size(); ++k) {
      CHECK(run[k] <= tube.bound[k] * (1.0 + 1e-9));
    }
    last = std::max(last, run.back());
  }
  CHECK(last > 1e-4);
}

TEST_CASE("runs from the rim of the certified set stay below its bound") {
  const auto tube = certificates::frequency_error_bounds(test::certificate());
  REQUIRE(tube.has_value());
  CHECK_FALSE(tube->from_assumed_starts);
  CHECK(tube->bound_of_assumed_starts.size() == tube->bound.size());
  CHECK(tube->bound.front() > 10.0 * tube->bound_of_assumed_starts.front());
  check_runs(*tube);
}

TEST_CASE("runs from the corners of the assumed starts stay below the bound of those that were captured") {
  const auto tube = certificates::frequency_error_bounds(
      test::certificate({{"initial_frequency_error = 0.005", "initial_frequency_error = 0.4"},
                         {"initial_phase_error = 0.005", "initial_phase_error = 0.4"},
                         {"slew = 0.0", "slew = 0.0001"}}));
  REQUIRE(tube.has_value());
  CHECK(tube->from_assumed_starts);
  CHECK(tube->bound_of_assumed_starts.empty());
  CHECK(tube->bound.front() >= 0.4);
  check_runs(*tube);
}

TEST_CASE("without a proof there is no tube") {
  CHECK_FALSE(
      certificates::frequency_error_bounds(test::certificate({{"q1 = 0.0023", "q1 = 0"}})).has_value());
  CHECK_FALSE(certificates::frequency_error_bounds(test::certificate({{"noise = 0.001", "noise = 0.5"}}))
                  .has_value());
}

}  // namespace

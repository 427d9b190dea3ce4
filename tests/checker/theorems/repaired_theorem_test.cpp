// What a verified tube says of the assumed starts.
#include "checker/theorems/repaired_theorem.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "tests/checker/theorems/error_bounds_support.hpp"

using namespace veritrack::checker;
using namespace veritrack::test::tube;

namespace {

/// Is this condition accepted as proved, of starts with errors of this size and P(0|0) so many times the
/// upper bound?
bool accepts(const std::string& id, double error, double multiple) {
  const WrittenBounds tube;
  Design design = the_design();
  design.noise = design.slew = zero;
  design.largest_frequency = one;
  design.amplitude_error = design.phase_error = design.frequency_error = Ball(error);
  std::array<std::array<Ball, 3>, 3> covariance;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      covariance[i][j] = Ball(multiple) * from_hexadecimal(tube.upper[i][j]);
    }
  }
  design.covariance = covariance;
  Objections objections;
  check_repaired_theorem(
      read_json(R"({"evidence": [)" + evidence_of(tube, "assumed") +
                R"(], "quantities": {}, "conditions": [{"id": ")" + id + R"(", "verdict": "proved"}]})"),
      design, objections);
  return objections.empty();
}

}  // namespace

TEST_CASE("a start covariance is between both bounds of the tube") {
  CHECK(accepts("P(0|0)", 0.0, 0.98));
  CHECK_FALSE(accepts("P(0|0)", 0.0, 1.02));
  CHECK_FALSE(accepts("P(0|0)", 0.0, 0.8));
}

TEST_CASE("the initial error is at most what the radius allows in every direction") {
  CHECK(accepts("2.45", 1e-5, 0.98));
  CHECK_FALSE(accepts("2.45", 0.1, 0.98));
}

#include "analysis/model/gain/floquet_proposal.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <vector>

namespace veritrack::model {

TEST_CASE("multipliers of a cell are those in the middle of its frequencies, the largest first") {
  FloquetCell cell;
  cell.curve.curve.resize(3);
  // A mode of 0.5, and a pair of 0.8 +- 0.3i; what goes with the frequency does not matter.
  for (const double entry : {0.5, 0.0, 0.0, 7.0, 0.8, -0.3, 0.0, 0.3, 0.8}) {
    cell.matrix.push_back({entry, 100.0});
  }
  const std::vector<std::complex<double>> multipliers = floquet_multipliers(cell);
  REQUIRE(multipliers.size() == 3);
  const std::vector<std::complex<double>> expected{{0.8, 0.3}, {0.8, -0.3}, {0.5, 0.0}};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(multipliers[i] - expected[i]) < 1e-12);
  }
}

}  // namespace veritrack::model

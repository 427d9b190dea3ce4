// Updates of bounds that are no covariances.
#include "checker/single_channel/cell_covariance.hpp"

#include <doctest/doctest.h>

using namespace veritrack::checker;

TEST_CASE("an update is known only where the innovation has a positive variance") {
  const Ball r(0.5);
  const CellCovariance good = updated(diagonal(Ball(-0.25), one), r);
  CHECK(good.p11.range().finite());
  CHECK_FALSE(updated(diagonal(Ball(-0.5), one), r).p11.range().finite());
  CHECK_FALSE(updated(diagonal(Ball(-2.0), one), r).p11.range().finite());
}

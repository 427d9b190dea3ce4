#include "checker/quadrature/disc_cell.hpp"

#include <doctest/doctest.h>

namespace veritrack::checker {
namespace {

TEST_CASE("a division is looked at again where its parts hold and the level is well below") {
  DiscDivision division;
  CHECK_FALSE(division.is_cut(DiscDivision::kWhole));
  division.cut(DiscDivision::kWhole, 1, 1.0);
  CHECK(division.is_cut(DiscDivision::kWhole));
  CHECK(division.side(DiscDivision::kWhole) == 1);
  CHECK_FALSE(division.may_hold(DiscDivision::kWhole, 0.95));
  CHECK(division.may_hold(DiscDivision::kWhole, 0.5));
  const std::size_t part = division.part(DiscDivision::kWhole, 1);
  division.cut(part, 0, 0.5);
  CHECK_FALSE(division.may_hold(DiscDivision::kWhole, 0.1));
  // Cut again it keeps its parts.
  division.cut(DiscDivision::kWhole, 0, 0.4);
  CHECK(division.side(DiscDivision::kWhole) == 1);
  CHECK(division.is_cut(part));
  division.undo_cut(part);
  CHECK_FALSE(division.is_cut(part));
  CHECK(division.may_hold(DiscDivision::kWhole, 0.1));
}

TEST_CASE("the halves of a cell are the cell") {
  const DiscCell cell{{-1.0, 0.5}, {0.0, 1.0}, 0.1, 0.4};
  for (std::size_t side = 0; side < 3; ++side) {
    const auto [first, second] = cell.halves(side);
    CHECK((side == 2 ? first.to == second.from : first.high[side] == second.low[side]));
    CHECK(first.low == cell.low);
    CHECK(second.high == cell.high);
    CHECK(first.from == cell.from);
    CHECK(second.to == cell.to);
  }
}

}  // namespace
}  // namespace veritrack::checker

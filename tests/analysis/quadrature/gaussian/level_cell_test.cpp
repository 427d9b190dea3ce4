#include "analysis/quadrature/gaussian/level_cell.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"

namespace veritrack::quadrature {

TEST_CASE("only cells beyond the level are left out") {
  const rigor::UpwardRounding upward;
  const LockSet set = test_sets::lock_set(0, 20.0);
  // |u|^2 + 4 s^2 = 54 on the rim.
  CHECK(is_outside(set, {{7.35, -0.1, 0.0, 0.0}, {7.5, 0.1, 0.1, 0.1}}));
  CHECK_FALSE(is_outside(set, {{7.34, -0.1, 0.0, 0.0}, {7.5, 0.1, 0.1, 0.1}}));
  CHECK(is_outside(set, {{0.0, -7.5, 0.0, 0.0}, {7.5, -7.35, 0.1, 0.1}}));
  CHECK(is_outside(set, {{0.0, 0.0, 0.0, 3.68}, {7.5, 0.1, 0.1, 3.7}}));
  CHECK_FALSE(is_outside(set, {{0.0, 0.0, 0.0, 3.67}, {7.5, 0.1, 0.1, 3.7}}));
}

TEST_CASE("the levels of a cell are those of its nearest and its farthest corner, within the set") {
  const rigor::UpwardRounding upward;
  const LockSet set = test_sets::lock_set(0, 20.0);
  const rigor::Interval levels = levels_in(set, {{-1.0, 2.0, 0.0, 0.5}, {3.0, 4.0, 1.0, 1.0}});
  CHECK(levels.lower() == doctest::Approx(0.5 * (4.0 + 4.0 * 0.25)));
  CHECK(levels.upper() == doctest::Approx(0.5 * (9.0 + 16.0 + 1.0 + 4.0)));
  CHECK(levels_in(set, {{0.0, 0.0, 0.0, 0.0}, {9.0, 9.0, 9.0, 9.0}}).upper() == set.level);
}

}  // namespace veritrack::quadrature

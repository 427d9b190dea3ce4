// Which frequency errors tell a lock from others.
#include "analysis/sets/lock_limit.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/rigor/rounding.hpp"

using namespace veritrack;
using rigor::Interval;
using sets::excludes_other_locks;

TEST_CASE("half of the distance to the next lock is not reached") {
  const rigor::UpwardRounding upward;
  CHECK(excludes_other_locks(Interval(0.0)));
  CHECK(excludes_other_locks(Interval(3.1)));
  CHECK_FALSE(excludes_other_locks(Interval(3.125)));
  CHECK_FALSE(excludes_other_locks(Interval::from_bounds(3.0, 3.2)));
  CHECK_FALSE(excludes_other_locks(Interval::empty()));
  CHECK_FALSE(excludes_other_locks(Interval::from_bounds(0.0, std::numeric_limits<double>::infinity())));
}

TEST_CASE("of one channel neither is the distance of the band from 0 and from pi") {
  const rigor::UpwardRounding upward;
  const Interval band = Interval::from_bounds(0.4, 3.0);
  CHECK(excludes_other_locks(Interval(0.14), band));
  CHECK_FALSE(excludes_other_locks(Interval(0.1415), band));
  CHECK_FALSE(excludes_other_locks(Interval(0.1), Interval::from_bounds(0.1, 1.0)));
  CHECK(excludes_other_locks(Interval(0.098), Interval::from_bounds(0.1, 1.0)));
  CHECK_FALSE(excludes_other_locks(Interval(0.0), Interval::from_bounds(0.0, 1.0)));
  CHECK_FALSE(excludes_other_locks(Interval::empty(), band));
  CHECK_FALSE(excludes_other_locks(Interval(0.1), Interval::empty()));
}

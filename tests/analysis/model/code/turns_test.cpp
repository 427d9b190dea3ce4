#include "analysis/model/code/turns.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/analysis/model/code/listing_examples.hpp"

namespace veritrack::model::code {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("a wrap is seen through, and keeps what it wraps in half a turn") {
  ListingBuilder made;
  const int x = made.sample();
  const int wrapped = made.wrapped(x);
  Turns turns(made.listing);
  CHECK(turns.is_wrapped(wrapped));
  CHECK(turns.without_turns(wrapped) == x);
  CHECK_FALSE(turns.is_wrapped(x));
  const auto range = turns.range(wrapped, x, {-2.0 * kPi, 2.0 * kPi});
  REQUIRE(range.has_value());
  CHECK(std::fabs(range->low + kPi) < 1e-5);
  CHECK(std::fabs(range->high - kPi) < 1e-5);
  // From further away one turn is not enough.
  CHECK(turns.range(wrapped, x, {-4.0 * kPi, 2.0 * kPi})->low < -1.5 * kPi);
  CHECK(turns.range(wrapped, x, {-1.0, 2.0}) == Range{-1.0, 2.0});
}

TEST_CASE("a wrap between half a turn more and half a turn less is seen through") {
  ListingBuilder made;
  const int x = made.sample();
  const int moved = made.make(Operation::fadd, {x, made.number(kPi)});
  const int left = made.make(Operation::fmod, {moved, made.number(2.0 * kPi)});
  const int is_below = made.make(Operation::fcmp, {left, made.number(0.0)}, Predicate::olt);
  const int up = made.make(Operation::fadd, {left, made.number(2.0 * kPi)});
  const int chosen = made.make(Operation::select, {is_below, up, left});
  const int centred = made.make(Operation::fsub, {chosen, made.number(kPi)});
  const int other = made.make(Operation::fsub, {chosen, made.number(1.0)});
  const int not_moved = made.make(Operation::fadd, {x, made.number(kPi)});
  Turns turns(made.listing);
  CHECK(turns.is_wrapped(centred));
  CHECK(turns.without_turns(centred) == x);
  CHECK(turns.without_turns(chosen) == moved);
  CHECK_FALSE(turns.is_wrapped(other));
  CHECK_FALSE(turns.is_wrapped(not_moved));
  const auto range = turns.range(centred, x, {-2.1 * kPi, 2.1 * kPi});
  REQUIRE(range.has_value());
  CHECK(std::fabs(range->low + kPi) < 2e-5);
  CHECK(std::fabs(range->high - kPi) < 2e-5);
  const auto shifts = turns.shifts(centred, x, {-2.1 * kPi, 2.1 * kPi});
  REQUIRE(shifts.has_value());
  for (const Turns::Shift& shift : *shifts) {
    CHECK(std::fabs(std::remainder(shift.by, 2.0 * kPi)) < 1e-6);
    CHECK(shift.roundings >= 2.0 * 0x1p-24);
  }
}

TEST_CASE("what is not a whole turn is no wrap") {
  for (const double off : {1e-4, -1e-4, 0.1, kPi}) {
    ListingBuilder made;
    const int x = made.sample();
    const int above = made.make(Operation::fcmp, {x, made.number(kPi)}, Predicate::ogt);
    const int moved = made.make(Operation::fsub, {x, made.number(2.0 * kPi + off)});
    const int chosen = made.make(Operation::select, {above, moved, x});
    CHECK_FALSE(Turns(made.listing).is_wrapped(chosen));
    // As an old PLL has it: at a turn, the angle is 0.
    const int reset = made.make(Operation::select, {above, made.number(0.0), x});
    CHECK_FALSE(Turns(made.listing).is_wrapped(reset));
  }
}

TEST_CASE("a condition that cannot hold in a range is never true, one that may is not") {
  ListingBuilder made;
  const int x = made.sample();
  const int wrapped = made.wrapped(x);
  const int above = made.make(Operation::fcmp, {wrapped, made.number(3.2)}, Predicate::ogt);
  const int next_to = made.make(Operation::fcmp, {wrapped, made.number(3.1)}, Predicate::ogt);
  const int is_no_number = made.make(Operation::fcmp, {x, x}, Predicate::uno);
  const Turns turns(made.listing);
  CHECK(turns.is_never(above, x, {-6.0, 6.0}));
  CHECK_FALSE(turns.is_never(next_to, x, {-6.0, 6.0}));
  CHECK(turns.is_never(is_no_number, x, {-6.0, 6.0}));
  CHECK_FALSE(turns.is_never(above, x, {-6.0, 16.0}));
}

}  // namespace veritrack::model::code

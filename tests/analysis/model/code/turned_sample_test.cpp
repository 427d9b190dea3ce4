// The angle of a sample that is turned back, in single precision, against the same in double.
#include "analysis/model/code/turned_sample.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/model/code/listing_rounding.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/code/listing_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model::code {
namespace {

/// atan2(b*cos(t) - a*sin(t), a*cos(t) + b*sin(t)), or with the parts in another place.
struct TurnedLoop {
  ListingBuilder made;
  int arc = -1;
  int turn = -1;
  explicit TurnedLoop(bool is_swapped = false, bool is_other_angle = false) {
    const int a = made.sample();
    const int b = made.sample();
    const int theta = made.state("theta");
    turn = theta;
    const int sine = made.make(Operation::sin, {theta});
    const int cosine =
        made.make(Operation::cos, {is_other_angle ? made.make(Operation::fadd, {theta, a}) : theta});
    const auto product = [&](int x, int y) { return made.make(Operation::fmul, {x, y}); };
    const int y = made.make(Operation::fsub, {product(b, cosine), product(sine, a)});
    const int x = is_swapped ? made.make(Operation::fadd, {product(a, sine), product(b, cosine)})
                             : made.make(Operation::fadd, {product(sine, b), product(a, cosine)});
    arc = made.make(Operation::atan2, {y, x});
    made.listing.states[0].next = made.make(Operation::fmul, {arc, made.number(0.5)});
    made.listing.frequency = theta;
  }
};

}  // namespace

TEST_CASE("the samples, turned back by one angle, are found in any order of factors, and nothing else is") {
  const auto turn_of = [](const TurnedLoop& loop) {
    return turned_back_by(loop.made.listing,
                          loop.made.listing.instructions[static_cast<std::size_t>(loop.arc)]);
  };
  const TurnedLoop loop;
  CHECK(turn_of(loop) == loop.turn);
  CHECK_FALSE(turn_of(TurnedLoop(true)).has_value());
  CHECK_FALSE(turn_of(TurnedLoop(false, true)).has_value());
}

TEST_CASE("the computed angle is not further off than its bound, however short the sample") {
  test::Random random;
  double most = 0.0;
  for (std::int64_t i = 0; i < test::effort(200'000); ++i) {
    const double length = std::pow(10.0, random.uniform(-6.0, 0.3));
    const double angle = random.uniform(-3.14, 3.14);
    const auto a = static_cast<float>(length * std::cos(angle));
    const auto b = static_cast<float>(length * std::sin(angle));
    const auto t = static_cast<float>(random.uniform(-4.0, 4.0));
    const float y = b * std::cos(t) - a * std::sin(t);
    const float x = a * std::cos(t) + b * std::sin(t);
    const double exact = std::atan2(static_cast<double>(b), static_cast<double>(a)) - static_cast<double>(t);
    const double computed = std::atan2(static_cast<double>(y), static_cast<double>(x));
    most = std::max(most, std::fabs(std::remainder(computed - exact, 6.283185307179586)));
  }
  const rigor::UpwardRounding upward;
  const double bound = error_of_turned_sample(kSingle, 0.0, 0x1.8p-24, 1e-6);
  CHECK(most <= bound);
  CHECK(most >= 0.15 * bound);
  CHECK(error_of_turned_sample(kSingle, 1e-5, 0x1.8p-24, 1e-6) >= bound + 1e-5);
  // Nothing is known where the sample may be 0, or as small as what is flushed.
  CHECK(error_of_turned_sample(kSingle, 0.0, 0x1.8p-24, 0.0) == std::numeric_limits<double>::infinity());
  CHECK(error_of_turned_sample(kSingle, 0.0, 0x1.8p-24, 0x1p-120) == std::numeric_limits<double>::infinity());
}

TEST_CASE("an angle of turned samples has a bound with a limit below half a turn and a length, else none") {
  const rigor::UpwardRounding upward;
  TurnedLoop loop;
  const auto bound = [&](double limit, double least) {
    WrittenFacts facts;
    const auto number = [&](double value) {
      Instruction input;
      input.operation = Operation::input;
      input.format = kSingle;
      const int place = loop.made.put(input);
      facts.numbers[place] = {rigor::Interval(value), value};
      return place;
    };
    const int low = number(-limit);
    const int high = number(limit);
    facts.limits.push_back({loop.arc, low, high});
    const StepRanges ranges{{rigor::Interval::from_bounds(-3.0, 3.0)},
                            rigor::Interval::from_bounds(-2.0, 2.0),
                            {},
                            &facts,
                            least};
    return step_rounding(loop.made.listing, ranges).has_value();
  };
  CHECK(bound(3.125, 1e-3));
  CHECK_FALSE(bound(3.141592, 1e-3));
  CHECK_FALSE(bound(3.125, 0.0));
}

TEST_CASE("in a listing of code such an angle has its limit in the recursion, and needs a length") {
  const rigor::UpwardRounding upward;
  const TurnedLoop loop;
  const auto bound = [&](double least) {
    const StepRanges ranges{{rigor::Interval::from_bounds(-3.0, 3.0)},
                            rigor::Interval::from_bounds(-2.0, 2.0),
                            {},
                            nullptr,
                            least};
    return step_rounding(loop.made.listing, ranges);
  };
  REQUIRE(bound(1e-3));
  CHECK(bound(1e-3)->next[0] > 0x1p-24);
  CHECK(bound(1e-3)->next[0] < 0x1p-20);
  CHECK_FALSE(bound(0.0));
}

}  // namespace veritrack::model::code

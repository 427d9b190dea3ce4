// Bounds on rounding, against the same operations in twice the precision.
#include "analysis/model/code/listing_rounding.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/code/listing_examples.hpp"
#include "tests/support/random.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::model::code {
namespace {

using rigor::Interval;

/// The same operations in binary64, and constants at their value in binary32.
Listing in_double(Listing listing) {
  for (Instruction& instruction : listing.instructions) {
    if (instruction.format == kSingle) {
      if (instruction.operation == Operation::constant) {
        instruction.bits = trackers::code::bits_of(trackers::code::kDouble,
                                                   trackers::code::number_of(kSingle, instruction.bits));
      }
      instruction.format = trackers::code::kDouble;
    }
  }
  return listing;
}

struct Off {
  std::array<double, 2> next{};
  double frequency = 0.0;
};

/// What steps in single precision are off, at most, of random states and samples; angles modulo turns.
Off largest_off(const Listing& listing, std::int64_t count) {
  const rigor::NearestRounding nearest;
  const Listing precise = in_double(listing);
  test::Random random;
  const auto between = [&](double low, double high) { return static_cast<float>(random.uniform(low, high)); };
  Off most;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::array<float, 3> inputs{between(-3.141592, 3.141592), between(0.2, 0.5), between(-2.0, 2.0)};
    std::array<std::uint64_t, 3> single{};
    std::array<std::uint64_t, 3> twice{};
    for (std::size_t i = 0; i < 3; ++i) {
      single[i] = trackers::code::bits_of(kSingle, static_cast<double>(inputs[i]));
      twice[i] = trackers::code::bits_of(trackers::code::kDouble, static_cast<double>(inputs[i]));
    }
    const auto computed = trackers::code::run(listing, std::span(single).first(2), std::span(single).last(1));
    const auto exact = trackers::code::run(precise, std::span(twice).first(2), std::span(twice).last(1));
    for (std::size_t i = 0; i < 2; ++i) {
      const auto next = static_cast<std::size_t>(listing.states[i].next);
      const double difference = trackers::code::number_of(kSingle, computed[next]) -
                                trackers::code::number_of(trackers::code::kDouble, exact[next]);
      // The double's turn is the single's.
      const double off = i == 0 ? std::remainder(difference, static_cast<double>(6.2831855F)) : difference;
      most.next[i] = std::max(most.next[i], std::fabs(off));
    }
  }
  return most;
}

StepRanges ranges_of(const Listing& listing) {
  const double half = std::numbers::pi + kWrapSlack;
  Turns turns(listing);
  const int base = turns.without_turns(listing.states[0].next);
  return {{Interval::from_bounds(-half, half), Interval::from_bounds(0.2, 0.5)},
          Interval::from_bounds(-2.0, 2.0),
          {{base, Range{-2.0 * half, 2.0 * half}}}};
}

}  // namespace

TEST_CASE("no step is further off than its bound, and the bound is not far above") {
  for (const double kp : {0.02, 0.2}) {
    const Listing listing = multiplying_loop(kp, 0.25 * kp * kp);
    const Off off = largest_off(listing, test::effort(200'000));
    const rigor::UpwardRounding upward;
    const auto bound = step_rounding(listing, ranges_of(listing));
    REQUIRE(bound.has_value());
    CAPTURE(kp);
    for (std::size_t i = 0; i < 2; ++i) {
      CAPTURE(off.next[i]);
      CAPTURE(bound->next[i]);
      CHECK(off.next[i] <= bound->next[i]);
      CHECK(off.next[i] >= 0.15 * bound->next[i]);
    }
    CHECK(bound->frequency == 0.0);  // w is reported as it is
  }
}

TEST_CASE("a branch that jumps and is not decided has no bound, and one that is decided is as good as none") {
  const rigor::UpwardRounding upward;
  const auto with_reset = [](double limit) {
    ListingBuilder made;
    const int y = made.sample();
    const int w = made.state("w");
    const int sum = made.make(Operation::fadd, {w, y});
    const int above = made.make(Operation::fcmp, {sum, made.number(limit)}, Predicate::ogt);
    const int far_above = made.make(Operation::fcmp, {w, made.number(2.0)}, Predicate::ogt);
    const int either =
        made.make(Operation::select, {far_above, far_above, above}, Predicate::none, trackers::code::kBit);
    made.listing.states[0].next = made.make(Operation::select, {either, made.number(0.0), sum});
    made.listing.frequency = w;
    return made.listing;
  };
  const StepRanges ranges{{Interval::from_bounds(0.2, 0.5)}, Interval::from_bounds(-0.1, 0.1), {}};
  int without = -1;
  const Listing jumping = with_reset(0.3);
  CHECK_FALSE(step_rounding(jumping, ranges, &without).has_value());
  REQUIRE(without >= 0);
  CHECK(jumping.instructions[static_cast<std::size_t>(without)].operation == Operation::select);
  const auto idle = step_rounding(with_reset(1.0), ranges);
  REQUIRE(idle.has_value());
  CHECK(idle->next[0] <= 0x1p-24);
}

TEST_CASE("a division by what may be 0, an infinite constant, a result out of range: no bound") {
  const rigor::UpwardRounding upward;
  const StepRanges ranges{{Interval::from_bounds(0.2, 0.5)}, Interval::from_bounds(-0.1, 0.1), {}};
  const auto bound = [&](const auto& next) {
    ListingBuilder made;
    const int y = made.sample();
    const int w = made.state("w");
    made.listing.frequency = w;
    made.listing.states[0].next = next(made, y, w);
    return step_rounding(made.listing, ranges);
  };
  CHECK_FALSE(bound([](ListingBuilder& made, int y, int w) { return made.make(Operation::fdiv, {w, y}); }));
  CHECK(bound([](ListingBuilder& made, int y, int w) { return made.make(Operation::fdiv, {y, w}); }));
  CHECK_FALSE(bound([](ListingBuilder& made, int y, int /*w*/) {
    return made.make(Operation::fmul, {y, made.number(INFINITY)});
  }));
  CHECK_FALSE(bound([](ListingBuilder& made, int /*y*/, int w) {
    return made.make(Operation::fmul,
                     {made.make(Operation::fmul, {w, made.number(3e38)}), made.number(1e10)});
  }));
  CHECK_FALSE(bound([](ListingBuilder& made, int y, int /*w*/) { return made.make(Operation::floor, {y}); }));
  CHECK_FALSE(bound([](ListingBuilder& made, int y, int /*w*/) { return made.make(Operation::sqrt, {y}); }));
}

TEST_CASE("a choice that meets where it turns is bounded on both sides; with other limits it jumps") {
  const rigor::UpwardRounding upward;
  const StepRanges ranges{{Interval::from_bounds(-1.0, 1.0)}, Interval::from_bounds(-0.1, 0.1), {}};
  const auto bound = [&](double limit, double taken) {
    ListingBuilder made;
    const int y = made.sample();
    const int w = made.state("w");
    const int sum = made.make(Operation::fadd, {w, y});
    const int below = made.make(Operation::fcmp, {sum, made.number(-limit)}, Predicate::olt);
    const int inner = made.make(Operation::select, {below, made.number(-taken), sum});
    const int above = made.make(Operation::fcmp, {sum, made.number(limit)}, Predicate::ogt);
    made.listing.states[0].next = made.make(Operation::select, {above, made.number(taken), inner});
    made.listing.frequency = w;
    return step_rounding(made.listing, ranges);
  };
  CHECK(bound(0.5, 0.5).has_value());
  CHECK_FALSE(bound(0.5, 0.4).has_value());
  const auto absolute = [&](bool negates) {
    ListingBuilder made;
    const int y = made.sample();
    const int w = made.state("w");
    const int sum = made.make(Operation::fadd, {w, y});
    const int below = made.make(Operation::fcmp, {sum, made.number(0.0)}, Predicate::olt);
    const int other =
        negates ? made.make(Operation::fneg, {sum}) : made.make(Operation::fadd, {sum, made.number(1.0)});
    made.listing.states[0].next = made.make(Operation::select, {below, other, sum});
    made.listing.frequency = w;
    return step_rounding(made.listing, ranges);
  };
  CHECK(absolute(true).has_value());
  CHECK_FALSE(absolute(false).has_value());
}

TEST_CASE("conversions between a wrap and what is wrapped are rounded, too") {
  using trackers::code::kDouble;
  const rigor::UpwardRounding upward;
  const auto bound = [](bool converts) {
    ListingBuilder made;
    const int y = made.sample();
    const int theta = made.state("theta");
    const int sum = made.make(Operation::fadd,
                              {made.make(Operation::fpext, {theta}, Predicate::none, kDouble),
                               made.make(Operation::fpext, {y}, Predicate::none, kDouble)},
                              Predicate::none, kDouble);
    const int base = converts ? made.make(Operation::fptrunc, {sum}) : sum;
    made.listing.states[0].next = made.wrapped(base);
    made.listing.frequency = theta;
    const double half = std::numbers::pi;
    const StepRanges ranges{{Interval::from_bounds(-half, half)},
                            Interval::from_bounds(-1.0, 1.0),
                            {{sum, Range{-2.0 * half, 2.0 * half}}}};
    return step_rounding(made.listing, ranges).value().next[0];
  };
  // Of the sum and of the turn that is taken off, in single precision, up to two half turns.
  CHECK(bound(true) >= bound(false) + 0x1p-24 * std::numbers::pi);
}

TEST_CASE("a choice between numbers that are rounded before they are compared has no bound") {
  const rigor::UpwardRounding upward;
  const auto smaller = [](bool is_rounded) {
    ListingBuilder made;
    const int y = made.sample();
    const int w = made.state("w");
    const int precise = made.make(Operation::fpext, {y}, Predicate::none, trackers::code::kDouble);
    const int sum = made.make(Operation::fmul, {precise, precise}, Predicate::none, trackers::code::kDouble);
    const int compared = is_rounded ? made.make(Operation::fptrunc, {sum}) : sum;
    const int other = made.make(Operation::fpext, {w}, Predicate::none, trackers::code::kDouble);
    const int less = made.make(Operation::fcmp, {compared, is_rounded ? w : other}, Predicate::olt);
    const int chosen =
        made.make(Operation::select, {less, sum, other}, Predicate::none, trackers::code::kDouble);
    made.listing.states[0].next = made.make(Operation::fptrunc, {chosen});
    made.listing.frequency = w;
    return made.listing;
  };
  const StepRanges ranges{{Interval::from_bounds(0.2, 0.5)}, Interval::from_bounds(-1.0, 1.0), {}};
  CHECK_FALSE(step_rounding(smaller(true), ranges).has_value());
  CHECK(step_rounding(smaller(false), ranges).has_value());
}

}  // namespace veritrack::model::code

// Arc tangents that a program computes by itself, against the same operations in single precision.
#include "analysis/model/code/arc_tangent.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/code/listing_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model::code {
namespace {

struct Polynomial {
  double cubic = 0.1963, linear = 0.9817;
  bool takes_samples_elsewhere = false;
  Format format = kSingle;
};

/// By quadrants, as motor controllers have it; its difference to an angle, wrapped, is all that is used.
Listing with_polynomial(const Polynomial& of) {
  ListingBuilder made;
  const int x = made.sample();
  const int y = made.sample();
  for (const int sample : {x, y}) {
    made.listing.instructions[static_cast<std::size_t>(sample)].format = of.format;
  }
  const int theta = made.state("theta");
  const int size = made.make(Operation::fadd, {made.make(Operation::fabs, {y}), made.number(1e-20)});
  const int is_left = made.make(Operation::fcmp, {x, made.number(0.0)}, Predicate::olt);
  const int sum = made.make(Operation::fadd, {x, size});
  const int left = made.make(Operation::fdiv, {sum, made.make(Operation::fsub, {size, x})});
  const int right = made.make(Operation::fdiv, {made.make(Operation::fsub, {x, size}), sum});
  const int share = made.make(Operation::select, {is_left, left, right});
  const int quarter =
      made.make(Operation::select, {is_left, made.number(2.35619449), made.number(0.785398163)});
  const int cubic =
      made.make(Operation::fmul, {made.make(Operation::fmul, {share, made.number(of.cubic)}), share});
  const int factor = made.make(Operation::fsub, {cubic, made.number(of.linear)});
  const int angle = made.make(Operation::fadd, {quarter, made.make(Operation::fmul, {factor, share})});
  const int is_below = made.make(Operation::fcmp, {y, made.number(0.0)}, Predicate::olt);
  const int arc = made.make(Operation::select, {is_below, made.make(Operation::fneg, {angle}), angle});
  const int difference = made.wrapped(made.make(Operation::fsub, {arc, theta}));
  int next = made.make(Operation::fadd, {theta, difference});
  if (of.takes_samples_elsewhere) {
    next = made.make(Operation::fadd, {next, made.make(Operation::fmul, {x, made.number(1e-3)})});
  }
  made.listing.states[0].next = made.wrapped(next);
  made.listing.frequency = theta;
  return made.listing;
}

float polynomial(float y, float x) {
  const float size = std::fabs(y) + 1e-20F;
  const float share = x < 0.0F ? (x + size) / (size - x) : (x - size) / (x + size);
  const float angle = (x < 0.0F ? 2.35619449F : 0.785398163F) + (share * 0.1963F * share - 0.9817F) * share;
  return y < 0.0F ? -angle : angle;
}

}  // namespace

TEST_CASE(
    "the polynomial is as near the arc tangent as it is found to be, at all scales, and nearly as far") {
  const std::optional<ArcTangent> found = [] {
    const rigor::UpwardRounding upward;
    return arc_tangent(with_polynomial({}));
  }();
  REQUIRE(found.has_value());
  double far = 0.0;
  double largest = 0.0;
  test::Random random(31);
  const auto look = [&](double x, double y) {
    const auto a = static_cast<float>(x);
    const auto b = static_cast<float>(y);
    const double value = static_cast<double>(polynomial(b, a));
    const double off = value - std::atan2(static_cast<double>(b), static_cast<double>(a));
    far = std::max(far, std::fabs(std::remainder(off, 2.0 * M_PI)));
    largest = std::max(largest, std::fabs(value));
  };
  for (std::int64_t k = std::max<std::int64_t>(10'000, test::effort(100'000)); k > 0; --k) {
    const double scale = std::exp2(random.uniform(-40.0, 39.0));
    const double angle = random.uniform(-M_PI, M_PI);
    look(scale * std::cos(angle), scale * std::sin(angle));
  }
  for (const double small : {0.0, 1e-45, 1e-40, 1e-30, 1e-10}) {
    for (const double sign : {-1.0, 1.0}) {
      look(sign, small);
      look(sign, -small);
      look(small, sign);
      look(-small, sign);
    }
  }
  CHECK(far <= found->error);
  CHECK(far > 0.95 * found->error);
  CHECK(largest <= found->largest);
  CHECK(found->largest < 3.15);
  const Listing replaced = with_arc_tangent(with_polynomial({}), *found);
  const Instruction& arc = replaced.instructions[static_cast<std::size_t>(found->value)];
  CHECK(arc.operation == Operation::atan2);
  CHECK(arc.operands == std::array{replaced.samples[1], replaced.samples[0], -1});
}

TEST_CASE("what is no arc tangent of the samples alone is none") {
  const rigor::UpwardRounding upward;
  CHECK(arc_tangent(with_polynomial({.cubic = 0.19})).has_value());  // within 0.1 still
  CHECK_FALSE(arc_tangent(with_polynomial({.linear = 0.8})).has_value());
  CHECK_FALSE(arc_tangent(with_polynomial({.takes_samples_elsewhere = true})).has_value());
  CHECK_FALSE(arc_tangent(with_polynomial({.format = trackers::code::kDouble})).has_value());
  CHECK_FALSE(arc_tangent(multiplying_loop(0.1, 0.01)).has_value());
}

}  // namespace veritrack::model::code

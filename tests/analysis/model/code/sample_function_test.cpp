// Functions of both samples, against the same operations in single precision.
#include "analysis/model/code/sample_function.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/code/listing_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model::code {
namespace {

using rigor::Interval;

/// (x - |y|)/(x + |y| + small), negated below the axis.
struct Ratio {
  explicit Ratio(double small) {
    const int x = made.sample();
    const int y = made.sample();
    const int size = made.make(Operation::fadd, {made.make(Operation::fabs, {y}), made.number(small)});
    const int ratio = made.make(
        Operation::fdiv, {made.make(Operation::fsub, {x, size}), made.make(Operation::fadd, {x, size})});
    const int is_below = made.make(Operation::fcmp, {y, made.number(0.0)}, Predicate::olt);
    place = made.make(Operation::select, {is_below, made.make(Operation::fneg, {ratio}), ratio});
  }
  ListingBuilder made;
  int place = -1;
};

}  // namespace

TEST_CASE("a ratio is enclosed at all scales, and little more") {
  const Ratio ratio(1e-20);
  SampleFunction function(ratio.made.listing, ratio.place);
  test::Random random(32);
  for (std::int64_t k = test::effort(2000); k > 0; --k) {
    const double x = random.uniform(0.1, 1.0);
    const double y = random.uniform(-1.0, 1.0);
    const std::optional<Interval> found = [&] {
      const rigor::UpwardRounding upward;
      return function.value(Interval(x), Interval(y));
    }();
    REQUIRE(found.has_value());
    CHECK(found->upper() - found->lower() < 1e-6);
    const double scale = std::exp2(static_cast<double>(random.below(79)) - 39.0);
    const auto a = static_cast<float>(x);
    const auto b = static_cast<float>(y);
    const float s = static_cast<float>(scale) * a;
    const float size = std::fabs(static_cast<float>(scale) * b) + 1e-20F;
    const double computed = static_cast<double>((s - size) / (s + size)) * (b < 0.0F ? -1.0 : 1.0);
    // The samples themselves are rounded here.
    CHECK(computed >= found->lower() - 1e-6);
    CHECK(computed <= found->upper() + 1e-6);
  }
}

TEST_CASE("what depends on the scale, or may divide by 0, has no value") {
  const rigor::UpwardRounding upward;
  const Ratio large(1e-3);  // which is more than the smallest samples
  CHECK_FALSE(
      SampleFunction(large.made.listing, large.place).value(Interval(1.0), Interval(0.5)).has_value());
  const Ratio ratio(1e-20);
  SampleFunction function(ratio.made.listing, ratio.place);
  CHECK_FALSE(function.value(Interval::from_bounds(-1.0, 1.0), Interval(0.5)).has_value());
  ListingBuilder made;
  const int x = made.sample();
  (void)made.sample();
  CHECK_FALSE(SampleFunction(made.listing, made.make(Operation::fadd, {x, x}))
                  .value(Interval(1.0), Interval(0.5))
                  .has_value());
}

}  // namespace veritrack::model::code

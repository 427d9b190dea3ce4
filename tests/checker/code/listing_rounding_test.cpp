// Bounds on rounding, against a program that is run in single precision and in double.
#include "checker/code/listing_rounding.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

/// y and w, and an operation or more on them that make the next w.
CodeListing listing_of(const std::string& operations, const std::string& next) {
  return read_listing("veritrack listing 1\nsample r0 f32 y\nstate r1 f32:0x0p+0 w\n" + operations +
                      "next r1 " + next + "\nfrequency r1\n");
}

constexpr double kUnit = 0x1p-24;

/// The bound of the next w in units of 2^-24, for |w - 0.35| <= 0.15 and |y| <= 1; negative where there is
/// none.
double bound(const std::string& operations, const std::string& next, const ListedAngles& angles = {}) {
  const auto found = listing_rounding(listing_of(operations, next), angles,
                                      {Ball::hull(Ball(0.2), Ball(0.5))}, Ball::within(one));
  return found ? found->front().upper_double() / kUnit : -1.0;
}

}  // namespace

TEST_CASE("an operation is off by half a unit in the last place of its largest result, and by its operands") {
  CHECK(bound("r2 = fadd.f32 r0 r1\n", "r2") == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(bound("r2 = fmul.f32 r0 r1\n", "r2") == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(bound("r2 = fdiv.f32 r0 r1\n", "r2") == doctest::Approx(5.0).epsilon(1e-6));
  // w is not changed, but a start is rounded.
  CHECK(bound("r2 = fneg.f32 r1\n", "r2") == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(bound("r2 = fadd.f32 r0 r1\nr3 = fadd.f32 r2 r1\n", "r3") ==
        doctest::Approx(1.5 + 2.0).epsilon(1e-6));
  CHECK(bound("r2 = sin.f32 r0\n", "r2") == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(bound("r2 = sqrt.f32 r1\n", "r2") == doctest::Approx(std::sqrt(0.5)).epsilon(1e-6));
}

TEST_CASE("steps in single precision stay within the bound") {
  const std::string operations =
      "r2 = fmul.f32 r0 f32:0x1.99999ap-4\nr3 = fsub.f32 r2 r1\nr4 = fmul.f32 r3 r3\nr5 = fadd.f32 r4 "
      "f32:0x1p+0\n"
      "r6 = fdiv.f32 r3 r5\n";
  const double most = kUnit * bound(operations, "r6");
  test::Random random;
  double worst = 0.0;
  for (std::int64_t k = test::effort(100'000); k > 0; --k) {
    const auto y = static_cast<float>(random.uniform(-1.0, 1.0));
    const auto w = static_cast<float>(random.uniform(0.2, 0.5));
    const float a = y * 0.1F - w;
    const float computed = a / (a * a + 1.0F);
    const double b = static_cast<double>(y) * static_cast<double>(0.1F) - static_cast<double>(w);
    worst = std::max(worst, std::fabs(static_cast<double>(computed) - b / (b * b + 1.0)));
  }
  CHECK(worst <= most);
  CHECK(worst >= 0.2 * most);
}

TEST_CASE(
    "no bound: a division by what may be 0, a jump that is not decided, an overflow, an unknown operation") {
  CHECK(bound("r2 = fdiv.f32 r1 r0\n", "r2") < 0.0);
  CHECK(bound("r2 = fcmp.ogt.f32 r0 f32:0x1p-1\nr3 = select.f32 r2 f32:0x0p+0 r0\n", "r3") < 0.0);
  CHECK(bound("r2 = fcmp.ogt.f32 r0 f32:0x1p+1\nr3 = select.f32 r2 f32:0x0p+0 r0\n", "r3") > 0.0);
  // This or that, as a choice of bits: w may be above 0.25, and is below 1.
  const std::string either =
      "r2 = fcmp.ogt.f32 r0 f32:0x1p+1\nr3 = fcmp.ogt.f32 r1 f32:0x1p-2\nr4 = fcmp.ogt.f32 r1 f32:0x1p+0\n";
  CHECK(bound(either + "r5 = select.i1 r2 i1:1 r4\nr6 = select.f32 r5 f32:0x0p+0 r0\n", "r6") > 0.0);
  CHECK(bound(either + "r5 = select.i1 r2 i1:1 r3\nr6 = select.f32 r5 f32:0x0p+0 r0\n", "r6") < 0.0);
  CHECK(bound(either + "r5 = select.i1 r3 r2 r4\nr6 = select.f32 r5 f32:0x0p+0 r0\n", "r6") > 0.0);
  CHECK(bound(either + "r5 = select.i1 r3 i1:1 i1:0\nr6 = select.f32 r5 f32:0x0p+0 r0\n", "r6") < 0.0);
  CHECK(bound("r2 = fmul.f32 r0 f32:0x1p+127\nr3 = fmul.f32 r2 f32:0x1p-127\n", "r3") < 0.0);
  CHECK(bound("r2 = floor.f32 r0\n", "r2") < 0.0);
  CHECK(bound("r2 = sqrt.f32 r0\n", "r2") < 0.0);
  CHECK(bound("r2 = acos.f32 r0\n", "r2") < 0.0);
}

TEST_CASE("a sine of a large argument is off by as much as any function of the library") {
  // 10 y, half of a unit of 10 off.
  CHECK(bound("r2 = fmul.f32 r0 f32:0x1.4p+3\nr3 = sin.f32 r2\n", "r3") ==
        doctest::Approx(10.0 + 4.0).epsilon(1e-6));
  CHECK(bound("r2 = fmul.f32 r0 f32:0x1p+2\nr3 = cos.f32 r2\n", "r3") ==
        doctest::Approx(4.0 + 1.5).epsilon(1e-6));
}

TEST_CASE("a logarithm has a bound where its argument is positive with what that is off") {
  CHECK(bound("r2 = log.f32 r1\n", "r2") == doctest::Approx(4.0 * std::log(5.0)).epsilon(1e-6));
  CHECK(bound("r2 = log.f32 r0\n", "r2") < 0.0);
  // w - 0.19999999 is 1.2e-8 or more, and off by 1.8e-8.
  CHECK(bound("r2 = fadd.f32 r1 f32:-0x1.999998p-3\nr3 = log.f32 r2\n", "r3") < 0.0);
}

TEST_CASE("the angle of a point is off by what the point is, and has no bound near the half turn") {
  CHECK(bound("r2 = atan2.f32 r0 r1\n", "r2") == doctest::Approx(4.0 * std::acos(-1.0)).epsilon(1e-6));
  // y + w is off by 1.5 units, at 0.2 or more from the half turn.
  const std::string off = "r2 = fadd.f32 r0 r1\n";
  CHECK(bound(off + "r3 = atan2.f32 r2 r1\n", "r3") ==
        doctest::Approx(2.0 * 1.5 / 0.2 + 4.0 * std::acos(-1.0)).epsilon(1e-6));
  CHECK(bound(off + "r3 = atan2.f32 r2 r0\n", "r3") < 0.0);
}

TEST_CASE("a choice that meets where it turns is bounded, with other numbers it is not") {
  const auto clamped = [](const char* taken) {
    const std::string high(taken);
    return bound(
        "r2 = fadd.f32 r0 r1\nr3 = fcmp.olt.f32 r2 f32:-0x1p-1\nr4 = select.f32 r3 f32:-0x1p-1 r2\n"
        "r5 = fcmp.ogt.f32 r2 f32:0x1p-1\nr6 = select.f32 r5 f32:" +
            high + " r4\n",
        "r6");
  };
  CHECK(clamped("0x1p-1") == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(clamped("0x1p-2") < 0.0);
  CHECK(bound("r2 = fcmp.olt.f32 r0 f32:0x0p+0\nr3 = fneg.f32 r0\nr4 = select.f32 r2 r3 r0\n", "r4") > 0.0);
  CHECK(bound("r2 = fcmp.olt.f32 r0 f32:0x0p+0\nr3 = fadd.f32 r0 f32:0x1p+0\nr4 = select.f32 r2 r3 r0\n",
              "r4") < 0.0);
}

TEST_CASE("a wrap is off by its constant, and a wrapped value is a number only away from half a turn") {
  const std::string operations =
      "r2 = fadd.f32 r0 r1\nr3 = fcmp.ogt.f32 r2 f32:0x1.921fb6p+1\nr4 = fadd.f32 r2 f32:-0x1.921fb6p+2\n"
      "r5 = select.f32 r3 r4 r2\nr6 = fmul.f32 r5 f32:0x1p+0\n";
  ListedAngles angles;
  // Places are counted with constants: find the select.
  const CodeListing listing = listing_of(operations, "r6");
  for (std::size_t i = 0; i < listing.operations.size(); ++i) {
    if (listing.operations[i].is("select")) {
      angles.wraps = {
          {static_cast<int>(i),
           {listing.operations[i].operands[2], 3.2, {{0.0, 0.0}, {-0x1.921fb6p+2, kUnit}}, true}}};
    }
  }
  const double limited = kUnit * bound(operations, "r6", angles);
  CHECK(limited > 1.7e-7);  // the turn in single precision
  CHECK(limited < 1e-6);
  angles.wraps.begin()->second.is_limited = false;
  CHECK(bound(operations, "r6", angles) < 0.0);
  CHECK(kUnit * bound(operations, "r5", angles) >
        1.7e-7);  // as an angle's next value it is known modulo turns
}

TEST_CASE("a choice between numbers that are rounded before they are compared has no bound") {
  // The smaller of y and 1/2; but what is a little less than 1/2 is rounded to it before it is compared.
  const std::string begin =
      "veritrack listing 1\nsample r0 f64 y\nstate r1 f64:0x0p+0 w\nr2 = fptrunc.f32 r0\n";
  const auto has_bound = [&](const std::string& choice) {
    return listing_rounding(read_listing(begin + choice + "next r1 r4\nfrequency r1\n"), {},
                            {Ball::within(one)}, Ball::within(one))
        .has_value();
  };
  CHECK_FALSE(has_bound("r3 = fcmp.olt.f32 r2 f32:0x1p-1\nr4 = select.f64 r3 r0 f64:0x1p-1\n"));
  CHECK(has_bound("r3 = fcmp.olt.f64 r0 f64:0x1p-1\nr4 = select.f64 r3 r0 f64:0x1p-1\n"));
}

}  // namespace veritrack::checker

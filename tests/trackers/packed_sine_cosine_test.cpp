#include "trackers/packed_sine_cosine.hpp"

#include <doctest/doctest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "tests/support/random.hpp"

namespace {

using veritrack::trackers::Packed;

/// |computed - exact| of sine (or cosine) in units in the last place of the exact value, by MPFR.
template <typename Scalar>
double error_in_units(Scalar angle, Scalar computed, bool of_sine) {
  static mpfr_t x;
  static mpfr_t exact;
  static const bool ready = [] {
    mpfr_init2(x, 53);
    mpfr_init2(exact, 200);
    return true;
  }();
  static_cast<void>(ready);
  mpfr_set_d(x, static_cast<double>(angle), MPFR_RNDN);
  of_sine ? mpfr_sin(exact, x, MPFR_RNDN) : mpfr_cos(exact, x, MPFR_RNDN);
  const auto nearest = static_cast<Scalar>(std::fabs(mpfr_get_d(exact, MPFR_RNDN)));
  const auto unit = static_cast<double>(std::nextafter(nearest, std::numeric_limits<Scalar>::infinity())) -
                    static_cast<double>(nearest);
  mpfr_sub_d(exact, exact, static_cast<double>(computed), MPFR_RNDN);
  return std::fabs(mpfr_get_d(exact, MPFR_RNDN)) / unit;
}

}  // namespace

TEST_CASE_TEMPLATE("sine and cosine side by side are within one unit in the last place", Scalar, double,
                   float) {
  constexpr int kLanes = 16 / sizeof(Scalar);
  veritrack::test::Random random(31);
  double worst = 0.0;
  for (std::int64_t round = veritrack::test::effort(200'000); round > 0; --round) {
    double angle = 0.0;
    switch (round % 5) {
      case 0:
        angle = random.uniform(-3.2, 3.2);
        break;
      case 1:
        angle = random.uniform(-70.0, 70.0);  // beyond 64 the C library's
        break;
      case 2: {  // at multiples of pi/2, where the result is what cancellation leaves
        auto near =
            static_cast<Scalar>((static_cast<double>(random.below(81)) - 40.0) * (0.5 * std::numbers::pi));
        for (std::uint64_t steps = random.below(9); steps > 0; --steps) {
          near = std::nextafter(near, static_cast<Scalar>(round % 2 == 0 ? 100.0 : -100.0));
        }
        angle = static_cast<double>(near);
        break;
      }
      case 3:
        angle = std::ldexp(random.uniform(-1.0, 1.0), -static_cast<int>(random.below(60)));
        break;
      default:  // where the quadrant changes
        angle = (static_cast<double>(random.below(81)) - 40.0) * (0.25 * std::numbers::pi) +
                random.uniform(-1e-3, 1e-3);
    }
    const auto other = static_cast<Scalar>(random.uniform(-3.0, 3.0));
    const auto angle_of = [&](int lane) { return lane == 0 ? other : static_cast<Scalar>(angle); };
    const auto [sine, cosine] = sin_cos(Packed<Scalar, kLanes>::of(angle_of));
    for (int lane = 0; lane < kLanes; ++lane) {
      worst = std::max({worst, error_in_units(angle_of(lane), sine.lane(lane), true),
                        error_in_units(angle_of(lane), cosine.lane(lane), false)});
    }
  }
  CHECK(worst < 0.9);
}

TEST_CASE_TEMPLATE("special angles", Scalar, double, float) {
  using Number = Packed<Scalar, 16 / sizeof(Scalar)>;
  const auto at = [](double x) { return sin_cos(Number(static_cast<Scalar>(x))); };
  CHECK(at(0.0).first.lane(1) == 0.0);
  CHECK(std::signbit(at(-0.0).first.lane(0)));
  CHECK(at(0.0).second.lane(0) == 1.0);
  const auto none = std::numeric_limits<Scalar>::quiet_NaN();
  const auto [sine, cosine] =
      sin_cos(Number::of([&](int lane) { return lane == 0 ? none : static_cast<Scalar>(0.5); }));
  CHECK(std::isnan(sine.lane(0)));
  CHECK(std::isnan(cosine.lane(0)));
  CHECK(sine.lane(1) == at(0.5).first.lane(0));
  CHECK(at(1e6).second.lane(1) == std::cos(static_cast<Scalar>(1e6)));
  const auto beyond =
      sin_cos(Number::of([&](int lane) { return static_cast<Scalar>(lane == 0 ? 1e6 : 0.5); }));
  CHECK(beyond.first.lane(0) == std::sin(static_cast<Scalar>(1e6)));
  CHECK(beyond.first.lane(1) == at(0.5).first.lane(0));
  CHECK(std::isnan(at(std::numeric_limits<double>::infinity()).first.lane(0)));
}

#include "trackers/packed.hpp"

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
double error_in_units(double angle, double computed, bool of_sine) {
  static mpfr_t x;
  static mpfr_t exact;
  static const bool ready = [] {
    mpfr_init2(x, 53);
    mpfr_init2(exact, 200);
    return true;
  }();
  static_cast<void>(ready);
  mpfr_set_d(x, angle, MPFR_RNDN);
  of_sine ? mpfr_sin(exact, x, MPFR_RNDN) : mpfr_cos(exact, x, MPFR_RNDN);
  const double nearest = std::fabs(mpfr_get_d(exact, MPFR_RNDN));
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  mpfr_sub_d(exact, exact, computed, MPFR_RNDN);
  return std::fabs(mpfr_get_d(exact, MPFR_RNDN)) / unit;
}

}  // namespace

TEST_CASE("sine and cosine side by side are within one unit in the last place") {
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
      case 2:  // at multiples of pi/2, where the result is what cancellation leaves
        angle = (static_cast<double>(random.below(81)) - 40.0) * (0.5 * std::numbers::pi);
        for (std::uint64_t steps = random.below(9); steps > 0; --steps) {
          angle = std::nextafter(angle, round % 2 == 0 ? 100.0 : -100.0);
        }
        break;
      case 3:
        angle = std::ldexp(random.uniform(-1.0, 1.0), -static_cast<int>(random.below(60)));
        break;
      default:  // where the quadrant changes
        angle = (static_cast<double>(random.below(81)) - 40.0) * (0.25 * std::numbers::pi) +
                random.uniform(-1e-3, 1e-3);
    }
    const double other = random.uniform(-3.0, 3.0);
    const auto [sine, cosine] = sin_cos(Packed<2>::of([&](int lane) { return lane == 0 ? other : angle; }));
    for (int lane = 0; lane < 2; ++lane) {
      const double x = lane == 0 ? other : angle;
      worst = std::max(
          {worst, error_in_units(x, sine.lane(lane), true), error_in_units(x, cosine.lane(lane), false)});
    }
  }
  CHECK(worst < 0.9);
}

TEST_CASE("special angles") {
  const auto at = [](double x) { return sin_cos(Packed<2>(x)); };
  CHECK(at(0.0).first.lane(1) == 0.0);
  CHECK(std::signbit(at(-0.0).first.lane(0)));
  CHECK(at(0.0).second.lane(0) == 1.0);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto [sine, cosine] = sin_cos(Packed<2>::of([&](int lane) { return lane == 0 ? none : 0.5; }));
  CHECK(std::isnan(sine.lane(0)));
  CHECK(std::isnan(cosine.lane(0)));
  CHECK(sine.lane(1) == at(0.5).first.lane(0));
  CHECK(at(1e6).second.lane(1) == std::cos(1e6));
}

#include "trackers/signals/phasor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

TEST_CASE("unit_phasor is cosine and sine to two units in the last place of one") {
  test::Random random(21);
  const std::int64_t count = test::effort(200000);
  double worst = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const double phase = random.uniform(-4.0, 4.0);
    const auto [cosine, sine] = unit_phasor(phase);
    const long double exact = phase;
    worst =
        std::fmax(worst, static_cast<double>(std::fabs(static_cast<long double>(cosine) - std::cos(exact))));
    worst =
        std::fmax(worst, static_cast<double>(std::fabs(static_cast<long double>(sine) - std::sin(exact))));
  }
  CHECK(worst <= 0x1p-52);
}

TEST_CASE("unit_phasor at and beside the quarter turns") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (int eighths = -5; eighths <= 5; ++eighths) {
    const double corner = eighths * 0.5 * kHalfPi;
    for (const double phase : {std::nextafter(corner, -infinity), corner, std::nextafter(corner, infinity)}) {
      const auto [cosine, sine] = unit_phasor(phase);
      const long double exact = phase;
      CHECK(std::fabs(static_cast<long double>(cosine) - std::cos(exact)) <= 0x1p-52L);
      CHECK(std::fabs(static_cast<long double>(sine) - std::sin(exact)) <= 0x1p-52L);
    }
  }
  CHECK(unit_phasor(0.0) == std::pair<double, double>(1.0, 0.0));
}

TEST_CASE("wrapped keeps the angle and brings it home") {
  test::Random random(22);
  for (int k = 0; k < 20000; ++k) {
    const double phase = random.uniform(-9.4, 9.4);
    const double home = wrapped(phase);
    CHECK(std::fabs(home) <= 3.1415926535897936);
    CHECK(std::fabs(std::sin(0.5L * (static_cast<long double>(home) - static_cast<long double>(phase)))) <=
          2e-15L);
  }
}

}  // namespace
}  // namespace veritrack::trackers

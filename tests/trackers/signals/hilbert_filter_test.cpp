#include "trackers/signals/hilbert_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

/// The ideal response, integrated over its frequencies: (1/pi) times the integral of sin(n w) from 0 to pi,
/// by Simpson's rule: shares nothing with 2/(pi n).
double ideal_response(int n) {
  constexpr int kPlaces = 20000;
  double sum = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double weight = i == 0 || i == kPlaces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::sin(n * std::numbers::pi * i / kPlaces);
  }
  return sum / (3.0 * kPlaces);
}

double blackman(int n, int half_length) {
  const double x = static_cast<double>(n + half_length + 1) / (2.0 * half_length + 2.0);
  return 0.42 - 0.5 * std::cos(2.0 * std::numbers::pi * x) + 0.08 * std::cos(4.0 * std::numbers::pi * x);
}

TEST_CASE("a tone comes out with the gain of the response's closed form, and a quarter of a turn later") {
  test::Random random;
  for (const int half_length : {7, 31, 191}) {
    const double amplitude = random.uniform(0.1, 10.0);
    const double frequency = random.uniform(0.1, 3.0);
    const double phase = random.uniform(-3.0, 3.0);
    double gain = 0.0;
    for (int n = 1; n <= half_length; ++n) {
      gain += 2.0 * ideal_response(n) * blackman(n, half_length) * std::sin(n * frequency);
    }
    HilbertFilter filter(half_length);
    CHECK(filter.gain(frequency) == doctest::Approx(gain).epsilon(1e-9));
    for (int k = 0; k < 5 * half_length; ++k) {
      const bool is_known = filter.push(amplitude * std::cos(frequency * k + phase));
      CHECK(is_known == (k >= 2 * half_length));
      if (is_known) {
        const double at = frequency * (k - filter.delay()) + phase;
        CHECK(filter.in_phase() == doctest::Approx(amplitude * std::cos(at)));
        CHECK(std::fabs(filter.quadrature() - gain * amplitude * std::sin(at)) < 1e-9 * amplitude);
      }
    }
  }
}

TEST_CASE("a constant has no quadrature part") {
  HilbertFilter filter(31);
  for (int k = 0; k < 100; ++k) {
    if (filter.push(3.0)) {
      CHECK(filter.quadrature() == 0.0);
    }
  }
}

TEST_CASE("the chosen length has the gain that was asked for over the band") {
  const int half_length = hilbert_half_length(0.05, 3.0, 1e-3);
  const HilbertFilter filter(half_length);
  for (int i = 0; i <= 1000; ++i) {
    CHECK(std::fabs(filter.gain(0.05 + (3.0 - 0.05) * i / 1000) - 1.0) < 1.1e-3);
  }
  CHECK(half_length % 2 == 1);
  CHECK(hilbert_half_length(0.0, 3.0, 1e-3, 63) == 63);  // no filter turns a constant
  CHECK(hilbert_half_length(1.0, 2.0, 1e-3) < half_length);
}

TEST_CASE("after clear() the filter is as new") {
  HilbertFilter filter(7);
  for (int k = 0; k < 40; ++k) {
    (void)filter.push(k);
  }
  filter.clear();
  for (int k = 0; k < 14; ++k) {
    CHECK_FALSE(filter.push(1.0));
  }
  CHECK(filter.push(1.0));
  CHECK_THROWS_AS(HilbertFilter(8), std::invalid_argument);
  CHECK_THROWS_AS(HilbertFilter(-1), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::trackers

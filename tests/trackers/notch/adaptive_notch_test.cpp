#include "trackers/notch/adaptive_notch.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using Complex = std::complex<double>;

TEST_CASE(
    "with a constant coefficient the real notch has its transfer function, its gradient the derivative") {
  Random random(451);
  for (int run = 0; run < 50; ++run) {
    const double rho = random.uniform(0.3, 0.95);
    const double frequency = random.uniform(0.2, 2.9);
    // The impulse response against the expansion of the quotient of polynomials at a point outside the unit
    // circle.
    const Complex inverse = std::polar(0.9, random.uniform(0.0, 3.0));
    const auto response = [&](double a) {
      return (1.0 + a * inverse + inverse * inverse) /
             (1.0 + rho * a * inverse + rho * rho * inverse * inverse);
    };
    RealNotch<double> notch({rho, 0.0, 2.0}, frequency);
    Complex errors = 0.0;
    Complex gradients = 0.0;
    Complex power = 1.0;
    for (int k = 0; k < 600; ++k, power *= inverse) {
      notch.step(k == 0 ? 1.0 : 0.0);
      errors += notch.error() * power;
      gradients += notch.gradient() * power;
    }
    const double a = -2.0 * std::cos(frequency);
    CHECK(std::abs(errors - response(a)) <= 1e-9);
    CHECK(std::abs(gradients - (response(a + 1e-5) - response(a - 1e-5)) / 2e-5) <= 1e-6);
    CHECK(notch.frequency() == doctest::Approx(frequency));
  }
}

TEST_CASE(
    "the quadrature notch leaves rho^k of a tone at its frequency, and its gradient is the derivative") {
  Random random(452);
  for (int run = 0; run < 50; ++run) {
    const double rho = random.uniform(0.3, 0.95);
    const double frequency = random.uniform(-3.0, 3.0);
    QuadratureNotch<double> notch({rho, 0.0, 2.0}, frequency);
    QuadratureNotch<double> above({rho, 0.0, 2.0}, frequency + 1e-6);
    QuadratureNotch<double> below({rho, 0.0, 2.0}, frequency - 1e-6);
    for (int k = 0; k < 30; ++k) {
      const Complex y = std::polar(1.0, frequency * k + 0.3);
      notch.step(y.real(), y.imag());
      above.step(y.real(), y.imag());
      below.step(y.real(), y.imag());
      CHECK(std::abs(notch.error() - std::pow(rho, k) * std::polar(1.0, frequency * k + 0.3)) <= 1e-12);
      CHECK(std::abs(notch.gradient() - (above.error() - below.error()) / 2e-6) <= 1e-6);
    }
  }
}

TEST_CASE("both find a tone, for several powers") {
  for (const double p : {1.2, 2.0, 3.0}) {
    RealNotch<double> real({0.8, 0.002, p}, 0.8);
    QuadratureNotch<double> quadrature({0.8, 0.002, p}, 0.8);
    for (int k = 0; k < 20000; ++k) {
      real.step(std::cos(1.0 * k));
      quadrature.step(std::cos(1.0 * k), std::sin(1.0 * k));
    }
    CHECK(std::fabs(real.frequency() - 1.0) <= 0.01);
    CHECK(std::fabs(quadrature.frequency() - 1.0) <= 0.01);
  }
}

TEST_CASE("a correction beyond |a| = 2 is left out, and silence changes nothing") {
  RealNotch<double> notch({0.9, 10.0, 2.0}, 0.5);
  Random random(453);
  for (int k = 0; k < 1000; ++k) {
    notch.step(random.uniform(-5.0, 5.0));
    CHECK(std::fabs(notch.coefficient()) < 2.0);
  }
  QuadratureNotch<double> quiet({0.9, 0.1, 1.0}, 0.5);
  quiet.step(0.0, 0.0);
  CHECK(quiet.frequency() == 0.5);
}

}  // namespace
}  // namespace veritrack::trackers

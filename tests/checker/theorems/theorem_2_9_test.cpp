// How far a start may be from the signal, against complex numbers.
#include "checker/theorems/theorem_2_9.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

using namespace veritrack::checker;

TEST_CASE("the largest initial error is that of the largest amplitude, phase and frequency errors") {
  for (const double amplitude : {0.0, 0.2, 1.5}) {
    for (const double phase : {0.0, 0.5, 3.0}) {
      Design design;
      design.amplitude_error = Ball(amplitude);
      design.phase_error = Ball(phase);
      design.frequency_error = Ball(0.25);
      const double exact = std::hypot(std::abs(std::polar(1.0 + amplitude, phase) - 1.0), 0.25);
      CHECK(std::fabs(largest_initial_error(design).near() - exact) <= 1e-12);
    }
  }
}

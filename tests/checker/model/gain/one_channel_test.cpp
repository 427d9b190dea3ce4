// Loops of one channel: ripples by averaging, against the loop itself in doubles.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "tests/checker/model/gain/gain_loops.hpp"
#include "tests/checker/model/gain/type_2_simulation.hpp"

namespace veritrack::checker {
namespace {

using test::Type2Simulation;

const std::vector<Ball> kInSteadyState(2);

TEST_CASE("numbers") {
  for (const char* wn : {"0.02", "0.001"}) {
    const GainNetwork network = test::type_2_loop(wn).network();
    MESSAGE("inputs " << network.inputs.size() << " forms " << network.forms.size() << " ripples "
                      << network.ripples.size());
    for (const GainRipple& r : network.ripples) {
      MESSAGE("turns " << r.turns << " theta " << r.of_state[0].near() << " w " << r.of_state[1].near());
    }
    const double step = std::stod(wn);
    const std::size_t horizon = step > 0.01 ? 2048 : 32768;
    const GainBounds bounds(network, horizon, 64);
    REQUIRE(bounds.is_certain());
    for (const double noise : {0.0, 0.001, 0.01, 0.05, 0.1, 0.2, 0.3}) {
      const auto errors = bounds.errors(Ball(noise), zero, kInSteadyState);
      if (!errors) {
        MESSAGE(noise << " none");
        continue;
      }
      double attack = 0.0;
      for (const double omega : {0.2, 0.3, 0.5}) {
        attack = std::max(attack, test::attacked_error(Type2Simulation(step, omega, 0.0), noise, horizon / 2));
      }
      MESSAGE(noise << " for ever " << errors->for_ever().near() << " long run " << errors->in_long_run().near()
                    << " mean " << errors->mean_in_long_run().near() << " attack " << attack);
    }
    MESSAGE("tolerated " << test::tolerated_noise(bounds, 2));
  }
}

}  // namespace
}  // namespace veritrack::checker

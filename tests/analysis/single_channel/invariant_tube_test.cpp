#include "analysis/single_channel/invariant_tube.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/single_channel/curve_proposal.hpp"
#include "analysis/single_channel/tube_verification.hpp"
#include "tests/support/random.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;

TEST_CASE("the cells that a cell is moved to are all those that it meets, whatever the frequency") {
  test::Random random(71);
  const trackers::ToneModel<double> design{0.005, 0.005, 0.01, 0.01};
  for (const double omega : {0.4, 1.45, 2.9}) {
    CAPTURE(omega);
    const rigor::UpwardRounding upward;
    const Interval frequency = Interval::from_bounds(omega, omega + 0.01);
    const auto curve = propose_invariant_curves(design, frequency);
    REQUIRE(curve.has_value());
    const auto tube =
        propose_tube({Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)},
                     frequency, *curve, 64);
    REQUIRE(tube.has_value());
    CHECK(tube->cells.size() == 64);
    for (const TubeCell& cell : tube->cells) {
      CHECK(!cell.targets.empty());
      CHECK(cell.targets.size() <= 4);
      for (int k = 0; k < 50; ++k) {
        const double phase = random.uniform(cell.phase.lower(), cell.phase.upper());
        const double moved =
            std::fmod(phase + random.uniform(omega, omega + 0.01) + std::numbers::pi, std::numbers::pi);
        const bool met = std::any_of(cell.targets.begin(), cell.targets.end(), [&](std::size_t target) {
          const Interval& there = tube->cells[target].phase;
          return there.lower() - 1e-12 <= moved && moved <= there.upper() + 1e-12;
        });
        CHECK(met);
      }
    }
  }
}

}  // namespace
}  // namespace veritrack::single_channel

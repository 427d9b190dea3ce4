#include "analysis/single_channel/invariant_tube.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

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
    for (const CurveCell& cell : tube->cells) {
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

TEST_CASE("a curve farther from the steady state than the contraction reaches is none") {
  const trackers::ToneModel<double> design{0.005, 0.005, 0.01, 0.01};
  const rigor::UpwardRounding upward;
  const Interval frequency(1.45);
  const auto curve = propose_invariant_curves(design, frequency);
  REQUIRE(curve.has_value());
  const auto tube =
      propose_tube({Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)},
                   frequency, *curve, 128);
  REQUIRE(tube.has_value());
  CHECK(verify_tube(*tube).attempt == TubeAttempt::succeeded);
  // The map contracts about the moved curve, but not as far as to where it leads.
  int not_kept = 0;
  for (double moved = 1.0e-5; moved < 1.8e-5; moved *= 1.02) {
    InvariantTube away = *tube;
    away.curve.terms.front().mean(trackers::kDeltaInPhase) += moved;
    const std::string reason = verify_tube(away).reason;
    not_kept += reason == "the tube about the proposed curve is not mapped into itself" ? 1 : 0;
  }
  CHECK(not_kept > 0);
}

}  // namespace
}  // namespace veritrack::single_channel

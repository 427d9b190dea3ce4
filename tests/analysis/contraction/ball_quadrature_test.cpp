#include "analysis/contraction/ball_quadrature.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "tests/analysis/contraction/polar_simulation.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using namespace veritrack::contraction;
using rigor::Interval;
using rigor::UpwardRounding;
using rigor::Verdict;
using test::Polar;
using test::Simulation;
using test::steady_state;

namespace {

trackers::QuadratureEkfDesign<Interval> design_of(const char* q, const char* r, const char* epsilon) {
  return {rigor::parse_decimal(q), rigor::parse_decimal(q), rigor::parse_decimal(r),
          rigor::parse_decimal(epsilon)};
}

Polar random_direction(test::Random& random) {
  Polar direction;
  for (Eigen::Index i = 0; i < 9; ++i) {
    direction[i] = random.uniform(-1.0, 1.0);
  }
  return direction.normalized();
}

/// Starts on the rim, drives with noise and slew up to the limits, and holds every step against the claims.
void try_to_break(const QuadratureBall& ball, const trackers::QuadratureEkfDesign<Interval>& design,
                  test::Random& random, int runs) {
  const rigor::NearestRounding nearest;
  for (const BallChain& part : ball.parts) {
    for (int run = 0; run < runs; ++run) {
      const auto& certificate = part.balls[static_cast<std::size_t>(run) % part.balls.size()];
      const auto& proposal = certificate.proposal;
      const double low = part.cells.front().parameter.lower();
      const double high = part.cells.back().parameter.upper();
      Simulation simulation(design, Polar::Zero(), random.uniform(low, high));
      const Polar rim = proposal.metric.inverse() * random_direction(random) * proposal.radius;
      const Polar start = steady_state(simulation, part.cells, design) + rim;
      simulation = Simulation(design, start, simulation.frequency);
      double level = proposal.radius;
      double direction = 1.0;
      for (int k = 0; k < 60; ++k) {
        if (k % 7 == 0) {
          direction = -direction;
        }
        double slew = run % 2 == 0 ? direction * proposal.slew : random.uniform(-1.0, 1.0) * proposal.slew;
        if (simulation.frequency + slew < low || simulation.frequency + slew > high) {
          slew = 0.0;
        }
        const double angle = run % 3 == 0
                                 ? simulation.phase + simulation.frequency + (k % 2 == 0 ? 1.57 : -1.57)
                                 : random.uniform(0.0, 6.28);
        const double size = run % 5 == 4 ? 0.0 : proposal.noise;
        simulation.step(size * Eigen::Vector2d(std::cos(angle), std::sin(angle)), slew);
        const Polar error = simulation.state() - steady_state(simulation, part.cells, design);
        const double next = (proposal.metric * error).norm();
        const double bound = certificate.rate * level + certificate.noise_gain * size +
                             certificate.slew_gain * std::fabs(slew);
        CHECK(next <= bound * (1.0 + 1e-7) + 1e-9);
        CHECK(next <= proposal.radius * (1.0 + 1e-7));
        level = next;
      }
    }
  }
}

}  // namespace

TEST_CASE("without a leak: the sizes, and simulations do not break them") {
  struct Row {
    const char* q;
    const char* r;
    double radius;
  };
  test::Random random(930);
  for (const Row& row : {Row{"0.0005", "0.01", 0.032}, Row{"0.0013", "0.01", 0.045},
                         Row{"0.0065", "0.01", 0.085}, Row{"0.0023", "0.05", 0.030}}) {
    const UpwardRounding upward;
    const auto design = design_of(row.q, row.r, "0");
    const auto branch = verify_lock_branch(design, Interval::from_bounds(0.05, 3.0));
    REQUIRE(branch.verdict == Verdict::proved);
    CHECK(branch.cells.size() == 1);
    const auto ball = certify_quadrature_ball({design, branch.band, 0.0005, 0.0}, branch);
    REQUIRE(ball.verdict == Verdict::proved);
    REQUIRE(ball.parts.size() == 1);
    const auto& certificate = ball.parts[0].balls[0];
    CHECK(state_bounds<9>(certificate, Interval(certificate.proposal.radius))[2].upper() >= row.radius);
    try_to_break(ball, design, random, static_cast<int>(test::effort(10)));
    const auto noisy = certify_largest_noise({design, branch.band, 0.0, 0.0}, branch);
    REQUIRE(noisy.verdict == Verdict::proved);
    CHECK(noisy.parts[0].balls[0].proposal.noise >= 0.005);
    try_to_break(noisy, design, random, static_cast<int>(test::effort(10)));
  }
}

TEST_CASE("with a leak: noise and slew over a band, and simulations do not break them") {
  test::Random random(931);
  const UpwardRounding upward;
  const auto design = design_of("0.0013", "0.01", "0.01");
  const BallQuestion question{design, Interval::from_bounds(0.8, 1.4), 0.001, 0.0005};
  const auto branch = verify_lock_branch(design, question.band);
  REQUIRE(branch.verdict == Verdict::proved);
  const auto ball = certify_quadrature_ball(question, branch);
  REQUIRE(ball.verdict == Verdict::proved);
  REQUIRE(ball.parts.size() == 1);
  CHECK(ball.parts[0].balls.size() > 1);
  CHECK(ball.parts[0].balls[0].slew_gain > 0.0);
  try_to_break(ball, design, random, static_cast<int>(test::effort(20)));
  // The ultimate level: after a long time the state is below it.
  const auto& last = ball.parts[0].balls.back();
  CHECK(last.ultimate_level < 0.5 * ball.parts[0].balls[0].proposal.radius);

  const auto slewing = certify_largest_slew(question, branch);
  REQUIRE(slewing.verdict == Verdict::proved);
  CHECK(slewing.parts[0].balls[0].proposal.slew > 0.001);
  try_to_break(slewing, design, random, static_cast<int>(test::effort(10)));
}

TEST_CASE("too large a radius is not verified") {
  test::Random random(932);
  const UpwardRounding upward;
  const auto design = design_of("0.0013", "0.01", "0.05");
  const auto branch = verify_lock_branch(design, Interval(1.0));
  REQUIRE(branch.verdict == Verdict::proved);
  const auto ball = certify_quadrature_ball({design, branch.band, 0.0, 0.0}, branch);
  REQUIRE(ball.verdict == Verdict::proved);
  const BallChain& part = ball.parts[0];
  auto proposal = part.balls[0].proposal;
  const QuadraturePolarLoop loop{design};
  bool seen_unproved = false;
  bool seen_expansion = false;
  for (int i = 0; i < 14; ++i) {
    proposal.radius *= 1.3;
    const auto larger = verify_ball(loop, part.cells, proposal);
    const rigor::NearestRounding nearest;
    double worst = 0.0;
    for (int sample = 0; sample < 2000; ++sample) {
      const Polar start = part.cells[0].center +
                          Polar(proposal.metric.inverse() * random_direction(random) * proposal.radius);
      const Polar next = loop(start, 1.0, Column<double, 3>(0.0, 0.0, 0.0));
      const double stretch = (proposal.metric * (next - part.cells[0].center)).norm() / proposal.radius;
      worst = std::isnan(stretch) ? 2.0 : std::max(worst, stretch);
    }
    seen_unproved = seen_unproved || larger.verdict != Verdict::proved;
    if (worst > 1.0) {
      seen_expansion = true;
      CHECK(larger.verdict == Verdict::undecided);
    }
  }
  CHECK(seen_unproved);
  CHECK(seen_expansion);
}

TEST_CASE("the derivation: named quantities, and honest failures") {
  const UpwardRounding upward;
  const auto proved = derive_quadrature_ball(
      {design_of("0.0065", "0.01", "0.01"), Interval::from_bounds(0.9, 1.1), 0.001, 0.0001});
  CHECK(proved.id == "contraction");
  CHECK(proved.verdict == Verdict::proved);
  for (const char* name : {"contraction_rate", "radius", "frequency_error_radius", "phase_error_radius",
                           "amplitude_error_radius", "ultimate_frequency_error", "largest_noise",
                           "largest_slew", "settling_samples", "bias_frequency"}) {
    const auto& quantity = theorems::find_quantity(proved, name);
    CHECK_FALSE(quantity.not_applicable.has_value());
    CHECK(is_finite(quantity.value));
  }
  CHECK(theorems::find_quantity(proved, "ultimate_frequency_error").value.upper() >=
        magnitude(theorems::find_quantity(proved, "bias_frequency").value));
  CHECK(theorems::find_quantity(proved, "settling_samples").value.upper() > 0.0);
  CHECK(theorems::find_quantity(proved, "largest_noise").value.lower() >= 0.001);
  CHECK(theorems::find_quantity(proved, "largest_slew").value.lower() >= 0.0001);

  // Too much noise; a band beyond the end of the branch; no exponentially stable steady state; no numbers.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto small = Interval(1.0);
  for (const BallQuestion& question :
       {BallQuestion{design_of("0.0065", "0.01", "0.01"), small, 1.0, 0.0},
        BallQuestion{design_of("0.0065", "0.01", "0.01"), small, nan, 0.0},
        BallQuestion{design_of("0.0065", "0.01", "0.01"), small, 0.0, nan},
        BallQuestion{design_of("0.0065", "0.01", "0.01"), Interval::empty(), 0.0, 0.0},
        BallQuestion{design_of("0.0005", "0.01", "0.05"), Interval(2.6), 0.0, 0.0},
        BallQuestion{design_of("0", "0.01", "0"), small, 0.0, 0.0}}) {
    const auto failed = certify_quadrature_ball(question, verify_lock_branch(question.design, question.band));
    CHECK(failed.verdict == Verdict::undecided);
    CHECK(failed.parts.empty());
    CHECK_FALSE(failed.reason.empty());
  }
  const auto beyond = derive_quadrature_ball({design_of("0.0005", "0.01", "0.05"), Interval(2.6), 0.0, 0.0});
  CHECK(beyond.verdict == Verdict::undecided);
  for (const auto& quantity : beyond.quantities) {
    CHECK(is_empty(quantity.value));
    REQUIRE(quantity.not_applicable.has_value());
    CHECK(quantity.not_applicable->find("2.38") != std::string::npos);
  }
}

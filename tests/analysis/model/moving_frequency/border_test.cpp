#include "analysis/model/moving_frequency/border.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/model/tube/frequency_cells.hpp"
#include "analysis/model/tube/tube_verification.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Verdict;
using test::Example;

/// Tubes of one shape's parameters, side by side, for a frequency that moves.
std::vector<Tube> tubes_of(const Example& example, double low, double high, double widest) {
  BandSettings settings;
  settings.one_shape = true;
  settings.widest = widest;
  settings.tube.shape.objective = ShapeObjective::largest_slew;
  const BandProposal band = propose_band(test::tone_of(example.tracker), low, high, settings);
  REQUIRE(band.is_complete);
  std::vector<Tube> tubes;
  tubes.reserve(band.cells.size());
  for (const TubeProposal& cell : band.cells) {
    tubes.push_back(*cell.tube);
  }
  REQUIRE(tubes.size() >= 2);
  return tubes;
}

/// What is proved of a band: |F_w| <= (1 - eta) R in all cells, and at all borders from (1 - eta) R to R.
struct MovingSet {
  double radius = 0.0;
  double eta = 0.0;
  double slew = 0.0;
  double noise = 0.0;
};

bool is_never_left(const Example& example, const std::vector<Tube>& tubes, const MovingSet& set,
                   const VerificationBudget& budget) {
  const double reached = (1.0 - set.eta) * set.radius;
  bool is_proved = true;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const LevelQuestion question{set.radius, set.noise, 1.0, reached / set.radius, set.slew};
    is_proved =
        is_proved && verify_level(example.model, tubes[i], question, budget).verdict == Verdict::proved;
    if (i + 1 < tubes.size()) {
      const BorderQuestion border{reached * (1.0 + 1e-12), set.radius, set.slew};
      is_proved =
          is_proved &&
          verify_border(example.model, tubes[i], tubes[i + 1], border, {}).verdict == Verdict::proved &&
          verify_border(example.model, tubes[i + 1], tubes[i], border, {}).verdict == Verdict::proved;
    }
  }
  return is_proved;
}

/// The largest level/R along trajectories in floating point whose noise and slew are at their limits at every
/// sample. The frequency goes from end to end of the band or changes its direction as the greedy choice says.
double largest_level(const Example& example, const std::vector<Tube>& tubes, const MovingSet& set,
                     int samples) {
  test::Random random(2026);
  std::vector<test::PointTube> cells;
  cells.reserve(tubes.size());
  for (const Tube& tube : tubes) {
    cells.emplace_back(tube);
  }
  const double low = cells.front().low();
  const double high = cells.back().high();
  const auto cell_at = [&](double frequency) -> const test::PointTube& {
    return *std::find_if(cells.begin(), cells.end() - 1,
                         [&](const test::PointTube& cell) { return frequency <= cell.high(); });
  };
  double worst = 0.0;
  for (int run = 0; run < 6; ++run) {
    const bool is_greedy = run % 2 == 0;
    double frequency = random.uniform(low, high);
    double phase = random.uniform(0.0, 2.0 * M_PI);
    double direction = 1.0;
    Eigen::VectorXd xi(static_cast<Eigen::Index>(tubes.front().curve.size()));
    for (double& component : xi) {
      component = random.uniform(-1.0, 1.0);
    }
    const test::PointTube& first = cell_at(frequency);
    Eigen::VectorXd state =
        first.curve(phase, frequency) + set.radius * first.shape(phase, frequency) * xi.normalized();
    for (int k = 0; k < samples; ++k) {
      phase += frequency;
      Eigen::VectorXd farthest;
      double level = -1.0;
      double at = frequency;
      for (const double way : {-1.0, 1.0}) {
        const double next_frequency = frequency + way * set.slew;
        if (next_frequency < low || next_frequency > high || (!is_greedy && way != direction)) {
          continue;
        }
        for (const double sign : {-1.0, 1.0}) {
          const Eigen::VectorXd next =
              test::next_state(example.tracker, state, std::cos(phase) + sign * set.noise);
          const double here = cell_at(next_frequency).level(next, phase, next_frequency);
          if (here > level) {
            level = here;
            farthest = next;
            at = next_frequency;
          }
        }
      }
      if (level < 0.0) {
        direction = -direction;  // at the end of the band: one sample without slew
        farthest = test::next_state(example.tracker, state, std::cos(phase));
        level = cell_at(frequency).level(farthest, phase, frequency);
      }
      worst = std::max(worst, level / set.radius);
      state = farthest;
      frequency = at;
    }
  }
  return worst;
}

TEST_CASE("a phase-locked loop on a frequency that moves over a band: no trajectory leaves what is proved") {
  const Example loop(test::phase_locked_loop());
  const std::vector<Tube> tubes = tubes_of(loop, 0.2, 0.5, 0.1);
  const VerificationBudget budget{128, 2, 20000};
  const MovingSet set{0.0075, 5e-5, 5.1e-5, 0.0};
  CHECK(is_never_left(loop, tubes, set, budget));
  const double worst = largest_level(loop, tubes, set, 20000);
  CHECK(worst < 1.0);
  CHECK(worst > 0.3);
  const MovingSet noisy{0.0075, 5e-5, 4.5e-5, 0.004};
  CHECK(is_never_left(loop, tubes, noisy, budget));
  CHECK(largest_level(loop, tubes, noisy, 20000) < 1.0);
  CHECK_FALSE(is_never_left(loop, tubes, {0.0075, 5e-5, 7e-5, 0.0}, budget));
  // Nothing crosses when nothing is left over for the borders.
  CHECK_FALSE(is_never_left(loop, tubes, {0.0075, 0.0, 4e-5, 0.0}, budget));
}

TEST_CASE("a SOGI-FLL and KalmANF on a frequency that moves across a border" *
          doctest::test_suite("nightly")) {
  const double hertz = 2.0 * M_PI / 10000.0;
  const Example sogi(test::integrator_loop());
  const std::vector<Tube> tubes = tubes_of(sogi, 49.0 * hertz, 51.0 * hertz, hertz);
  const MovingSet set{0.0012, 5e-5, 2.4e-6, 0.0};
  CHECK(is_never_left(sogi, tubes, set, {128, 2, 20000}));
  CHECK(largest_level(sogi, tubes, set, 5000) < 1.0);
  const Example notch(test::notch_filter());
  const std::vector<Tube> narrow = tubes_of(notch, 0.49, 0.51, 0.01);
  const MovingSet other{0.0019, 5e-5, 1.1e-5, 0.0};
  CHECK(is_never_left(notch, narrow, other, {128, 2, 20000}));
  CHECK(largest_level(notch, narrow, other, 5000) < 1.0);
}

TEST_CASE("the bound at a border contains what is there") {
  const Example loop(test::phase_locked_loop());
  const std::vector<Tube> tubes = tubes_of(loop, 0.2, 0.5, 0.1);
  const double radius = 0.006;
  const BorderResult proved =
      verify_border(loop.model, tubes[0], tubes[1], {radius, 1.0001 * radius, 5e-5}, {});
  REQUIRE(proved.verdict == Verdict::proved);
  CHECK(proved.largest <= 1.0);
  CHECK(proved.cells >= 32);
  const test::PointTube from(tubes[0]);
  const test::PointTube to(tubes[1]);
  test::Random random(5);
  double worst = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double phase = random.uniform(0.0, 2.0 * M_PI);
    const double frequency = from.high() + random.uniform(-5e-5, 5e-5);
    Eigen::Vector2d xi(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const Eigen::VectorXd state =
        from.curve(phase, frequency) + radius * from.shape(phase, frequency) * xi.normalized();
    worst = std::max(worst, to.level(state, phase, frequency) / (1.0001 * radius));
  }
  CHECK(worst <= proved.largest);
  CHECK(worst > proved.largest - 2e-5);
}

TEST_CASE("borders where the tubes do not fit are not proved") {
  const Example loop(test::phase_locked_loop());
  const std::vector<Tube> tubes = tubes_of(loop, 0.2, 0.5, 0.1);
  const double radius = 0.006;
  const BorderQuestion question{(1.0 - 1e-4) * radius, radius, 5e-5};
  const auto verdict = [&](const Tube& from, const Tube& to, const BorderQuestion& asked,
                           const VerificationBudget& budget) {
    return verify_border(loop.model, from, to, asked, budget).verdict;
  };
  REQUIRE(verdict(tubes[0], tubes[1], question, {}) == Verdict::proved);
  REQUIRE(verdict(tubes[1], tubes[0], question, {}) == Verdict::proved);
  Tube wrong = tubes[1];
  wrong.curve[0].coefficients[0][0] += 1e-5;
  CHECK(verdict(tubes[0], wrong, question, {}) == Verdict::undecided);
  CHECK(verdict(wrong, tubes[0], question, {}) == Verdict::undecided);
  wrong = tubes[1];
  wrong.curve[1].coefficients[0][0] += 2.0 * M_PI;  // the same curve, but not the same numbers
  CHECK(verdict(tubes[0], wrong, question, {}) == Verdict::undecided);
  wrong = tubes[1];
  for (auto& harmonic : wrong.shape[0].coefficients) {
    for (auto& coefficient : harmonic) {
      coefficient *= 0.999;
    }
  }
  CHECK(verdict(tubes[0], wrong, question, {}) == Verdict::undecided);
  wrong = tubes[1];
  for (auto& harmonic : wrong.shape[2].coefficients) {
    for (auto& coefficient : harmonic) {
      coefficient = 0.0;
    }
  }
  CHECK(verdict(tubes[0], wrong, question, {}) == Verdict::undecided);
  wrong = tubes[1];
  wrong.shape[1].coefficients[0][0] = std::nan("");
  CHECK(verdict(tubes[0], wrong, question, {}) == Verdict::undecided);
  CHECK(verdict(wrong, tubes[0], question, {}) == Verdict::undecided);
  wrong = tubes[1];
  wrong.turns[1] = 2;
  CHECK(verify_border(loop.model, tubes[0], wrong, question, {}).reason ==
        "neighbouring curves do not turn alike");
  wrong = tubes[1];
  wrong.frequency += 1e-3;  // a gap: the tubes would have to fit all over it
  CHECK(verdict(tubes[0], wrong, question, {}) == Verdict::undecided);
  wrong = tubes[1];
  wrong.curve.pop_back();
  CHECK_THROWS_AS((void)verdict(tubes[0], wrong, question, {}), std::invalid_argument);
  // One cell within the other, or the same.
  wrong = tubes[1];
  wrong.frequency = tubes[0].frequency;
  CHECK(verify_border(loop.model, tubes[0], wrong, question, {}).reason ==
        "the slew is more than a cell of frequencies");
  wrong.frequency += 1e-3;
  wrong.half_width = 0.5e-3;
  CHECK(verify_border(loop.model, tubes[0], wrong, question, {}).reason ==
        "the slew is more than a cell of frequencies");
  // Not neighbours.
  CHECK(verdict(tubes[0], tubes.back(), question, {}) == Verdict::undecided);
  // A larger level into a smaller one.
  CHECK(verdict(tubes[0], tubes[1], {radius, radius, 5e-5}, {}) == Verdict::undecided);
  CHECK(verdict(tubes[0], tubes[1], {radius, 0.99 * radius, 5e-5}, {}) == Verdict::undecided);
}

TEST_CASE("questions about borders that cannot be answered are not proved") {
  const Example loop(test::phase_locked_loop());
  const std::vector<Tube> tubes = tubes_of(loop, 0.2, 0.5, 0.1);
  const auto verdict = [&](const BorderQuestion& question, const VerificationBudget& budget) {
    return verify_border(loop.model, tubes[0], tubes[1], question, budget).verdict;
  };
  const double radius = 0.006;
  REQUIRE(verdict({0.9 * radius, radius, 5e-5}, {}) == Verdict::proved);
  CHECK(verdict({0.0, radius, 5e-5}, {}) == Verdict::undecided);
  CHECK(verdict({std::nan(""), radius, 5e-5}, {}) == Verdict::undecided);
  CHECK(verdict({0.9 * radius, HUGE_VAL, 5e-5}, {}) == Verdict::undecided);
  CHECK(verdict({0.9 * radius, radius, 0.0}, {}) == Verdict::undecided);
  CHECK(verdict({0.9 * radius, radius, std::nan("")}, {}) == Verdict::undecided);
  CHECK(verdict({0.9 * radius, radius, 0.2}, {}) == Verdict::undecided);
  CHECK(verdict({0.9 * radius, radius, 5e-5, 0.0}, {}) == Verdict::undecided);
  CHECK(verdict({0.9 * radius, radius, 5e-5}, {3, 1, 1000}) == Verdict::undecided);
  // Small levels need more: what the curves differ by does not shrink with the level.
  CHECK(verdict({0.9 * radius, radius, 5e-5, 0.5}, {}) == Verdict::proved);
  CHECK(verdict({0.9 * radius, radius, 5e-5, 1e-7}, {}) == Verdict::undecided);
}

}  // namespace
}  // namespace veritrack::model

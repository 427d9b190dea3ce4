#include "analysis/model/steady_state/neutral_turn.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

using test::ExampleTracker;
using trackers::Operation;
using trackers::StraightLineProgram;

/// Riviere's weighted-frequency Fourier linear combiner of one harmonic: e = y - a cos(ph') - b sin(ph') with
/// ph' = ph + w; w' = w + gamma e (b cos - a sin); a' = a + mu e cos; b' = b + mu e sin. States w, b, ph, a.
/// `decay`: a' = decay a + ..., which tells a from b.
ExampleTracker linear_combiner(double decay = 1.0) {
  ExampleTracker example;
  trackers::Recursion& r = example.recursion;
  r.constants = 3;
  r.states = 4;
  r.samples = 1;
  r.is_angle = {false, false, true, false};
  StraightLineProgram step(8);
  const int mu = 0, gamma = 1, kept = 2, w = 3, b = 4, ph = 5, a = 6, y = 7;
  const auto times = [&](int x, int z) { return step.append(Operation::multiply, x, z); };
  const auto plus = [&](int x, int z) { return step.append(Operation::add, x, z); };
  const auto less = [&](int x, int z) { return step.append(Operation::subtract, x, z); };
  const int next_ph = plus(ph, w);
  const int c = step.append(Operation::cos, next_ph);
  const int s = step.append(Operation::sin, next_ph);
  const int e = less(less(y, times(a, c)), times(b, s));
  step.add_result(plus(w, times(gamma, times(e, less(times(b, c), times(a, s))))));
  step.add_result(plus(b, times(mu, times(e, s))));
  step.add_result(next_ph);
  step.add_result(plus(times(kept, a), times(mu, times(e, c))));
  r.step = step;
  r.frequency = test::frequency_of_state(3, 4, 0);
  example.constants = {0.1, 0.01, decay};
  example.start = [](double omega) { return std::vector<double>{omega, 0.0, omega, 1.0}; };
  return example;
}

std::optional<NeutralTurn> found_in(const ExampleTracker& example) {
  const StepMap step(example.recursion, example.constants);
  const std::vector<double> start = example.start(0.3);
  return find_neutral_turn(step, Eigen::Map<const Eigen::VectorXd>(start.data(), step.states()),
                           Eigen::VectorXd::Ones(step.states()));
}

TEST_CASE("the phase of a linear combiner and its weights turn together") {
  const auto turn = found_in(linear_combiner());
  REQUIRE(turn);
  CHECK(turn->angle == 2);
  CHECK(turn->cosine == 3);
  CHECK(turn->sine == 1);
  CHECK(words_of(*turn, {"w", "b", "ph", "a"}).find("ph, a and b may turn together") == 0);
}

TEST_CASE("a tracker that tells the weights apart has no neutral turn, nor has a phase-locked loop") {
  CHECK_FALSE(found_in(linear_combiner(0.999)));
  CHECK_FALSE(found_in(test::phase_locked_loop()));
  CHECK_FALSE(found_in(test::integrator_loop()));
}

}  // namespace
}  // namespace veritrack::model

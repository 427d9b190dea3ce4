#include "analysis/model/step/undefined_operation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <vector>

#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using trackers::Operation;
using trackers::StraightLineProgram;

/// x' = x/2 + y/(x - 2), with the frequency x; y also stands under a line that nobody reads, 1/y.
test::ExampleTracker divider() {
  test::ExampleTracker example;
  example.recursion.constants = 2;  // 2, 1/2
  example.recursion.states = 1;
  example.recursion.samples = 1;
  example.recursion.is_angle = {false};
  StraightLineProgram step(4);
  (void)step.append(Operation::divide, 1, 3);
  const int denominator = step.append(Operation::subtract, 2, 0);
  const int half = step.append(Operation::multiply, 1, 2);
  const int quotient = step.append(Operation::divide, 3, denominator);
  step.add_result(step.append(Operation::add, half, quotient));
  example.recursion.step = step;
  example.recursion.frequency = StraightLineProgram(3);
  example.recursion.frequency.add_result(2);
  example.constants = {2.0, 0.5};
  return example;
}

constexpr int kQuotient = 3;  // the instruction

/// |x| <= R.
Tube around_zero() {
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.01;
  tube.turns = {0};
  tube.curve = {PhaseSeries{}};
  tube.shape = {PhaseSeries{{{1.0}}}};
  return tube;
}

TEST_CASE("a denominator that can vanish in a tube is found, with the radius up to which it cannot") {
  const test::Example example(divider());
  const Tube tube = around_zero();
  for (const double noise : {0.0, 0.1}) {
    CHECK_FALSE(find_undefined(example.model, tube, 1.5, noise));
    const auto found = find_undefined(example.model, tube, 5.0, noise);
    REQUIRE(found);
    CHECK(found->instruction == kQuotient);
    // x - 2 vanishes at x = 2.
    CHECK(found->defined_radius < 2.0);
    CHECK(found->defined_radius > 1.5);
  }
}

TEST_CASE("what is no tube of that kind is not looked at") {
  const test::Example example(divider());
  const Tube tube = around_zero();
  CHECK_FALSE(find_undefined(example.model, tube, std::nan(""), 0.0));
  CHECK_FALSE(find_undefined(example.model, tube, INFINITY, 0.0));
  CHECK_FALSE(find_undefined(example.model, tube, 0.0, 0.0));
  CHECK_FALSE(find_undefined(example.model, tube, 5.0, INFINITY));
}

TEST_CASE("the first operation that is not known counts, and only if a result rests on it") {
  const StraightLineProgram step = divider().recursion.step;
  const auto is_finite = [](double value) { return std::isfinite(value); };
  std::vector<double> registers;
  std::vector<double> next(1);
  const auto found = [&](double x, double y) {
    const std::vector<double> inputs{2.0, 0.5, x, y};
    step.run(std::span<const double>(inputs), registers, std::span(next));
    return first_unknown(step, registers, is_finite);
  };
  CHECK(found(0.1, 1.0) == -1);
  CHECK(found(0.1, 0.0) == -1);  // 1/y is nobody's
  CHECK(found(2.0, 1.0) == kQuotient);
}

}  // namespace
}  // namespace veritrack::model

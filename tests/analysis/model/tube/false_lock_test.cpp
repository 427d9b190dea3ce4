// The distance to a false lock, by the program of the step. The checker's own is compared with it in
// tests/checker/model/false_lock_test.cpp.
#include "analysis/model/tube/false_lock.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using trackers::StraightLineProgram;

constexpr double kPi = std::numbers::pi;

double half_distance(const test::Example& example, double low = 0.25, double high = 0.5) {
  const rigor::UpwardRounding upward;
  return half_distance_to_false_lock(example.model, Interval::from_bounds(low, high));
}

/// The phase-locked loop whose detector is -y f(theta).
template <typename Detector>
test::ExampleTracker loop_with(const Detector& detector) {
  test::ExampleTracker tracker = test::phase_locked_loop();
  StraightLineProgram step(5);
  const int w = 2, theta = 3, y = 4;
  const int e = step.append(trackers::Operation::multiply, y, detector(step, theta));
  const auto plus = [&](int a, int constant) {
    return step.append(trackers::Operation::add, a, step.append(trackers::Operation::multiply, constant, e));
  };
  step.add_result(plus(w, 0));
  step.add_result(plus(step.append(trackers::Operation::add, theta, w), 1));
  tracker.recursion.step = step;
  return tracker;
}

TEST_CASE("one channel does not tell a frequency from its image, two do") {
  CHECK(half_distance(test::Example(test::phase_locked_loop())) == 0.25);
  CHECK(half_distance(test::Example(test::phase_locked_loop()), 2.0, 3.0) ==
        doctest::Approx(kPi - 3.0).epsilon(1e-12));
  test::Example two(test::angle_loop());
  two.signal = test::tone(2, true);
  const double found = half_distance(two);
  CHECK(found == doctest::Approx(kPi / 5.0).epsilon(1e-12));  // the quotient in atan2, its sum and its roots
  CHECK(found < std::numbers::pi_v<long double> / 5.0L);
  CHECK(half_distance(two, 0.0, 3.1415) == found);
  // Two channels that say the same are one.
  two.signal = test::tone(2);
  two.signal.add_result(two.signal.results().front());
  CHECK(half_distance(two) == 0.25);
  CHECK_FALSE(half_distance(two, 0.0, 0.5) > 0.0);
}

TEST_CASE("what a detector does not see of a turn comes nearer") {
  using trackers::Operation;
  const auto of = [](const auto& detector) {
    test::Example example(loop_with(detector));
    example.signal = test::tone(2, true);
    return half_distance(example);
  };
  const auto is = [](double found, double degree) {
    CHECK(found == doctest::Approx(kPi / degree).epsilon(1e-12));
  };
  is(of([](StraightLineProgram& step, int theta) { return step.append(Operation::sin, theta); }), 1.0);
  is(of([](StraightLineProgram& step, int theta) {
       return step.append(Operation::multiply, step.append(Operation::sin, theta),
                          step.append(Operation::cos, theta));
     }),
     2.0);
  is(of([](StraightLineProgram& step, int theta) {
       return step.append(Operation::sin, step.append(Operation::add, theta, theta));
     }),
     2.0);
  is(of([](StraightLineProgram& step, int theta) {
       return step.append({Operation::power, step.append(Operation::sin, theta), -1, -1, 3});
     }),
     3.0);
  // Of what is no sum of angles: twice its degree.
  is(of([](StraightLineProgram& step, int theta) {
       return step.append(Operation::sin, step.append(Operation::sin, theta));
     }),
     2.0);
}

}  // namespace
}  // namespace veritrack::model

#include "analysis/model/tube/angle_check.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using trackers::Operation;
using trackers::StraightLineProgram;

TEST_CASE("whole turns: what depends on them, and what does not") {
  const rigor::UpwardRounding upward;
  const test::Example loop(test::phase_locked_loop());
  CHECK(angle_objection(loop.tracker.recursion, loop.model.constants).empty());
  // The frequency estimate must not see them.
  trackers::Recursion changed = loop.tracker.recursion;
  changed.frequency = test::frequency_of_state(2, 2, 1);
  CHECK(angle_objection(changed, loop.model.constants) == "the frequency depends on whole turns of an angle");
  // An angle that is treated as a number.
  changed = loop.tracker.recursion;
  changed.is_angle = {true, true};
  CHECK_FALSE(angle_objection(changed, loop.model.constants).empty());
  changed.is_angle = {false, false};
  CHECK(angle_objection(changed, loop.model.constants).empty());
  CHECK(is_periodic(loop.signal, loop.model.constants));
  StraightLineProgram ramp(4);
  ramp.add_result(3);
  CHECK_FALSE(is_periodic(ramp, loop.model.constants));
  StraightLineProgram half(5);
  half.add_result(half.append(Operation::sin, half.append(Operation::multiply, 2, 4)));
  CHECK_FALSE(is_periodic(half, {Interval(1.0), Interval(1.0), Interval(0.5)}));
  CHECK(is_periodic(half, {Interval(1.0), Interval(1.0), Interval(3.0)}));
  StraightLineProgram none(4);
  CHECK_FALSE(is_periodic(none, loop.model.constants));
}

/// A recursion of one angle and one number with these next values; inputs: a constant, both states, a sample.
trackers::Recursion recursion_of(const StraightLineProgram& step) {
  trackers::Recursion recursion;
  recursion.constants = 1;
  recursion.states = 2;
  recursion.samples = 1;
  recursion.is_angle = {true, false};
  recursion.step = step;
  recursion.frequency = test::frequency_of_state(1, 2, 1);
  return recursion;
}

constexpr int kConstant = 0, kAngle = 1, kNumber = 2, kSample = 3;

/// The objection to the next value of the angle, or of the number, that `append` makes.
template <typename Append>
std::optional<TurnObjection> objection_to(bool is_to_angle, double constant, const Append& append) {
  StraightLineProgram step(4);
  const int made = append(step);
  step.add_result(is_to_angle ? made : kAngle);
  step.add_result(is_to_angle ? kNumber : made);
  return find_turn_objection(recursion_of(step), {Interval(constant)});
}

TEST_CASE("an angle may turn as itself only: sums with what does not turn, and back from whole multiples") {
  const auto to_angle = [](double constant, const auto& append) {
    return objection_to(true, constant, append).has_value();
  };
  using Program = StraightLineProgram;
  CHECK_FALSE(to_angle(1.0, [](Program& p) { return p.append(Operation::add, kAngle, kSample); }));
  CHECK_FALSE(to_angle(1.0, [](Program& p) { return p.append(Operation::subtract, kAngle, kNumber); }));
  CHECK(to_angle(1.0, [](Program& p) { return p.append(Operation::subtract, kNumber, kAngle); }));
  CHECK(to_angle(1.0, [](Program& p) { return p.append(Operation::negate, kAngle); }));
  CHECK(to_angle(1.0, [](Program& p) { return p.append(Operation::add, kAngle, kAngle); }));
  // 3 angle - 2 angle, with the factor among the constants; half an angle is none.
  const auto three_less_two = [](Program& p) {
    return p.append(Operation::subtract, p.append(Operation::multiply, kConstant, kAngle),
                    p.append(Operation::add, kAngle, kAngle));
  };
  CHECK_FALSE(to_angle(3.0, three_less_two));
  CHECK(to_angle(4.0, three_less_two));
  CHECK(to_angle(2.5, three_less_two));
  // A product with something that is no constant.
  CHECK(to_angle(1.0, [](Program& p) { return p.append(Operation::multiply, kNumber, kAngle); }));
}

TEST_CASE("a number may depend on an angle through sin, cos and tan of whole multiples only") {
  using Program = StraightLineProgram;
  for (const Operation function : {Operation::sin, Operation::cos, Operation::tan}) {
    const auto of_multiple = [&](Program& p) {
      return p.append(function, p.append(Operation::multiply, kAngle, kConstant));
    };
    CHECK_FALSE(objection_to(false, -2.0, of_multiple).has_value());
    CHECK(objection_to(false, 0.5, of_multiple).has_value());
  }
  const auto power = [](Program& p) { return p.append({Operation::power, kAngle, -1, -1, 2}); };
  CHECK(objection_to(false, 1.0, power).has_value());
}

TEST_CASE("the objection names the value, and the register where whole turns come in first") {
  using Program = StraightLineProgram;
  int origin = -1;
  const auto objection = objection_to(false, 1.0, [&](Program& p) {
    origin = p.append(Operation::multiply, kAngle, kSample);
    return p.append(Operation::add, p.append(Operation::sin, origin), kNumber);
  });
  REQUIRE(objection.has_value());
  CHECK(objection->state == 1);
  CHECK(objection->place == origin);
  StraightLineProgram still(4);
  still.add_result(kAngle);
  still.add_result(kNumber);
  trackers::Recursion recursion = recursion_of(still);
  CHECK_FALSE(find_turn_objection(recursion, {Interval(1.0)}).has_value());
  recursion.frequency = test::frequency_of_state(1, 2, 0);
  REQUIRE(find_turn_objection(recursion, {Interval(1.0)}).has_value());
  CHECK(find_turn_objection(recursion, {Interval(1.0)})->state == -1);
  CHECK(angle_objection(recursion, {}) == "the constants or the list of angles do not fit the recursion");
}

}  // namespace
}  // namespace veritrack::model

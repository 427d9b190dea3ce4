// The parts of the network that formulas add to a frame.
#include <doctest/doctest.h>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

using rigor::Interval;

TEST_CASE("a value that is used twice is one node, and components are numbered as inputs arise") {
  const rigor::UpwardRounding upward;
  Frame frame(Interval(1.25), Interval::from_bounds(0.2, 0.3), 1);
  const FrameValue theta = frame.state(0, true, 1, 0.0, 1.0);
  const FrameValue y1 = frame.sample(0);
  const FrameValue y2 = frame.sample(1);
  const FrameValue in_phase = y1 * cos(theta) + y2 * sin(theta);
  const FrameLine first = frame.line_of(in_phase);
  const std::size_t inputs = frame.inputs().size();
  const std::size_t forms = frame.forms().size();
  const FrameLine second = frame.line_of(in_phase);
  CHECK(frame.inputs().size() == inputs);
  CHECK(frame.forms().size() == forms);
  CHECK(first.inputs.size() == second.inputs.size());
  (void)frame.line_of(in_phase * in_phase);
  int components = 0;
  for (const FrameInput& each : frame.inputs()) {
    CHECK(each.first == components);
    components += each.components;
  }
  CHECK(frame.inputs().size() > inputs);
}

TEST_CASE("weights of a component that is added twice add up, and a form has no steady value") {
  const rigor::UpwardRounding upward;
  FrameLine line;
  line.constant = Interval(2.0);
  line.per_frequency = Interval(4.0);
  FrameRules::add_component(line, 3, Interval(0.5));
  FrameRules::add_component(line, 3, Interval(0.25));
  FrameRules::add_component(line, 1, Interval(-1.0));
  CHECK(line.inputs.at(3) == Interval(0.75));
  CHECK(line.inputs.at(1) == Interval(-1.0));
  CHECK(FrameRules::base_of(line, Interval(0.25)) == Interval(3.0));
  const FrameLine form = FrameRules::form_of(line);
  CHECK(form.inputs.size() == 2);
  CHECK(FrameRules::base_of(form, Interval(0.25)) == Interval(0.0));
  CHECK_NOTHROW(FrameRules::require_no_turns(line));
  line.turns = 1;
  CHECK_THROWS_AS(FrameRules::require_no_turns(line), NoFrame);
  line.turns = 0;
  line.is_modular = true;
  CHECK_THROWS_AS(FrameRules::require_no_turns(line), NoFrame);
}

TEST_CASE("a limit has the room that is left, and one without room is refused") {
  const rigor::UpwardRounding upward;
  Frame frame(Interval(1.0), Interval(0.25), 1);
  const FrameValue x = frame.state(0, false, 0, 0.5, 0.0);
  const int form = FrameRules::add_form(frame, frame.line_of(x));
  FrameRules::add_limit(frame, form, Interval::from_bounds(0.25, 0.5));
  REQUIRE(frame.limits().size() == 1);
  CHECK(frame.limits().front().form == form);
  CHECK(frame.limits().front().room == 0.25);
  for (const Interval& room :
       {Interval(0.0), Interval::from_bounds(0.0, 1.0), Interval(-1.0), Interval::empty()}) {
    CHECK_THROWS_AS(FrameRules::add_limit(frame, form, room), NoFrame);
  }
}

}  // namespace veritrack::model

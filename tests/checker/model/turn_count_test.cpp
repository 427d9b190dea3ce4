// Whole turns of angles, read off the formulas.
#include "checker/model/turn_count.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace veritrack::checker {
namespace {

using Json = nlohmann::json;

Json loop_with(const std::string& step) {
  return {
      {"samples", {"y"}},
      {"parameters", Json::array({{{"name", "two"}, {"formula", "2"}}, {{"name", "k"}, {"formula", "0.1"}}})},
      {"angles", {"theta"}},
      {"frequency", "w"},
      {"signal", {"A*cos(phi)"}},
      {"states", {"theta", "w"}},
      {"step", step}};
}

std::string objection(const Json& model) {
  return angle_objection(ModelRecursion(read_json(model.dump())));
}
std::string objection_to_next(const std::string& theta, const std::string& w) {
  return objection(loop_with("theta' = " + theta + "\nw' = " + w));
}

TEST_CASE("what depends on whole turns, and what does not") {
  CHECK(objection_to_next("theta + w", "w + k*y*sin(theta + w)").empty());
  CHECK(objection_to_next("theta + w - k*y*cos(2*theta)", "w*tan(3*theta - w)").empty());
  CHECK(objection_to_next("3*theta - two*theta + w", "w").empty());
  CHECK(objection_to_next("(theta + w)*1", "w*cos(-theta)^2").empty());
  for (const char* theta : {"w", "2*theta", "theta - theta", "theta*k", "theta*y", "sin(theta)", "theta^2",
                            "1.5*theta - 0.5*theta", "theta/1", "sqrt(theta)", "stays_within(theta, 0, 7)"}) {
    CAPTURE(theta);
    CHECK(objection_to_next(theta, "w") == "the next value of theta is not known to turn as the angle does");
  }
  for (const char* w : {"theta", "w + sin(theta/2)", "w + sin(k*theta)", "atan(theta)", "exp(theta)",
                        "1/theta", "w*theta", "atan2(theta, w)", "asin(theta)", "theta*theta"}) {
    CAPTURE(w);
    CHECK(objection_to_next("theta", w) == "the next value of w may depend on whole turns of an angle");
  }
  Json model = loop_with("theta' = theta\nw' = w");
  model["frequency"] = "w + theta";
  CHECK(objection(model) == "the frequency may depend on whole turns of an angle");
  model["frequency"] = "w + sin(theta)";
  CHECK(objection(model).empty());
  for (const char* signal : {"A*cos(phi/2)", "A*phi", "A*cos(k*phi)"}) {
    model["signal"] = {signal};
    CHECK(objection(model) == "the signal is not known to have the period 2 pi");
  }
  model["signal"] = {"A*cos(phi) + 0.1*A*sin(3*phi) + 0.01"};
  CHECK(objection(model).empty());
}

TEST_CASE("a factor turns by as often as it says only where it is certainly that whole number") {
  const auto turns_twice = [](const Ball& factor) {
    return (TurnCount(factor) * TurnCount::angle(0, 1)).turns_by({2});
  };
  CHECK(turns_twice(two));
  CHECK_FALSE(turns_twice(Ball(2.5)));
  CHECK_FALSE(turns_twice(Ball::hull(Ball(1.5), Ball(2.5))));
  CHECK_FALSE(turns_twice(Ball::hull(Ball(2.0), Ball(2.0 + 0x1p-50))));
  CHECK_FALSE(turns_twice(Ball::everything()));
}

TEST_CASE("a wrap around the whole next value of an angle is left out, unless a formula uses that value") {
  CHECK(objection_to_next("wrap(theta + w)", "w + k*y*sin(theta)").empty());
  CHECK(objection_to_next("wrap(wrap(theta + w))", "w").empty());
  const std::string refused = "the next value of theta is not known to turn as the angle does";
  CHECK(objection_to_next("wrap(theta + w) + 0", "w") == refused);
  CHECK(objection_to_next("theta + wrap(theta)", "w").empty());  // wrap has the period of a turn
  CHECK(objection_to_next("wrap(2*theta)", "w") == refused);
  CHECK(objection_to_next("atan2(sin(theta), cos(theta))", "w") == refused);
  // theta' - theta jumps by a turn where the program wraps.
  CHECK(objection_to_next("wrap(theta + w)", "theta' - theta") == refused);
  // w is no angle: its wrap is a function like any other.
  const ModelRecursion wrapped(read_json(loop_with("theta' = theta + w\nw' = wrap(w)").dump()));
  const std::vector<Ball> next = wrapped.next<Ball>({Ball(0.0), Ball(4.0)}, {Ball(0.0)});
  CHECK(certainly_less(next[1], zero));
  const ModelRecursion angle(read_json(loop_with("theta' = wrap(theta + w)\nw' = w").dump()));
  CHECK(certainly_less(Ball(3.5), angle.next<Ball>({Ball(0.0), Ball(4.0)}, {Ball(0.0)})[0]));
}

TEST_CASE("a filter that estimates a phase") {
  Json model{{"samples", {"y"}},
             {"parameters", Json::array()},
             {"angles", {"theta"}},
             {"frequency", "w"},
             {"signal", {"A*cos(phi)"}},
             {"ekf",
              {{"states", {"theta", "w"}},
               {"predict", "theta' = theta + w\nw' = w"},
               {"measure", {"cos(theta)"}},
               {"Q", Json::parse(R"json([["1", "0"], ["0", "1"]])json")},
               {"R", Json::array({Json::array({"1"})})}}}};
  CHECK(objection(model).empty());
  model["ekf"]["measure"] = {"theta"};
  CHECK_FALSE(objection(model).empty());
  model["ekf"]["measure"] = {"cos(theta)"};
  model["angles"] = {"theta", "P.theta.w"};
  CHECK_FALSE(objection(model).empty());
  model["angles"] = {"theta"};
  model["ekf"]["jacobian"] = Json::parse(R"json([["1", "1"], ["0", "1"]])json");
  CHECK(objection(model).empty());
  model["ekf"]["jacobian"] = Json::parse(R"json([["1", "1"], ["theta", "1"]])json");
  CHECK_FALSE(objection(model).empty());
}

}  // namespace
}  // namespace veritrack::checker

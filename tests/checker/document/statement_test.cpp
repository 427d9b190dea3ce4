#include "checker/document/statement.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace veritrack::checker;

namespace {

const Ball low(1.0);
const Ball high(2.0);

std::string enclosure_text(const std::string& lo, const std::string& hi) {
  return R"({"lo": ")" + lo + R"(", "hi": ")" + hi + R"("})";
}
/// [1, 2]
Tree enclosure() {
  return read_json(enclosure_text("0x1p+0", "0x1p+1"));
}

Objections objections_to(const Tree& claimed, const Quantity& quantity) {
  Objections objections;
  check_enclosure(claimed, quantity, objections);
  return objections;
}

/// With the verdict and that of its condition; without those that are empty.
Tree derivation(const std::string& verdict, const std::string& condition_verdict) {
  const std::string condition =
      condition_verdict.empty() ? "" : R"({"id": "c", "verdict": ")" + condition_verdict + R"("})";
  return read_json(R"({"quantities": {"q": )" + enclosure_text("0x1p+0", "0x1p+1") + R"(}, "conditions": [)" +
                   condition + "]" + (verdict.empty() ? "" : R"(, "verdict": ")" + verdict + "\"") + "}");
}
Objections objections_to(const Tree& claimed, const Derivation& found) {
  Objections objections;
  check_derivation(claimed, found, objections);
  return objections;
}

}  // namespace

TEST_CASE("a comparison is decided only for all points") {
  const Ball wide = Ball::hull(low, high);
  CHECK(decide_less(low, high) == Verdict::proved);
  CHECK(decide_less(high, low) == Verdict::refuted);
  CHECK(decide_less(low, low) == Verdict::refuted);
  CHECK(decide_at_most(low, low) == Verdict::proved);
  CHECK(decide_less(wide, Ball(1.5)) == Verdict::undecided);
  CHECK(decide_less(Ball::everything(), low) == Verdict::undecided);
  CHECK(decide_at_most(wide, Ball(1.5)) == Verdict::undecided);
}

TEST_CASE("verdicts together") {
  using V = Verdict;
  CHECK(all_of({}) == V::undecided);
  CHECK(all_of({V::proved, V::proved}) == V::proved);
  CHECK(all_of({V::proved, V::undecided}) == V::undecided);
  CHECK(all_of({V::undecided, V::refuted}) == V::refuted);
  CHECK_THROWS_AS((void)verdict_from("PROVED"), Malformed);
}

TEST_CASE("an enclosure contains a value, or bounds it from the side that was established") {
  const Ball inside(1.5);
  const Ball outside(2.5);
  const Tree upper = read_json(R"({"hi": "0x1p+1"})");
  const Tree lower = read_json(R"({"lo": "0x1p+0"})");
  CHECK(objections_to(enclosure(), {"q", inside}).empty());
  CHECK(objections_to(enclosure(), {"q", Range(low, high)}).empty());
  CHECK(objections_to(upper, {"q", inside}).empty());
  CHECK(objections_to(lower, {"q", inside}).empty());
  CHECK(objections_to(upper, {"q", Ball(0.5), Sense::bounds_above}).empty());
  CHECK(objections_to(lower, {"q", outside, Sense::bounds_below}).empty());
  CHECK(objections_to(upper, {"q", outside, Sense::bounds_above}).size() == 1);
  CHECK(objections_to(lower, {"q", Ball(0.5), Sense::bounds_below}).size() == 1);
  // Of what was only bounded from one side, nothing may be said of the other.
  CHECK(objections_to(enclosure(), {"q", inside, Sense::bounds_above}).size() == 1);
  CHECK(objections_to(enclosure(), {"q", inside, Sense::bounds_below}).size() == 1);
  CHECK(objections_to(lower, {"q", inside, Sense::bounds_above}).size() == 1);
  CHECK(objections_to(read_json("{}"), {"q", inside}).size() == 1);
  // Partly outside is an objection, wholly outside an alarm, nothing known an objection in every sense.
  const Objections partly = objections_to(enclosure(), {"q", Range(inside, outside)});
  REQUIRE(partly.size() == 1);
  CHECK(partly.front().find("ALARM") == std::string::npos);
  const Objections wholly = objections_to(enclosure(), {"q", outside});
  REQUIRE(wholly.size() == 1);
  CHECK(wholly.front().find("ALARM") == 0);
  for (const Sense sense : {Sense::encloses, Sense::bounds_above, Sense::bounds_below}) {
    CHECK(!objections_to(enclosure(), {"q", Ball::everything(), sense}).empty());
  }
}

TEST_CASE("an enclosure that contradicts itself is an objection whatever the value") {
  CHECK(!objections_to(read_json(enclosure_text("0x1p+1", "0x1p+0")), {"q", Ball(1.5)}).empty());
  Objections objections;
  (void)read_enclosure(read_json(enclosure_text("0x1p+1", "0x1p+0")), "q", objections);
  CHECK(objections.size() == 1);
}

TEST_CASE("a derivation says no more than was found") {
  Derivation found{"T", {{"q", Ball(1.5)}}, {{"c", "x < y", Verdict::proved}}};
  CHECK(objections_to(derivation("proved", "proved"), found).empty());
  CHECK(objections_to(derivation("", ""), found).empty());
  CHECK(objections_to(derivation("", "proved"), found).empty());
  // Its verdict is that of its conditions, all of them.
  CHECK(!objections_to(derivation("proved", ""), found).empty());
  CHECK(!objections_to(derivation("refuted", "refuted"), found).empty());
  CHECK_THROWS_AS(objections_to(derivation("undecided", "proved"), found), Malformed);
  CHECK_THROWS_AS(objections_to(derivation("", "undecided"), found), Malformed);
  Derivation other = found;
  other.quantities.clear();
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
  other = found;
  other.conditions.front().id = "d";
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
  other = found;
  other.conditions.front().verdict = Verdict::undecided;
  CHECK(!objections_to(derivation("", "proved"), other).empty());
  other = found;
  other.conditions.push_back({"d", "x < y", Verdict::proved});
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
  CHECK(objections_to(derivation("", "proved"), other).empty());
  // One condition that is refuted is enough.
  other.conditions.front().verdict = Verdict::refuted;
  CHECK(objections_to(derivation("refuted", "refuted"), other).empty());
}

TEST_CASE("a claim says no more than was found") {
  const auto objections_for = [](const std::string& text, const Claim& found) {
    Objections objections;
    check_claim(read_json(text), found, objections);
    return objections;
  };
  const std::string proved =
      R"({"verdict": "proved", "evidence": {"q": )" + enclosure_text("0x1p+0", "0x1p+1") + "}}";
  const Claim found{"S", Verdict::proved, {{"q", Ball(1.5)}}};
  CHECK(objections_for(proved, found).empty());
  CHECK(!objections_for(proved, {"", Verdict::proved, found.evidence}).empty());
  CHECK(!objections_for(proved, {"S", Verdict::undecided, found.evidence}).empty());
  CHECK(!objections_for(proved, {"S", Verdict::refuted, found.evidence}).empty());
  CHECK(!objections_for(proved, {"S", Verdict::proved, {}}).empty());
}

#include "checker/document/statement.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace veritrack::checker;

namespace {

const Ball low(1.0);
const Ball high(2.0);

std::string enclosure_text(const std::string& lo, const std::string& hi, const std::string& decimal) {
  return R"({"lo": ")" + lo + R"(", "hi": ")" + hi + R"(", "decimal": ")" + decimal + R"("})";
}
/// [1, 2]
Tree enclosure() {
  return read_json(enclosure_text("0x1p+0", "0x1p+1", "[1, 2]"));
}

Objections objections_to(const Tree& claimed, const Quantity& quantity) {
  Objections objections;
  check_enclosure(claimed, quantity, objections);
  return objections;
}

Tree derivation(const std::string& verdict, const std::string& condition_verdict) {
  return read_json(R"({"title": "T", "quantities": {"q": )" + enclosure_text("0x1p+0", "0x1p+1", "[1, 2]") +
                   R"(, "sampled": {"lo": "0x1p+0", "hi": "0x1p+0", "decimal": "[1, 1]", "proved": false}},
                   "conditions": [{"id": "c", "statement": "x < y", "verdict": ")" +
                   condition_verdict + R"("}], "verdict": ")" + verdict + R"("})");
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

TEST_CASE("an enclosure contains a value, or bounds it") {
  const Ball inside(1.5);
  const Ball outside(2.5);
  CHECK(objections_to(enclosure(), {"q", inside}).empty());
  CHECK(objections_to(enclosure(), {"q", Range(low, high)}).empty());
  CHECK(objections_to(enclosure(), {"q", Ball(0.5), Sense::bounds_above}).empty());
  CHECK(objections_to(enclosure(), {"q", outside, Sense::bounds_below}).empty());
  CHECK(objections_to(enclosure(), {"q", outside, Sense::bounds_above}).size() == 1);
  CHECK(objections_to(enclosure(), {"q", Ball(0.5), Sense::bounds_below}).size() == 1);
  // Partly outside is an objection, wholly outside an alarm, nothing known an objection in every sense.
  const Objections partly = objections_to(enclosure(), {"q", Range(inside, outside)});
  REQUIRE(partly.size() == 1);
  CHECK(partly.front().find("ALARM") == std::string::npos);
  const Objections wholly = objections_to(enclosure(), {"q", outside});
  REQUIRE(wholly.size() == 1);
  CHECK(wholly.front().find("ALARM") == 0);
  for (const Sense sense : {Sense::encloses, Sense::bounds_above, Sense::bounds_below}) {
    CHECK(objections_to(enclosure(), {"q", Ball::everything(), sense}).size() == 1);
  }
}

TEST_CASE("an enclosure that contradicts itself is an objection whatever the value") {
  const Ball inside(1.5);
  for (const char* decimal : {"[1.1, 2]", "[1, 1.9]"}) {
    CHECK(!objections_to(read_json(enclosure_text("0x1p+0", "0x1p+1", decimal)), {"q", inside}).empty());
  }
  CHECK(!objections_to(read_json(enclosure_text("0x1p+1", "0x1p+0", "[0, 3]")), {"q", inside}).empty());
  for (const char* decimal : {"", "1, 2", "[1; 2]", "[1, 2", "[a, b]"}) {
    Objections objections;
    const Tree tree = read_json(enclosure_text("0x1p+0", "0x1p+1", decimal));
    CHECK_THROWS_MESSAGE(check_enclosure(tree, {"q", inside}, objections), decimal);
  }
}

TEST_CASE("a number is what its text says") {
  Objections objections;
  const Tree right = read_json(R"({"text": "1.5", "lo": "0x1p+0", "hi": "0x1p+1", "decimal": "[1, 2]"})");
  CHECK(certainly_equal(read_number(right, objections), Ball(1.5)));
  CHECK(objections.empty());
  const Tree wrong = read_json(R"({"text": "2.5", "lo": "0x1p+0", "hi": "0x1p+1", "decimal": "[1, 2]"})");
  (void)read_number(wrong, objections);
  CHECK(objections.size() == 1);
}

TEST_CASE("a derivation says no more than was found") {
  Derivation found{"T", {{"q", Ball(1.5)}}, {{"c", "x < y", Verdict::proved}}};
  CHECK(objections_to(derivation("proved", "proved"), found).empty());
  CHECK(objections_to(derivation("undecided", "undecided"), found).empty());
  CHECK(objections_to(derivation("undecided", "proved"), found).empty());
  // Its verdict is that of its conditions, not of those that could be proved.
  CHECK(!objections_to(derivation("proved", "undecided"), found).empty());
  CHECK(!objections_to(derivation("refuted", "refuted"), found).empty());
  Derivation other = found;
  other.title = "another";
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
  other = found;
  other.quantities.clear();
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
  other = found;
  other.conditions.front().statement = "x < z";
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
  other = found;
  other.conditions.push_back({"d", "x < y", Verdict::proved});
  CHECK(!objections_to(derivation("proved", "proved"), other).empty());
}

TEST_CASE("a claim says no more than was found") {
  const auto objections_for = [](const std::string& text, const Claim& found) {
    Objections objections;
    check_claim(read_json(text), found, objections);
    return objections;
  };
  const std::string evidence =
      R"(, "evidence": {"q": )" + enclosure_text("0x1p+0", "0x1p+1", "[1, 2]") + "}}";
  const std::string proved = R"({"statement": "S", "verdict": "proved")" + evidence;
  const std::string undecided = R"({"statement": "other", "verdict": "undecided")" + evidence;
  const Claim found{"S", Verdict::proved, {{"q", Ball(1.5)}}};
  CHECK(objections_for(proved, found).empty());
  CHECK(objections_for(undecided, found).empty());
  CHECK(!objections_for(proved, {"another", Verdict::proved, found.evidence}).empty());
  CHECK(!objections_for(proved, {"S", Verdict::undecided, found.evidence}).empty());
  CHECK(!objections_for(proved, {"S", Verdict::refuted, found.evidence}).empty());
  CHECK(!objections_for(proved, {"S", Verdict::proved, {}}).empty());
}

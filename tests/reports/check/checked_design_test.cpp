#include "reports/check/checked_design.hpp"

#include <doctest/doctest.h>

#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::reports;

CheckedDesign example() {
  return {
      "designs/x.toml",
      {{"ekf/frequency-error-bound", "the error is \"small\"\n", "reason", rigor::Verdict::proved, {3, 4}},
       {"ekf/settling-time", "it settles", "not shown", rigor::Verdict::undecided, {5, 6}}},
      std::nullopt,
      1.25};
}

TEST_CASE("what is told comes back, but for the path") {
  const auto back = checked_from_text(to_text(example()));
  REQUIRE(back);
  REQUIRE(back->requirements.size() == 2);
  CHECK(back->requirements[0].claim == "ekf/frequency-error-bound");
  CHECK(back->requirements[0].requirement == "the error is \"small\"\n");
  CHECK(back->requirements[0].verdict == rigor::Verdict::proved);
  CHECK(back->requirements[1].verdict == rigor::Verdict::undecided);
  CHECK(back->requirements[1].reason == "not shown");
  CHECK(back->requirements[1].position.column == 6);
  CHECK(back->seconds == 1.25);
  CHECK_FALSE(back->objection);
  CHECK(back->path.empty());
}

TEST_CASE("an objection comes back with its kind and place") {
  for (const auto kind : {CheckObjection::Kind::bad_input, CheckObjection::Kind::failure,
                          CheckObjection::Kind::time_limit, CheckObjection::Kind::not_verified,
                          CheckObjection::Kind::nothing_required, CheckObjection::Kind::cannot_write}) {
    const auto back = checked_from_text(to_text({"x", {}, CheckObjection{kind, "why", {7, 8}}}));
    REQUIRE(back);
    REQUIRE(back->objection);
    CHECK(back->objection->kind == kind);
    CHECK(back->objection->message == "why");
    CHECK(back->objection->position.line == 7);
  }
}

TEST_CASE("whether it was verified comes back") {
  CheckedDesign design = example();
  CHECK_FALSE(checked_from_text(to_text(design))->verified.has_value());
  note_verification(design, "");
  CHECK(checked_from_text(to_text(design))->verified == true);
  CHECK(design.requirements[0].verdict == rigor::Verdict::proved);
  CHECK(design.requirements[0].reason == "reason");
}

TEST_CASE("what the checker refuses is undecided, whatever it was; without requirements it is an objection") {
  CheckedDesign design = example();
  design.requirements[1].verdict = rigor::Verdict::refuted;
  note_verification(design, "contraction (radius)");
  const auto back = checked_from_text(to_text(design));
  REQUIRE(back);
  CHECK(back->verified == false);
  CHECK_FALSE(back->objection);
  for (const CheckedRequirement& requirement : back->requirements) {
    CHECK(requirement.verdict == rigor::Verdict::undecided);
    CHECK(requirement.reason == "not verified: contraction (radius)");
  }
  CheckedDesign nothing{"x", {}};
  note_verification(nothing, "contraction (radius)");
  REQUIRE(nothing.objection);
  CHECK(nothing.objection->kind == CheckObjection::Kind::not_verified);
  CHECK(nothing.objection->message == "contraction (radius)");
}

TEST_CASE("that a search was cut short comes back, and makes what is undecided not final") {
  CheckedDesign design = example();
  CHECK(is_final(design));
  design.cut_short = true;
  CHECK(checked_from_text(to_text(design))->cut_short);
  CHECK_FALSE(is_final(design));
  design.requirements[1].verdict = rigor::Verdict::refuted;
  CHECK(is_final(design));
  design.objection = CheckObjection{CheckObjection::Kind::failure, "why", {}};
  CHECK_FALSE(is_final(design));
}

TEST_CASE("the exit status is that of the worst, and the last line counts") {
  using Kind = CheckObjection::Kind;
  const CheckedDesign proved{"a", {{"x", "y", "z", rigor::Verdict::proved, {1, 1}}}};
  const CheckedDesign nothing{"b", {}};
  CheckedDesign refuted = example();
  refuted.requirements[0].verdict = rigor::Verdict::refuted;
  const auto with = [](Kind kind) { return CheckedDesign{"c", {}, CheckObjection{kind, "why", {}}}; };
  CHECK(exit_status_of({}) == 0);
  CHECK(exit_status_of({proved, nothing}) == 0);
  CHECK(exit_status_of({proved, example()}) == 1);
  CHECK(exit_status_of({refuted}) == 1);
  CHECK(exit_status_of({with(Kind::time_limit)}) == 1);
  CHECK(exit_status_of({with(Kind::nothing_required)}) == 1);
  CHECK(exit_status_of({with(Kind::not_verified)}) == 1);
  CHECK(exit_status_of({with(Kind::bad_input), example()}) == 2);
  CHECK(exit_status_of({with(Kind::failure)}) == 2);
  CHECK(exit_status_of({proved, with(Kind::cannot_write)}) == 2);
  CHECK(summary_of({proved}) == "1 design: 1 proved");
  CHECK(summary_of({proved, example(), refuted, with(Kind::time_limit), nothing, with(Kind::failure),
                    with(Kind::bad_input), with(Kind::cannot_write)}) ==
        "7 designs: 1 proved, 1 refuted, 2 undecided, 1 with nothing required, 2 bad; 1 report cannot be "
        "written");
}

TEST_CASE("half a text, or a changed word, is nothing") {
  const std::string text = to_text(example());
  for (std::size_t length = 0; length < text.size(); ++length) {
    CHECK_FALSE(checked_from_text(text.substr(0, length)));
  }
  for (const char* word :
       {"proved", "undecided", "seconds", "cut_short", "requirements", "position", "line"}) {
    std::string changed = text;
    changed.replace(changed.find(word), 1, "X");
    CHECK_FALSE(checked_from_text(changed));
  }
}

TEST_CASE("random texts are nothing") {
  test::Random random;
  for (std::int64_t i = 0; i < test::effort(200); ++i) {
    std::string text = to_text(example());
    text[random.below(text.size())] = static_cast<char>(1 + random.below(126));
    const auto back = checked_from_text(text);
    // A digit or a letter of a sentence may be another; a verdict may not.
    CHECK((!back || back->requirements.empty() || back->requirements[0].verdict == rigor::Verdict::proved));
  }
}

}  // namespace

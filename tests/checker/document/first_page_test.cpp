// The list at the top of a document: composed from the sentences, and nothing else in its place.
#include "checker/document/first_page.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace veritrack::checker;

namespace {

using Lines = std::vector<std::string>;

const std::string kTone = "In exact arithmetic (nearest, even), for a tone of amplitude 1";
const std::string kNoise = ", with measurement noise of at most 0.1 (both channels, together)";
const std::string kStart = ", started within 0.5 rad of it, 0.2 of the amplitude and with P(0|0) of 1";

Sentence sentence(const std::string& hypotheses, const std::string& conclusion,
                  Verdict verdict = Verdict::proved) {
  return {"a/b", verdict, hypotheses + conclusion, true, hypotheses};
}

std::vector<Sentence> sentences() {
  return {sentence(kTone + kNoise + kStart + ", ", "the error stays below 3 for ever."),
          sentence(kTone + kNoise, ", a set contains errors up to 2.", Verdict::refuted),
          sentence(kTone, ", it tolerates noise up to 4, and without noise a slew."),
          {"c/d", Verdict::proved, "It is so.", true},
          {"e/f", Verdict::proved, "It is not at the top.", false}};
}

const Lines kPage{"**Assume** (each claim below names those that it rests on)",
                  "1. In exact arithmetic (nearest, even)",
                  "2. for a tone of amplitude 1",
                  "3. with measurement noise of at most 0.1 (both channels, together)",
                  "4. started within 0.5 rad of it, 0.2 of the amplitude and with P(0|0) of 1",
                  "**Then**",
                  "- **PROVED** (1 to 4): the error stays below 3 for ever.",
                  "- **REFUTED** (1 to 3): a set contains errors up to 2.",
                  "- **PROVED** (1, 2): it tolerates noise up to 4, and without noise a slew.",
                  "**PROVED**: It is so."};

std::size_t objections_to(const Lines& lines) {
  Objections objections;
  check_first_page(lines, kPage, objections);
  return objections.size();
}

Lines changed(std::size_t line, const std::string& to) {
  Lines lines = kPage;
  lines[line] = to;
  return lines;
}

Lines with(std::size_t before, const std::string& added) {
  Lines lines = kPage;
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(before), added);
  return lines;
}

}  // namespace

TEST_CASE("each hypothesis stands there once, and each sentence names those that it rests on") {
  CHECK(first_page(sentences()) == kPage);
  CHECK(first_page({}).empty());
  CHECK(first_page({sentences().back()}).empty());
}

TEST_CASE("a hypothesis that differs in a word is another one") {
  const Lines page = first_page({sentence(kTone + ", with noise below 1", ", a."),
                                 sentence(kTone + ", with noise below 2", ", b."),
                                 sentence(kTone + ", without noise, started in the set \"x\"", ", c.")});
  CHECK(page == Lines{"**Assume** (each claim below names those that it rests on)",
                      "1. In exact arithmetic (nearest, even)", "2. for a tone of amplitude 1",
                      "3. with noise below 1", "4. with noise below 2", "5. without noise",
                      "6. started in the set \"x\"", "**Then**", "- **PROVED** (1 to 3): a.",
                      "- **PROVED** (1, 2, 4): b.", "- **PROVED** (1, 2, 5, 6): c."});
}

TEST_CASE("hypotheses that are sentences of their own end with them") {
  const Lines page = first_page(
      {sentence("In exact arithmetic, the block tracker is fed with a tone, plus noise of 1. Its first "
                "prediction is near. Then ",
                "it stays near.")});
  CHECK(page == Lines{"**Assume** (each claim below names those that it rests on)", "1. In exact arithmetic",
                      "2. the block tracker is fed with a tone", "3. plus noise of 1",
                      "4. Its first prediction is near", "**Then**",
                      "- **PROVED** (1 to 4): it stays near."});
}

TEST_CASE("the list is accepted with reasons, empty lines and what is undecided before it") {
  CHECK(objections_to(kPage) == 0);
  CHECK(objections_to(with(7, "  Why: All these starts lie in a set.")) == 0);
  CHECK(objections_to(with(1, "")) == 0);
  CHECK(objections_to(with(0, "**UNDECIDED**: It might be more.")) == 0);
  Lines below = with(10, "*Verified* by itself.");
  below.insert(below.begin() + 10, "");
  CHECK(objections_to(below) == 0);
}

TEST_CASE("any other line of the list is refused") {
  for (std::size_t line = 0; line < kPage.size(); ++line) {
    Lines missing = kPage;
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(line));
    CAPTURE(line);
    CHECK(objections_to(missing) == 1);
    CHECK(objections_to(with(line, kPage[line])) == 1);
    CHECK(objections_to(changed(line, kPage[line] + " ")) == 1);
  }
  CHECK(objections_to(changed(2, "2. for a tone of amplitude 10")) == 1);
  CHECK(objections_to(changed(6, "- **PROVED** (1 to 3): the error stays below 3 for ever.")) == 1);
  CHECK(objections_to(changed(6, "- **PROVED** (1, 2): the error stays below 3 for ever.")) == 1);
  CHECK(objections_to(changed(7, "- **PROVED** (1 to 3): a set contains errors up to 2.")) == 1);
  Lines swapped = kPage;
  std::swap(swapped[3], swapped[4]);
  CHECK(objections_to(swapped) == 1);
}

TEST_CASE("nothing is added to the list, in whatever form a reader takes for a line of it") {
  for (const char* added :
       {"5. or without any", "5) or without any", "   5. or without any", "1. In double precision",
        "- **PROVED** (1): all is well.", "  - **PROVED**: all is well.", "* **PROVED**: all is well.",
        "All of these are examples.", "- or without any", "> quoted", "### Then", "  or any other"}) {
    for (std::size_t line = 1; line <= kPage.size(); ++line) {  // right behind it, too
      CAPTURE(line);
      CHECK_MESSAGE(objections_to(with(line, added)) == 1, std::string(added));
    }
  }
}

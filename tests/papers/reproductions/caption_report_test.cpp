#include "papers/reproductions/caption_report.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace veritrack::reports {
namespace {

struct Printed {
  const char* id;
  const char* digits;
};
/// The captions once more, from the paper.
constexpr std::array<Printed, 12> kPaper{{{"praly/figure-1/mean", "1.9999"},
                                          {"praly/figure-1/deviation", "0.0947"},
                                          {"praly/figure-2/mean", "2.0"},
                                          {"praly/figure-2/deviation", "0.0108"},
                                          {"praly/figure-3/mean", "2.0"},
                                          {"praly/figure-3/deviation", "0.0011"},
                                          {"praly/figure-4/mean", "2.9956"},
                                          {"praly/figure-4/deviation", "0.1164"},
                                          {"praly/figure-5/mean", "3.0"},
                                          {"praly/figure-5/deviation", "0.0142"},
                                          {"praly/figure-6/mean", "3.0"},
                                          {"praly/figure-6/deviation", "0.0014"}}};

TEST_CASE("the twelve captions come out in the window found, and none with the printed ell") {
  const Findings findings = reproduce_figures_1_6(8, {});
  for (const Printed& each : kPaper) {
    CAPTURE(each.id);
    const auto entry = std::find_if(findings.entries.begin(), findings.entries.end(),
                                    [&](const Entry& candidate) { return candidate.id == each.id; });
    REQUIRE(entry != findings.entries.end());
    CHECK(entry->printed == each.digits);
    CHECK(entry->verdict == EntryVerdict::agrees);
  }
  const Entry& ell = findings.entries.back();
  CHECK(ell.id == "praly/section-v/ell");
  CHECK(ell.printed == "5");
  CHECK(ell.ours.find("with it 0 of the 12 come out") == 0);
  CHECK(ell.verdict == EntryVerdict::does_not_agree);
}

TEST_CASE("the document says that the window was searched for, and what others give") {
  const std::string text = reproduce_figures_1_6(8, {}).markdown;
  CHECK(text.find("t from 5.687 to 25.674 s, with the disturbance in one phase, 6.109 rad") !=
        std::string::npos);
  CHECK(text.find("The paper names neither window nor phase: a search") != std::string::npos);
  CHECK(text.find("With the printed ℓ = 5, none of the twelve come out") != std::string::npos);
  CHECK(
      text.find("In 8 other choices, drawn, 7 to 8 of the twelve come out, all twelve in none; over a whole "
                "period of the disturbed signal 8.") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports

// The list at the top of a document.
#include "certificates/document/first_page.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

namespace veritrack::certificates {
namespace {

using rigor::Verdict;

Claim claim(const std::string& hypotheses, const std::string& conclusion, Verdict verdict = Verdict::proved,
            const std::string& reason = "") {
  Claim one;
  one.id = "a/b";
  one.hypotheses = hypotheses;
  one.statement = hypotheses + conclusion;
  one.verdict = verdict;
  one.reason = reason;
  return one;
}

const std::string kTone = "In exact arithmetic, on a tone of amplitude 1 with any frequency in [1, 2]";

TEST_CASE("hypotheses are listed once, and claims name those that they rest on") {
  const Claim bound = claim(kTone + ", with noise below 0.1, started in the set \"a\"", ", it stays below 3.",
                            Verdict::proved, "It lies in a set.");
  const Claim limit = claim(kTone, ", it tolerates noise up to 4.");
  CHECK(first_page({&bound, &limit}) ==
        "**Assume** (each claim below names those that it rests on)\n\n1. In exact arithmetic\n2. on a tone "
        "of amplitude 1 with any frequency in [1, 2]\n3. "
        "with noise below 0.1\n4. started in the set \"a\"\n\n**Then**\n\n- **PROVED** (1 to 4): it stays "
        "below 3.\n  Why: It lies in a set.\n- **PROVED** (1, 2): it tolerates noise up to 4.\n\n");
}

TEST_CASE("what is undecided comes first, as a sentence, and what names no hypotheses last") {
  const Claim open = claim(kTone, ", it stays below 2.", Verdict::undecided, "No set was found.");
  const Claim limit = claim(kTone + ", without noise, ", "it is still.", Verdict::refuted);
  const Claim plain = claim("", "It is so.", Verdict::proved, "By this.");
  CHECK(first_page({&plain, &limit, &open}) ==
        "**UNDECIDED**: " + kTone +
            ", it stays below 2.\n\nWhy not: No set was found.\n\n**Assume** (each claim below names those "
            "that it rests on)\n\n1. In exact arithmetic\n2. "
            "on a tone of amplitude 1 with any frequency in [1, 2]\n3. without noise\n\n**Then**\n\n- "
            "**REFUTED** (1 to 3): it is still.\n\n**PROVED**: It is so.\n\nWhy: By this.\n\n");
  CHECK(first_page({}).empty());
}

TEST_CASE("the ground of what is required stands in the table of requirements") {
  Claim asked = claim(kTone, ", it is.", Verdict::proved, "The bound is 1.");
  asked.required = true;
  CHECK(first_page({&asked}).find("Why") == std::string::npos);
}

TEST_CASE("a claim that does not begin with its hypotheses is a mistake of the program") {
  Claim wrong = claim(kTone, ", it is.");
  wrong.statement = "It is.";
  CHECK_THROWS_AS((void)first_page({&wrong}), std::logic_error);
}

}  // namespace
}  // namespace veritrack::certificates

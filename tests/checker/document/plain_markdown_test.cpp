// What a document may contain outside its quotations, and what it may not.
#include "checker/document/plain_markdown.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace veritrack::checker;

namespace {

bool allows(const std::string& line) {
  return !PlainMarkdown().objection_to(line).has_value();
}

bool allows_together(const std::vector<std::string>& lines) {
  PlainMarkdown document;
  bool allowed = true;
  for (const std::string& line : lines) {
    allowed = !document.objection_to(line) && allowed;
  }
  return allowed;
}

}  // namespace

TEST_CASE("what the program writes is allowed") {
  for (const char* line :
       {"", "## The design", "- a list: `code`, **bold**, *told*.",
        "| `a` | $`\\vert x \\vert  \\le 1`$ | \u2208 [1, 2] | \u2014 |", "| --- | --- |",
        "![a title \\[Hz\\]](figures/error.svg)", "*a caption*",
        "Beside [certificate.md](certificate.md), for it.",
        "p q \\>= b\\_2/b\\_1, a \\| b \\& c, k < 1, < 2 and & so on", "``a `tick` in code``",
        "It is proved; REFUTE it, or PROVE it.", "Proved bounds: at most 0.1",
        "P(0\\|0) from 0.98 M to 1.01 M", "1. not a verdict", "> a quotation", "x: y: z, at 10:30",
        "for what is under [assume]: a start", "- in [0.1, 0.2]: 3"}) {
    CHECK_MESSAGE(allows(line), std::string(line));
  }
}

TEST_CASE("no word of a verdict is seen, however it is written") {
  for (const char* line : {"PROVED",
                           "REFUTED",
                           "is PROVED.",
                           "P**ROV**ED",
                           "*PRO*VED",
                           "_PRO_VED",
                           "PR`OV`ED",
                           "`PROVED`",
                           "``PROVED``",
                           "[PRO](#x)VED",
                           "[PROVED](a.md)",
                           "P R O V E D",
                           "P.R.O.V.E.D",
                           "| PRO | VED |",
                           "PR0VED",
                           "pROVED",
                           "PROV\u03b5D",
                           "PRO\\_VED",
                           "PRO\\*VED",
                           "$`\\text{PRO}\\text{VED}`$",
                           "$`\\mathrm{P}ROVED`$",
                           "$`P`$ROVED",
                           "$`P\\, R\\; O V_E D`$",
                           "![PROVED](a.svg)",
                           "REFU-TED",
                           "(REFUT)ED",
                           "RefuTED"}) {
    CHECK_MESSAGE(!allows(line), std::string(line));
  }
  CHECK_FALSE(allows_together({"| P |", "| R |", "| O |", "| V |", "| E |", "| D |"}));
  CHECK_FALSE(allows_together({"PRO", "", "VED"}));
  CHECK(allows_together({"PRO", "and", "VED"}));
  PlainMarkdown document;
  CHECK_FALSE(document.objection_to("PRO"));
  document.skip_line();
  CHECK_FALSE(document.objection_to("VED"));
}

TEST_CASE("what may show something else than its letters is refused") {
  for (const char* line : {"PR\u041eVED",
                           "a\u200bb",
                           "a\u00adb",
                           "\u2066a",
                           "\ufeffa",
                           "\u03a1",
                           "caf\u00c9",
                           "\xff",
                           "a\tb",
                           "a\rb",
                           "<b>a</b>",
                           "</div>",
                           "<!-- a -->",
                           "<details>",
                           "<https://a.b>",
                           "<?a?>",
                           "a<br>b",
                           "PRO&zwj;VED",
                           "&#69;",
                           "&amp;",
                           "R&D",
                           "REF\\UTED",
                           "a\\",
                           "~~a~~",
                           "~~~",
                           "`open",
                           "``open`",
                           "`a $ b`",
                           "$5",
                           "$x$",
                           "$`open",
                           "$`a ` b`$",
                           "$`\\uppercase{a}`$",
                           "$`\\href{a}{b}`$",
                           "$`\\def`$",
                           "$`a % b`$",
                           "$`\\char 80`$",
                           "$`\\unicode{x}`$",
                           "$`\\5`$",
                           "[a](https://b.c)",
                           "[a](javascript:b)",
                           "[a](b \"c\")",
                           "[a](b",
                           "[a]: b",
                           "- [a]: b",
                           "a]: b",
                           "> [a b]: c",
                           "  1. [a]: b",
                           "[^1]",
                           "a ![b](c.svg)",
                           "![a](https://b.c/d.svg)",
                           ":o:",
                           "a :x: b",
                           "  ```",
                           "- ```"}) {
    CHECK_MESSAGE(!allows(line), std::string(line));
  }
}

TEST_CASE("between fences a line is what it is") {
  PlainMarkdown document;
  CHECK_FALSE(document.objection_to_fenced("x1' = <b> & \\ ~ ` $ [a]: b", false));
  CHECK(document.objection_to_fenced("PROVED", false).has_value());
  CHECK(PlainMarkdown().objection_to_fenced("PR\u041eVED", false).has_value());
  CHECK_FALSE(PlainMarkdown().objection_to_fenced("\\frac{1}{2} \\le \\kappa \\\\", true));
  CHECK(PlainMarkdown().objection_to_fenced("\\require{html}", true).has_value());
}

TEST_CASE("a quotation is one line") {
  CHECK(quotation_of("a *b*", "") == "> a \\*b\\*");
  CHECK(quotation_of("a\nb", "c`d") == "> a b, from: c\\`d");
}

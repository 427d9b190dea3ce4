#include "checker/document/markdown_file.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack::checker;

namespace {

Verification verified_document() {
  Verification found;
  found.parts = {{"design", {}}, {"a", {}}, {"verdict", {}}, {"read", {}}};
  found.sentences = {{"a/b", Verdict::proved, "It is so.", true},
                     {"c/d", Verdict::refuted, "It is not so.", false}};
  found.requirements = {{"a/b", "it must be so", Verdict::proved},
                        {"e/f", "it must be more", Verdict::undecided}};
  return found;
}

const std::string kHash = "0123";
const std::string kDocument = R"(# NOT PROVED. PROVED: it must be so; UNDECIDED: it must be more

**PROVED**: It is so.

**UNDECIDED**: It might be more.

## What was required

| Requirement | Verdict | Ground |
| --- | --- | --- |
| it must be so | **PROVED** | by this |
| it must be more | **UNDECIDED** | who knows |

## What the checker verifies

certificate.json, 0123

- **PROVED** `a/b`: It is so.
- **REFUTED** `c/d`: It is not so.

## The rest
- **PROVED** nothing of this is compared
)";

std::size_t objections_to(const std::string& document) {
  Objections objections;
  compare_with_markdown(verified_document(), kHash, document, objections);
  return objections.size();
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kDocument;
  text.replace(text.find(from), from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("a document that says what was verified is accepted") {
  CHECK(objections_to(kDocument) == 0);
}

TEST_CASE("every verdict of the document is compared") {
  CHECK(objections_to(changed("NOT PROVED. ", "")) == 1);
  CHECK(objections_to(changed("UNDECIDED: it", "PROVED: it")) == 1);
  CHECK(objections_to(changed("**PROVED**: It is so.", "**PROVED**: It is much so.")) == 1);
  CHECK(objections_to(changed("**UNDECIDED**: It might", "**PROVED**: It might")) == 1);
  CHECK(objections_to(changed("**PROVED**: It is so.\n", "")) == 1);
  CHECK(objections_to(changed("| it must be more | **UNDECIDED** |", "| it must be more | **PROVED** |")) ==
        1);
  CHECK(objections_to(changed("| it must be so | **PROVED** | by this |\n", "")) == 1);
  CHECK(objections_to(changed("- **REFUTED** `c/d`", "- **PROVED** `c/d`")) == 1);
  CHECK(objections_to(changed("- **REFUTED** `c/d`: It is not so.\n", "")) == 1);
  CHECK(objections_to(changed("0123", "4567")) == 1);
  CHECK(objections_to("") == 5);
}

TEST_CASE("where nothing is required the headline says so") {
  Verification found = verified_document();
  found.requirements.clear();
  CHECK(headline(found) == "# Nothing is required of this design");
}

#include "checker/document/markdown_file.hpp"

#include <doctest/doctest.h>

#include <string>

#include "checker/document/sha256.hpp"

using namespace veritrack::checker;

namespace {

const std::string kDesign = "# It shall be PROVED\nname = 1\n";

Verification verified_document() {
  Verification found;
  found.parts = {{"design", {}}, {"a", {}}, {"verdict", {}}, {"read", {}}};
  found.sentences = {{"a/b", Verdict::proved, "It is so.", true},
                     {"c/d", Verdict::refuted, "It is not so.", false},
                     {"theorem-1/conditions", Verdict::refuted, "The theorem applies.", false}};
  found.requirements = {{"a/b", "it must be so", Verdict::proved},
                        {"e/f", "it must be more", Verdict::undecided}};
  found.design_sha256 = sha256(kDesign);
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

- **REFUTED** `c/d`: It is not so.

## The rest
Told, with no verdict.

```toml
)" + kDesign + "```\n";

const std::string kPublished = R"(# What published theorems say of this design

## What the checker verifies

certificate.json, 0123

- **REFUTED** `theorem-1/conditions`: The theorem applies.

## More
- told: not satisfied
)";

std::size_t objections_to(const std::string& document) {
  Objections objections;
  compare_with_markdown(verified_document(), kHash, document, objections);
  return objections.size();
}

std::string changed(const std::string& from, const std::string& to, const std::string& document = kDocument) {
  std::string text = document;
  text.replace(text.find(from), from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("a document that says what was verified is accepted") {
  CHECK(objections_to(kDocument) == 0);
}

// A verdict that is not the verified one is also one that stands where none is known.
TEST_CASE("every verdict of the document is compared") {
  CHECK(objections_to(changed("NOT PROVED. ", "")) == 1);
  CHECK(objections_to(changed("UNDECIDED: it", "PROVED: it")) == 1);
  CHECK(objections_to(changed("**PROVED**: It is so.", "**PROVED**: It is much so.")) == 2);
  CHECK(objections_to(changed("**UNDECIDED**: It might", "**PROVED**: It might")) == 2);
  CHECK(objections_to(changed("**PROVED**: It is so.\n", "")) == 1);
  CHECK(objections_to(changed("| it must be more | **UNDECIDED** |", "| it must be more | **PROVED** |")) ==
        2);
  CHECK(objections_to(changed("| it must be so | **PROVED** | by this |\n", "")) == 1);
  CHECK(objections_to(changed("- **REFUTED** `c/d`", "- **PROVED** `c/d`")) == 2);
  CHECK(objections_to(changed("- **REFUTED** `c/d`: It is not so.\n", "")) == 1);
  CHECK(objections_to(changed("0123", "4567")) == 1);
  CHECK(objections_to("") == 5);
}

TEST_CASE("no verdict stands where it is not compared") {
  CHECK(objections_to(changed("Told, with no verdict.", "**PROVED**: It is perfect.")) == 1);
  CHECK(objections_to(changed("Told, with no verdict.", "PROVED, too: it is perfect.")) == 1);
  CHECK(objections_to(changed("Told, with no verdict.", "| it must be cheap | **PROVED** | surely |")) == 1);
  CHECK(objections_to(changed("It might be more.", "It might be more, as is PROVED.")) == 1);
  CHECK(objections_to(changed("by this", "by this; PROVED for all")) == 1);
  CHECK(objections_to(changed("# It shall be PROVED", "# It is PROVED")) == 1);  // not the design file's text
  CHECK(objections_to(changed("name = 1\n```", "name = 1\n```\nPROVED")) == 1);
  CHECK(objections_to(changed("certificate.json, 0123", "certificate.json, 0123\n\n```\nPROVED\n```")) == 1);
  for (const char* hidden : {"It is PROV&#69;D.", "It is PRO**VED**.", "It is PRO<b>VED</b>.",
                             "It is REF\\UTED.", "k < 3, and it is PRO*VED*.", "It is PRO&zwj;VED.",
                             "It is PRO\u200bVED.", "It is PRO<!--\n-->VED.", "It is PRO<b\n>VED."}) {
    CHECK(objections_to(changed("Told, with no verdict.", hidden)) == 1);
  }
}

TEST_CASE("a section and a table with verdicts are there once, and nothing else is in them") {
  const auto added = [](const std::string& text) {
    return changed("## The rest\n", text + "\n## The rest\n");
  };
  for (const char* second :
       {"## What was required\n", "### What was required\n", "## What was **required**\n",
        "## What was required, too\n", "# What the checker verifies\n", "## What the `checker` verifies\n",
        "| Requirement | Verdict |\n| --- | --- |\n| it must be cheap | yes |\n",
        "|**Requirement**|Verdict|\n", "Requirement | Verdict\n--- | ---\n"}) {
    CHECK_MESSAGE(objections_to(added(second)) == 1, std::string(second));
  }
  for (const char* row :
       {"| it must be cheap | yes | surely |", "|it must be cheap|yes|", "it must be cheap"}) {
    CHECK_MESSAGE(objections_to(changed("| by this |\n", "| by this |\n" + std::string(row) + "\n")) == 1,
                  row);
  }
  // A sentence in the place of another one.
  CHECK(objections_to(changed("Told, with no verdict.", "**PROVED**: It is so.")) == 1);
  CHECK(objections_to(changed("Told, with no verdict.", "| it must be so | **PROVED** | by this |")) == 1);
}

TEST_CASE("the sentences with verdicts are the first thing that is seen") {
  const auto before = [](const std::string& text) {
    return changed("\n\n**PROVED**", "\n\n" + text + "\n\n**PROVED**");
  };
  CHECK(objections_to(before("*Stopped by the time limit.* More is possible.")) == 0);
  CHECK(objections_to(before("")) == 0);
  for (const char* first :
       {"All is well.", "> It is so.", "- It is so.", "| It is so. |", "![a](b.svg)", "### More"}) {
    CHECK_MESSAGE(objections_to(before(first)) == 1, std::string(first));
  }
  for (const char* front : {"\n", "\ufeff", " ", "[x]: y\n", "<div>\n", "## More\n"}) {
    CHECK_MESSAGE(objections_to(front + kDocument) >= 1, std::string(front));
  }
}

TEST_CASE("where no sentence is verified the document may begin with words of its own") {
  const Verification nothing;
  Objections objections;
  compare_with_markdown(nothing, "abc", headline(nothing) + "\n\nNothing was proved.\n\nSHA-256 `abc`\n",
                        objections);
  CHECK(objections.empty());
}

TEST_CASE("what is quoted ends where its quotation does") {
  Verification verified = verified_document();
  verified.quoted = {"Пример, *PROVED*", "Präly <b>"};
  const auto objections = [&](const std::string& text) {
    Objections found;
    compare_with_markdown(verified, kHash, changed("Told, with no verdict.", text), found);
    return found.size();
  };
  CHECK(objections("> Пример, \\*PROVED\\*, from: Präly \\<b\\>\n") == 0);
  CHECK(objections("> Пример, \\*PROVED\\*\n") == 0);
  CHECK(objections("> Пример, \\*PROVED\\*\nIt goes on.") == 1);
  CHECK(objections("Пример, \\*PROVED\\*\n") == 1);
  CHECK(objections("> Пример, *PROVED*\n") == 1);
  CHECK(objections("> Another\n") == 0);
  // The text of the design file is one of any letters, between fences that nothing in it ends.
  const std::string design = "# ПРOVED, <b> & ~\n```\n";
  verified.design_sha256 = sha256(design);
  const auto with_design = [&](const std::string& fence) {
    Objections found;
    const std::string block = fence + "toml\n" + design + fence + "\n";
    compare_with_markdown(verified, kHash, changed("```toml\n" + kDesign + "```\n", block), found);
    return found.size();
  };
  CHECK(with_design("````") == 0);
  CHECK(with_design("```") >= 1);
  CHECK(objections_to(changed("```toml", "```mermaid")) == 1);
  CHECK(objections_to(changed("```toml", "~~~toml")) >= 1);
  CHECK(objections_to(kDocument.substr(0, kDocument.size() - 4)) == 1);
}

TEST_CASE("published theorems have a document of their own") {
  CHECK(objections_to(kPublished) == 0);
  CHECK(objections_to(changed("- **REFUTED** `theorem", "- **PROVED** `theorem", kPublished)) == 2);
  CHECK(objections_to(
            changed("- **REFUTED** `theorem-1/conditions`: The theorem applies.\n", "", kPublished)) == 1);
  CHECK(objections_to(changed("- told: not satisfied", "- told: REFUTED", kPublished)) == 1);
  CHECK(objections_to(changed("0123", "4567", kPublished)) == 1);
  CHECK(objections_to(changed("\n## What the", "\n**PROVED**: It is so.\n\n## What the", kPublished)) == 2);
  // A sentence of one in the other.
  CHECK(objections_to(changed("- **REFUTED** `c/d`: It is not so.",
                              "- **REFUTED** `theorem-1/conditions`: The theorem applies.")) == 2);
}

TEST_CASE("where nothing is required the headline says so") {
  Verification found = verified_document();
  found.requirements.clear();
  CHECK(headline(found) == "# Nothing is required of this design");
}

TEST_CASE("what is refuted though nobody asked is in the headline, once it is refuted") {
  Verification found = verified_document();
  const std::string before = headline(found);
  found.sentences.push_back({"a/finding", Verdict::undecided, "It is stable.", true, "", "it is stable"});
  CHECK(headline(found) == before);
  found.sentences.back().verdict = Verdict::refuted;
  CHECK(headline(found).find("REFUTED: it is stable; ") != std::string::npos);
  found.requirements.clear();
  CHECK(headline(found) == "# Nothing is required of this design. REFUTED: it is stable");
}

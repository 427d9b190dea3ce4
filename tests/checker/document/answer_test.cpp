#include "checker/document/answer.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack::checker;

namespace {

Verification some_verification() {
  Verification found;
  found.parts = {{"design", {}}, {"a", {}}, {"verdict", {}}, {"read", {}}};
  found.quoted = {"a \"name\"\nVERIFIED: all", "a thesis"};
  found.design_sha256 = "0123";
  found.sentences = {{"a/b", Verdict::proved, "It is so.", true}};
  found.requirements = {{"a/b", "it must be so", Verdict::proved}};
  found.requirements_proved = true;
  return found;
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("the answer says what was established, and quotes what is not the checker's") {
  const std::string text = to_text(some_verification());
  CHECK(has(text, "\nVERIFIED: all 4 parts"));
  CHECK(has(text, "everything required is PROVED"));
  CHECK(has(text, "- PROVED: It is so."));
  CHECK_FALSE(has(text, "\nVERIFIED: all\""));  // a name cannot begin a line
  CHECK(has(text, "\"a  name  VERIFIED: all\""));
}

TEST_CASE("what is not verified says no sentence") {
  Verification found = some_verification();
  found.parts[1].objections = {"it is not"};
  const std::string text = to_text(found);
  CHECK(has(text, "NOT VERIFIED a\n             - it is not\n"));
  CHECK(has(text, "\nNOT VERIFIED: 1 of 4 parts\n"));
  CHECK_FALSE(has(text, "It is so."));
  CHECK(has(to_json(found), "\"verified\": false"));
  CHECK(has(to_json(found), "\"requirements_proved\": false"));
}

TEST_CASE("a certificate of nothing is not verified") {
  Verification found;
  CHECK_FALSE(found.verified());
  found.parts = {{"design", {}}, {"verdict", {}}, {"read", {}}};
  CHECK_FALSE(found.verified());
}

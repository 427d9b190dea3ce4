#include "checker/document/parts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace veritrack::checker;

namespace {

std::string claim(const std::string& id, const std::string& verdict, bool required) {
  return R"({"id": ")" + id + R"(", "verdict": ")" + verdict + R"(", "required": )" +
         (required ? "true" : "false") + "}";
}

/// The claims as the certificate has them; those whose id is "wrong" are objected to.
Verification checked(const std::string& claims, const std::string& verdict,
                     const std::vector<std::string>& asked) {
  const Tree certificate = read_json(R"({"claims": [)" + claims + R"(], "verdict": ")" + verdict + R"("})");
  Verification result;
  std::vector<Requirement> requirements;
  for (const std::string& id : asked) {
    requirements.push_back({id, "it must be " + id});
  }
  const auto check = [](const Tree& tree, Objections& objections) {
    if (tree.at("id").text() == "wrong") {
      objections.emplace_back("wrong");
    }
    return Claim{"a sentence", verdict_from(tree.at("verdict").text()), {}, false};
  };
  check_claims(certificate, requirements, check, result);
  CHECK(result.parts.size() == certificate.at("claims").elements().size() + 1);
  return result;
}

/// Nothing is objected to.
bool all_is_well(const std::string& claims, const std::string& verdict,
                 const std::vector<std::string>& asked) {
  const Verification result = checked(claims, verdict, asked);
  return std::all_of(result.parts.begin(), result.parts.end(),
                     [](const Part& part) { return part.objections.empty(); });
}

}  // namespace

TEST_CASE("the verdict is that of the required claims together, undecided where one is not there") {
  const std::string proved = claim("a", "proved", true);
  const std::string refuted = claim("b", "refuted", true);
  CHECK(all_is_well(proved, "proved", {"a"}));
  CHECK(all_is_well(proved + "," + refuted, "refuted", {"b", "a"}));
  CHECK_FALSE(all_is_well(proved, "undecided", {"a"}));
  CHECK_FALSE(all_is_well(proved + "," + refuted, "proved", {"a", "b"}));
  CHECK_FALSE(all_is_well(proved, "nothing-required", {"a"}));
  CHECK_FALSE(all_is_well(proved, "proved", {"a", "b"}));
  CHECK(all_is_well(proved, "undecided", {"a", "b"}));
  CHECK(checked(proved, "proved", {"a"}).requirements_proved);
  CHECK_FALSE(checked(proved, "undecided", {"a", "b"}).requirements_proved);
  CHECK_FALSE(checked(proved + "," + refuted, "refuted", {"b", "a"}).requirements_proved);
}

TEST_CASE("what is required is what the design requires, once, and what is objected to decides nothing") {
  CHECK_FALSE(all_is_well(claim("a", "proved", false), "proved", {"a"}));
  CHECK_FALSE(all_is_well(claim("a", "proved", true), "nothing-required", {}));
  CHECK_FALSE(all_is_well(claim("a", "proved", true) + "," + claim("a", "proved", true), "proved", {"a"}));
  const Verification wrong = checked(claim("wrong", "proved", true), "proved", {"wrong"});
  CHECK(wrong.sentences.empty());
  CHECK_FALSE(wrong.requirements_proved);
  CHECK_FALSE(wrong.parts.back().objections.empty());
}

TEST_CASE("nothing required is no verdict") {
  CHECK(all_is_well(claim("a", "refuted", false), "nothing-required", {}));
  CHECK_FALSE(all_is_well(claim("a", "proved", false), "proved", {}));
  CHECK_FALSE(checked("", "nothing-required", {}).requirements_proved);
}

TEST_CASE("a certificate of nothing, or with a part that is objected to, is not verified") {
  Verification found;
  CHECK_FALSE(found.verified());
  found.parts = {{"design", {}}, {"verdict", {}}, {"every member is read", {}}};
  CHECK_FALSE(found.verified());
  found.parts.push_back({"contraction", {}});
  CHECK(found.verified());
  found.parts.push_back({"other", {"wrong"}});
  CHECK_FALSE(found.verified());
}

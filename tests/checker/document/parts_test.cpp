#include "checker/document/parts.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack::checker;

namespace {

std::string claim(const std::string& id, const std::string& verdict, bool required) {
  return R"({"id": ")" + id + R"(", "verdict": ")" + verdict + R"(", "required": )" +
         (required ? "true" : "false") + "}";
}

/// What is said of the verdict when the claims whose id is "wrong" are objected to.
Objections on_verdict(const std::string& claims, const std::string& verdict,
                      const std::vector<std::string>& asked) {
  const Tree certificate = read_json(R"({"claims": [)" + claims + R"(], "verdict": ")" + verdict + R"("})");
  Verification result;
  const auto check = [](const Tree& tree, Objections& objections) {
    if (tree.at("id").text() == "wrong") {
      objections.emplace_back("wrong");
    }
  };
  check_claims(certificate, asked, check, result);
  CHECK(result.parts.size() == certificate.at("claims").elements().size() + 1);
  return result.parts.back().objections;
}

}  // namespace

TEST_CASE("the verdict is that of the required claims together") {
  const std::string proved = claim("a", "proved", true);
  const std::string refuted = claim("b", "refuted", true);
  CHECK(on_verdict(proved, "proved", {"a"}).empty());
  CHECK(on_verdict(proved + "," + refuted, "refuted", {"b", "a"}).empty());
  CHECK(on_verdict(proved, "undecided", {"a"}).empty());
  CHECK(!on_verdict(proved + "," + refuted, "proved", {"a", "b"}).empty());
  CHECK_THROWS_AS((void)on_verdict(proved, "nothing-required", {"a"}), Malformed);
}

TEST_CASE("what was asked for must have its claim, and be verified") {
  CHECK(!on_verdict(claim("a", "proved", true), "proved", {"a", "b"}).empty());
  CHECK(!on_verdict(claim("a", "proved", false), "nothing-required", {"a"}).empty());
  CHECK(!on_verdict(claim("a", "proved", true) + "," + claim("a", "proved", true), "proved", {"a"}).empty());
  CHECK(!on_verdict(claim("wrong", "proved", true), "proved", {"wrong"}).empty());
  CHECK(on_verdict(claim("wrong", "proved", false) + "," + claim("a", "proved", true), "proved", {"a"})
            .empty());
}

TEST_CASE("nothing required is no verdict") {
  CHECK(on_verdict(claim("a", "refuted", false), "nothing-required", {}).empty());
  CHECK(!on_verdict(claim("a", "proved", false), "proved", {}).empty());
  CHECK(on_verdict("", "nothing-required", {}).empty());
}

TEST_CASE("a certificate without parts, or with one that is objected to, is not verified") {
  CHECK(!Verification{}.verified());
  CHECK(Verification{{{"part", {}}}}.verified());
  CHECK(!Verification{{{"part", {}}, {"other", {"wrong"}}}}.verified());
}

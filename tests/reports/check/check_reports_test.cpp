#include "reports/check/check_reports.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

namespace {

using namespace veritrack;
using namespace veritrack::reports;

std::vector<CheckedDesign> examples() {
  return {{"a b.toml",
           {{"x/proved", "this", "because", rigor::Verdict::proved, {3, 1}},
            {"x/refuted", "that", "a < b, & c: 50 %", rigor::Verdict::refuted, {4, 2}}},
           std::nullopt,
           0.5},
          {"c.toml", {}, std::nullopt},
          {"d.toml", {}, CheckObjection{CheckObjection::Kind::time_limit, "stopped", {}}}};
}

TEST_CASE("a path is a reference with its special characters encoded") {
  CHECK(uri_of("designs/x-1_2~.toml") == "designs/x-1_2~.toml");
  CHECK(uri_of("a:b c%\xC3\xA9") == "a%3Ab%20c%25%C3%A9");
}

TEST_CASE("an annotation for what is not proved, with the characters that end it encoded") {
  CHECK(to_annotations(examples()[0]) ==
        "::error file=a b.toml,line=4,col=2,title=refuted::that. a < b, & c: 50 %25\n");
  CHECK(to_annotations(examples()[1]).empty());
  CHECK(to_annotations(examples()[2]) == "::error file=d.toml,title=time-limit::stopped\n");
}

TEST_CASE("JUnit counts failures and errors, and escapes") {
  const std::string text = to_junit(examples());
  CHECK(text.find("<testsuite name=\"a b.toml\" tests=\"2\" failures=\"1\" errors=\"0\" time=\"0.500\">") !=
        std::string::npos);
  CHECK(text.find("<failure type=\"refuted\" message=\"a &lt; b, &amp; c: 50 %\"/>") != std::string::npos);
  CHECK(text.find("<error type=\"time-limit\" message=\"stopped\"/>") != std::string::npos);
}

TEST_CASE("what has to require something and does not is in every report, and is a failure of the design") {
  const std::vector<CheckedDesign> designs{
      {"a.toml", {}, CheckObjection{CheckObjection::Kind::nothing_required, "nothing", {}}}};
  CHECK(to_junit(designs).find("tests=\"1\" failures=\"1\" errors=\"0\"") != std::string::npos);
  CHECK(to_junit(designs).find("<failure type=\"nothing-required\" message=\"nothing\"/>") !=
        std::string::npos);
  CHECK(to_annotations(designs[0]) == "::error file=a.toml,title=nothing-required::nothing\n");
  CHECK(nlohmann::json::parse(to_sarif(designs)).at("runs").at(0).at("results").size() == 1);
  const auto report = nlohmann::json::parse(to_check_json(designs));
  CHECK(report.at("exit_status") == 1);
  CHECK(report.at("designs").at(0).at("verdict") == "nothing-required");
  CHECK(report.at("designs").at(0).at("error").at("kind") == "nothing-required");
}

TEST_CASE("every kind of objection that makes the exit status 1 or 2 is in every report") {
  using Kind = CheckObjection::Kind;
  for (const Kind kind : {Kind::bad_input, Kind::failure, Kind::time_limit, Kind::not_verified,
                          Kind::nothing_required, Kind::cannot_write}) {
    const std::vector<CheckedDesign> designs{{"a.toml", {}, CheckObjection{kind, "why", {}}}};
    const std::string name = to_string(kind);
    INFO(name);
    CHECK(exit_status_of(designs) > 0);
    CHECK(to_junit(designs).find("tests=\"1\"") != std::string::npos);
    CHECK(to_junit(designs).find("type=\"" + name + "\" message=\"why\"") != std::string::npos);
    CHECK(to_sarif(designs).find("\"ruleId\": \"" + name + "\"") != std::string::npos);
    CHECK(to_annotations(designs[0]).find("title=" + name + "::why") != std::string::npos);
    CHECK(to_check_json(designs).find("\"kind\": \"" + name + "\"") != std::string::npos);
  }
}

TEST_CASE("whether a design was verified is in JUnit and JSON, where it was asked") {
  std::vector<CheckedDesign> designs = examples();
  CHECK(to_junit(designs).find("verified") == std::string::npos);
  CHECK(to_check_json(designs).find("verified") == std::string::npos);
  note_verification(designs[0], "");
  note_verification(designs[1], "part 2 (why)");
  const std::string text = to_junit(designs);
  CHECK(text.find("<property name=\"verified\" value=\"true\"/>") != std::string::npos);
  CHECK(text.find("<property name=\"verified\" value=\"false\"/>") != std::string::npos);
  CHECK(text.find("<error type=\"not-verified\" message=\"part 2 (why)\"/>") != std::string::npos);
  const auto report = nlohmann::json::parse(to_check_json(designs));
  CHECK(report.at("designs").at(0).at("verified") == true);
  CHECK(report.at("designs").at(1).at("verified") == false);
  CHECK(report.at("designs").at(1).at("error").at("kind") == "not-verified");
  CHECK_FALSE(report.at("designs").at(2).contains("verified"));
  CHECK(nlohmann::json::parse(to_sarif(designs)).at("runs").at(0).at("results").at(1).at("ruleId") ==
        "not-verified");
}

TEST_CASE("SARIF has an error for each that is not proved") {
  const auto report = nlohmann::json::parse(to_sarif(examples()));
  const auto& results = report.at("runs").at(0).at("results");
  REQUIRE(results.size() == 2);
  CHECK(results.at(0).at("ruleId") == "x/refuted");
  CHECK(results.at(0).at("level") == "error");
  CHECK(results.at(1).at("ruleId") == "time-limit");
  CHECK_FALSE(results.at(1).at("locations").at(0).at("physicalLocation").contains("region"));
}

TEST_CASE("JSON has the designs in their order; nothing required is no verdict") {
  const auto report = nlohmann::json::parse(to_check_json(examples()));
  const auto& designs = report.at("designs");
  REQUIRE(designs.size() == 3);
  CHECK(designs.at(0).at("verdict") == "refuted");
  CHECK(designs.at(1).at("verdict") == "nothing-required");
  CHECK_FALSE(designs.at(2).contains("verdict"));
  CHECK(designs.at(2).at("error").at("kind") == "time-limit");
}

}  // namespace

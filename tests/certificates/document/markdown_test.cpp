#include "certificates/document/markdown.hpp"

#include <doctest/doctest.h>

#include <regex>

#include "tests/certificates/test_design.hpp"
#include "tests/support/golden.hpp"

namespace {

using namespace veritrack;

const certificates::MarkdownOptions kOptions{
    {{"figures/error.svg", "a title", "a caption"}}, "0123", "a program 1.0"};

/// Versions of software are as they are; and what is approximate may differ in its last digit between
/// machines.
std::string comparable(const std::string& document) {
  const std::string without_versions = std::regex_replace(
      document, std::regex("(\\| Software \\| Version \\|\n)(\\|[^\n]*\n)*"), "$1(versions)\n");
  return std::regex_replace(without_versions, std::regex("≈ [-+.0-9e]+"), "≈ (number)");
}

TEST_CASE("the document is the one that was looked at") {
  const std::string document = certificates::to_markdown(test::certificate(), kOptions);
  test::check_golden(comparable(document),
                     VERITRACK_SOURCE_DIR "/tests/certificates/golden/nothing-required.md");
  test::check_golden(comparable(certificates::to_published_markdown(test::certificate(), kOptions)),
                     VERITRACK_SOURCE_DIR "/tests/certificates/golden/published-theorems.md");
}

TEST_CASE("the first page says whether the certificate was verified, and nothing else depends on it") {
  using Outcome = certificates::Verification::Outcome;
  const std::string command =
      "\n\n```\nveritrack-verify certificate.json --full --design " + test::certificate().design_file +
      " --markdown certificate.md --markdown published-theorems.md\n```\n\n## What was required";
  const auto document = [](const certificates::Verification& verification) {
    certificates::MarkdownOptions options = kOptions;
    options.verification = verification;
    return certificates::to_markdown(test::certificate(), options);
  };
  const std::string left_out = document({});
  const std::string unsaid = "*Not verified* when this document was written. To verify it:";
  CHECK(left_out.find(unsaid + command) != std::string::npos);
  const std::string said = "*Verified* by `veritrack-verify` " VERITRACK_VERSION
                           ", which shares no code with the program that wrote this document. To repeat it:";
  std::string expected = left_out;
  expected.replace(expected.find(unsaid), unsaid.size(), said);
  CHECK(document({Outcome::verified, 8}) == expected);

  const std::string refused =
      document({Outcome::refused, 8, {{"the set *x*", {"a"}}, {"claim y", {"b", "c"}}}});
  CHECK(refused.starts_with("# NOT VERIFIED. Nothing is required of this design\n\n"));
  CHECK(refused.find(
            "*NOT VERIFIED*: `veritrack-verify` " VERITRACK_VERSION
            " refuses 2 of 8 parts: the set \\*x\\*; claim y. One of the two programs is wrong: rely on "
            "nothing in this document. To repeat it:" +
            command) != std::string::npos);
  const std::string silent = document({Outcome::refused, 0, {}, "it was ended by signal 9"});
  CHECK(silent.starts_with("# NOT VERIFIED. "));
  CHECK(silent.find("*NOT VERIFIED*: `veritrack-verify` " VERITRACK_VERSION " gave no answer. One of") !=
        std::string::npos);
}

TEST_CASE("the document has two pages") {
  constexpr std::size_t kTwoPages = 12000;
  CHECK(certificates::to_markdown(test::certificate(), kOptions).size() < kTwoPages);
}

TEST_CASE("the first line is the answer") {
  const auto first_line = [](const certificates::Certificate& certificate) {
    const std::string document = certificates::to_markdown(certificate, kOptions);
    return document.substr(0, document.find('\n'));
  };
  CHECK(first_line(test::certificate()) == "# Nothing is required of this design");
  CHECK(first_line(test::certificate({{"[require]", "[require]\nfrequency_error_below = 0.0051"}})) ==
        "# NOT PROVED. UNDECIDED: the frequency error stays below 0.0051 rad/sample for ever");
  CHECK(first_line(test::certificate({{"[require]", "[require]\nfrequency_error_below = 0.05"}})) ==
        "# PROVED: the frequency error stays below 0.05 rad/sample for ever");
}

TEST_CASE("the name of a design cannot forge a verdict") {
  certificates::Design design = test::design();
  design.name = "x\n# PROVED <b>everything</b>";
  const auto certificate = certificates::certify(design, "design.toml", test::design_text());
  const std::string document = certificates::to_markdown(certificate, kOptions);
  CHECK(document.find("\n# PROVED") == std::string::npos);
  CHECK(document.find("x \\# PROVED \\<b\\>everything") != std::string::npos);
}

TEST_CASE("nor can the name of its file, and a shell can take what is to be typed") {
  certificates::Certificate certificate = test::certificate();
  for (const char* name : {"PROVED.toml", "Pr0Ved.toml", "a design.toml", "a$(b).toml", "-\u00e9.toml"}) {
    certificate.design_file = name;
    CHECK(certificates::checking_command(certificate).find(" --design DESIGN --markdown") !=
          std::string::npos);
  }
  certificate.design_file = "designs/Motor_2.toml";
  CHECK(certificates::checking_command(certificate).find(" --design designs/Motor_2.toml --markdown") !=
        std::string::npos);
}

TEST_CASE("every table is rectangular") {
  for (const auto& certificate :
       {test::certificate(), test::certificate({{"q1 = 0.0023", "q1 = 0"}}),
        test::certificate({{"[require]", "[require]\nsettles_within = 9\nsettled_below = 0.01"}})}) {
    const std::string document = certificates::to_markdown(certificate, kOptions) +
                                 certificates::to_published_markdown(certificate, kOptions);
    std::size_t columns = 0;
    std::size_t start = 0;
    while (start < document.size()) {
      const std::size_t end = document.find('\n', start);
      const std::string line = document.substr(start, end - start);
      start = end + 1;
      std::size_t bars = 0;
      for (std::size_t i = 0; i < line.size(); ++i) {
        const bool separates = line[i] == '|' && (i == 0 || line[i - 1] != '\\');
        bars += separates ? std::size_t{1} : std::size_t{0};
      }
      if (line.empty() || line[0] != '|') {
        columns = 0;
      } else if (columns == 0) {
        columns = bars;
      } else {
        CHECK_MESSAGE(bars == columns, line);
      }
    }
  }
}

}  // namespace

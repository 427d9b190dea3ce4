#include "certificates/document/markdown.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/rigor/versions.hpp"
#include "certificates/document/markdown_formal_proofs.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

namespace {

using markdown::escaped;
using rigor::Verdict;

std::string upper_case(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 32) : letter;
  });
  return text;
}

std::string requirement_section(const Certificate& certificate) {
  std::string text = "## What was required\n\n";
  if (!certificate.verdict) {
    return text +
           "Nothing: the design file's `[require]` is empty. The document still gives everything that is "
           "certified for the design.\n\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      rows.push_back({claim.requirement, markdown::verdict(claim.verdict), claim.reason});
    }
  }
  return text + markdown::table({"Requirement", "Verdict", "Ground"}, rows) + "\n";
}

/// Every sentence of certificate.json as the checker composes it anew.
std::string checker_section(const Certificate& certificate, const MarkdownOptions& options) {
  std::string text = fmt::format(
      "## What the checker verifies\n\n`veritrack-verify certificate.json --markdown certificate.md` "
      "verifies the "
      "sentences below from the evidence in `certificate.json` (SHA-256 `{}`), and that this section, the "
      "verdicts at "
      "the top and what was required say just that. All else in this document is told: sampled values, "
      "simulations, "
      "comparisons and undecided statements prove nothing.\n\n",
      options.certificate_sha256);
  for (const Claim& claim : certificate.claims) {
    if (claim.verdict != Verdict::undecided) {
      text += fmt::format("- {} `{}`: {}\n", markdown::verdict(claim.verdict), claim.id, claim.statement);
    }
  }
  return text + "\n";
}

std::string reproduction_section(const Certificate& certificate, const MarkdownOptions& options) {
  std::string text = "## How to reproduce it\n\n";
  text += fmt::format("Save the design file below as `{}` and run\n\n", certificate.design_file);
  text += markdown::fenced(
      "veritrack certify " + certificate.design_file + (certificate.formal_proofs ? " --coq" : ""), "");
  text += certificate.deadline.has_struck()
              ? "\nThis run was stopped by the time limit of `--timeout`. Without it the same file gives the "
                "same bytes. "
              : "\nThe same file gives the same bytes. ";
  text +=
      "`certificate.json` beside this document contains every number "
      "with all its digits, as hexadecimal floats.\n\n";
  std::vector<std::vector<std::string>> rows{{"veritrack", VERITRACK_VERSION}};
  for (const auto& [name, version] : rigor::arithmetic_versions()) {
    rows.push_back({escaped(name), escaped(version)});
  }
  if (!options.drawn_with.empty()) {
    rows.push_back({"figures", escaped(options.drawn_with)});
  }
  text += markdown::table({"Software", "Version"}, rows) + "\n";
  return text + fmt::format("`{}`:\n\n", certificate.design_file) +
         markdown::fenced(certificate.design_text, "toml");
}

}  // namespace

std::string headline(const Certificate& certificate) {
  if (!certificate.verdict) {
    return "Nothing is required of this design";
  }
  std::string text;
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      text += text.empty() ? "" : "; ";
      text += upper_case(rigor::to_string(claim.verdict)) + ": " + claim.requirement;
    }
  }
  return (*certificate.verdict == Verdict::proved ? "" : "NOT PROVED. ") + text;
}

std::string to_markdown(const Certificate& certificate, const MarkdownOptions& options) {
  const TrackerKind& kind = kind_of(certificate.design);
  const std::string stopped = certificate.deadline.has_struck()
                                  ? "*Stopped by the time limit.* What is PROVED is proved; what was not "
                                    "reached in time is UNDECIDED, "
                                    "and another run may reach more or less.\n\n"
                                  : "";
  return "# " + headline(certificate) + "\n\n" + stopped + kind.summary(certificate) +
         requirement_section(certificate) + kind.sections(certificate, options) +
         checker_section(certificate, options) + formal_proofs_section(certificate) +
         reproduction_section(certificate, options);
}

}  // namespace veritrack::certificates

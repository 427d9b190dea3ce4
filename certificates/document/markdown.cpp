#include "certificates/document/markdown.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>

#include "analysis/rigor/versions.hpp"
#include "certificates/document/first_page.hpp"
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

/// Whether the claim is about a publication, not about the tracker: published-theorems.md has it. The checker
/// has the same rule (checker/document/markdown_file.cpp).
bool concerns_publication(const Claim& claim) {
  return claim.id.starts_with("theorem-") || claim.id.starts_with("proposition-") ||
         claim.id.ends_with("/conditions");
}

/// The decided sentences of that kind in the form that the checker composes, without those at the top.
std::string sentences(const Certificate& certificate, bool on_publications) {
  const std::vector<const Claim*> top = kind_of(certificate.design).answers(certificate);
  std::string text;
  for (const Claim& claim : certificate.claims) {
    if (claim.verdict != Verdict::undecided && concerns_publication(claim) == on_publications &&
        (on_publications || std::find(top.begin(), top.end(), &claim) == top.end())) {
      text += fmt::format("- {} `{}`: {}\n", markdown::verdict(claim.verdict), claim.id, claim.statement);
    }
  }
  return text + (text.empty() ? "" : "\n");
}

bool has_published(const Certificate& certificate) {
  const TrackerKind& kind = kind_of(certificate.design);
  return kind.published != nullptr && !kind.published(certificate).empty();
}

std::string checker_section(const Certificate& certificate, const MarkdownOptions& options) {
  return fmt::format(
             "## What the checker verifies\n\n`veritrack-verify certificate.json --markdown "
             "certificate.md{}` "
             "verifies the sentences at the top and those below from the evidence in `certificate.json` "
             "(SHA-256 `{}`), and that "
             "this document gives no verdict in capitals but those it verified: in the first line, at the "
             "top, in what was required, and here. All else is reported, and proves nothing: sampled values, "
             "simulations, comparisons, undecided statements.{}\n\n",
             has_published(certificate) ? " --markdown published-theorems.md" : "",
             options.certificate_sha256,
             has_published(certificate) ? " The sentences on published theorems are in "
                                          "[published-theorems.md](published-theorems.md)."
                                        : "") +
         sentences(certificate, false);
}

/// Whether the certificate was verified, and how to repeat the verification.
std::string verification_paragraph(const Certificate& certificate, const Verification& verification) {
  constexpr std::string_view kChecker = "`veritrack-verify` " VERITRACK_VERSION;
  std::string text;
  switch (verification.outcome) {
    case Verification::Outcome::left_out:
      text = "*Not verified* when this document was written. To verify it:";
      break;
    case Verification::Outcome::verified:
      text = fmt::format(
          "*Verified* by {}, which shares no code with the program that wrote this document. To repeat it:",
          kChecker);
      break;
    case Verification::Outcome::refused:
      text = fmt::format("*NOT VERIFIED*: {} gave no answer.", kChecker);
      if (verification.failure.empty()) {
        std::vector<std::string> names;
        for (const RefusedPart& part : verification.refused) {
          names.push_back(escaped(part.name));
        }
        text = fmt::format("*NOT VERIFIED*: {} refuses {} of {} parts: {}.", kChecker, names.size(),
                           verification.parts, fmt::join(names, "; "));
      }
      text += " One of the two programs is wrong: rely on nothing in this document. To repeat it:";
  }
  return text + "\n\n" + markdown::fenced(checking_command(certificate), "") + "\n";
}

std::string reproduction_section(const Certificate& certificate, const MarkdownOptions& options) {
  const std::string file = markdown::file_name(certificate.design_file);
  std::string text = "## How to reproduce it\n\n";
  text += fmt::format("Save the design file below as `{}` and run\n\n", file);
  text += markdown::fenced("veritrack certify " + file + (certificate.formal_proofs ? " --coq" : ""), "");
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
  return text + fmt::format("`{}`:\n\n", file);
}

}  // namespace

std::string headline(const Certificate& certificate, const Verification& verification) {
  std::vector<std::string> sentences;
  if (verification.outcome == Verification::Outcome::refused) {
    sentences.emplace_back("NOT VERIFIED");
  }
  if (certificate.verdict != Verdict::proved) {
    sentences.emplace_back(certificate.verdict ? "NOT PROVED" : "Nothing is required of this design");
  }
  std::vector<std::string> verdicts;
  for (const Claim& claim : certificate.claims) {
    if (!claim.finding.empty() && claim.verdict == Verdict::refuted) {
      verdicts.push_back("REFUTED: " + claim.finding);
    }
  }
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      verdicts.push_back(upper_case(rigor::to_string(claim.verdict)) + ": " + claim.requirement);
    }
  }
  if (!verdicts.empty()) {
    sentences.push_back(fmt::format("{}", fmt::join(verdicts, "; ")));
  }
  return fmt::format("{}", fmt::join(sentences, ". "));
}

namespace {

/// The file, or the word DESIGN for a name that a shell would split or a reader would take for a verdict.
std::string design_argument(const std::string& file) {
  static const std::regex plain("[-A-Za-z0-9._+/]+");
  static const std::regex verdict("PR[O0]VED|REFUTED", std::regex::icase);
  return std::regex_match(file, plain) && !std::regex_search(file, verdict) ? file : "DESIGN";
}

}  // namespace

std::string checking_command(const Certificate& certificate) {
  return fmt::format("veritrack-verify certificate.json --full --design {} --markdown certificate.md{}",
                     design_argument(certificate.design_file),
                     has_published(certificate) ? " --markdown published-theorems.md" : "");
}

std::string picture(const FigureReference& figure) {
  return fmt::format("![{}]({})\n\n*{}*\n\n", escaped(figure.title), figure.path, figure.caption);
}

std::string to_published_markdown(const Certificate& certificate, const MarkdownOptions& options) {
  if (!has_published(certificate)) {
    return "";
  }
  return markdown::plain(
             "# What published theorems say of this design\n\nBeside [certificate.md](certificate.md), for "
             "the same design. No requirement and no guarantee of that certificate depends on anything "
             "here.\n\n" +
             kind_of(certificate.design).published(certificate)) +
         fmt::format(
             "## What the checker verifies\n\n`veritrack-verify certificate.json --markdown "
             "published-theorems.md` verifies these sentences from `certificate.json` (SHA-256 `{}`), and "
             "that "
             "this document gives no other verdict in capitals. All else is reported. A sentence on "
             "conditions "
             "that is refuted means that the theorem does not apply to this design, not that the tracker "
             "fails.\n\n",
             options.certificate_sha256) +
         sentences(certificate, true);
}

std::string to_markdown(const Certificate& certificate, const MarkdownOptions& options) {
  const TrackerKind& kind = kind_of(certificate.design);
  const std::string stopped =
      certificate.deadline.has_struck()
          ? "*Stopped by the time limit.* Proved claims are unaffected; all that was not reached in time is "
            "UNDECIDED, and another run may reach more or less.\n\n"
          : "";
  return markdown::plain("# " + headline(certificate, options.verification) + "\n\n" + stopped +
                         first_page(kind.answers(certificate)) +
                         (kind.remarks == nullptr ? "" : kind.remarks(certificate)) +
                         verification_paragraph(certificate, options.verification) +
                         requirement_section(certificate) + kind.sections(certificate, options) +
                         checker_section(certificate, options) + formal_proofs_section(certificate) +
                         reproduction_section(certificate, options)) +
         markdown::fenced(certificate.design_text, "toml");
}

}  // namespace veritrack::certificates

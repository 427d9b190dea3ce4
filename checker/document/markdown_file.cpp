#include "checker/document/markdown_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "checker/document/first_page.hpp"
#include "checker/document/plain_markdown.hpp"
#include "checker/document/sha256.hpp"

namespace veritrack::checker {

namespace {

using Lines = std::vector<std::string>;

constexpr const char* kSectionOfRequirements = "## What was required";
/// The beginning of a document's remark that the time was limited.
constexpr const char* kStopped = "*Stopped by the time limit.* ";

Lines lines_of(const std::string& document) {
  Lines lines;
  std::istringstream stream(document);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// Whether a claim is about a publication, not about the tracker.
bool concerns_publication(const std::string& id) {
  return id.starts_with("theorem-") || id.starts_with("proposition-") || id.ends_with("/conditions");
}

/// The lines from that heading to the next, without both; all up to the first heading for an empty one.
Lines section(const Lines& lines, const std::string& heading) {
  auto begin = std::find(lines.begin(), lines.end(), heading);
  if (heading.empty()) {
    begin = lines.begin();
  }
  if (begin == lines.end()) {
    return {};
  }
  const auto end =
      std::find_if(begin + 1, lines.end(), [](const std::string& line) { return line.starts_with("## "); });
  return {begin + 1, end};
}

/// The list in the section of the checker is exactly the expected one.
void check_sentences(const Lines& section, const Lines& expected, Objections& objections) {
  Lines found;
  std::copy_if(section.begin(), section.end(), std::back_inserter(found),
               [](const std::string& line) { return line.starts_with("- "); });
  if (found != expected) {
    objections.emplace_back(
        "the document says something else than was verified in the section of the checker");
  }
}

/// The document's statements with a verdict, and their place: `section` is the heading, empty for the top.
struct Compared {
  std::string section;
  Lines lines;  ///< "| " begins a row of which only the beginning is compared
};

/// The letters of a heading.
std::string letters_of(const std::string& heading) {
  std::string letters;
  std::copy_if(heading.begin(), heading.end(), std::back_inserter(letters),
               [](unsigned char c) { return std::isalpha(c) != 0; });
  return letters;
}

/// Reads a document as a renderer does: nothing stands in it that the program does not write, and no verdict
/// where it was not compared.
class Elsewhere {
 public:
  Elsewhere(const Verification& verified, const std::vector<Compared>& compared)
      : verified_(verified),
        compared_(compared),
        quotations_(verified.quoted.size() < 2 ? Lines{}
                                               : Lines{quotation_of(verified.quoted[0], verified.quoted[1]),
                                                       quotation_of(verified.quoted[0], "")}) {}

  /// The first objection.
  [[nodiscard]] std::optional<std::string> objection_to(const Lines& lines) {
    for (std::size_t i = 1; i < lines.size(); ++i) {  // the first one is compared as a whole
      const auto refused = fence_.empty() ? outside(lines, i) : inside(lines[i]);
      if (refused) {
        return "line " + std::to_string(i + 1) + " of the document " + *refused;
      }
    }
    return fence_.empty() ? std::nullopt : std::optional<std::string>("the document ends within a fence");
  }

 private:
  using Refused = std::optional<std::string>;

  Refused outside(const Lines& lines, std::size_t i) {
    const std::string& line = lines[i];
    if (line.starts_with("```")) {
      return open_fence(line);
    }
    if (line.starts_with('#')) {
      if (Refused refused = open_section(line)) {
        return refused;
      }
    }
    if (std::find(quotations_.begin(), quotations_.end(), line) != quotations_.end()) {
      // Its letters are the design's; it ends with its line.
      const bool ends = i + 1 == lines.size() || lines[i + 1].empty();
      plain_.skip_line();
      return ends ? std::nullopt : Refused("goes on with the quotation of the design");
    }
    const std::string known = known_part(line);
    if (letters_of(line).starts_with("RequirementVerdict") && section_ != kSectionOfRequirements) {
      return "begins another table of requirements";
    }
    if (!known.empty()) {
      plain_.skip_line();
    }
    return plain_.objection_to(std::string_view(line).substr(known.size()));
  }

  /// The beginning of the line when that is compared elsewhere.
  [[nodiscard]] std::string known_part(const std::string& line) const {
    for (const auto& [section, known] : compared_) {
      const auto found = std::find_if(known.begin(), known.end(), [&](const std::string& one) {
        return line == one || (one.starts_with("| ") && line.starts_with(one));
      });
      if (section == section_ && found != known.end()) {
        return *found;
      }
    }
    return "";
  }

  /// A section in which verdicts are compared is there once.
  Refused open_section(const std::string& line) {
    section_ = line.starts_with("## ") ? line : section_;
    for (const auto& compared : compared_) {
      const std::string letters = letters_of(compared.section);
      if (!letters.empty() && letters_of(line).starts_with(letters) &&
          (line != compared.section || !sections_.insert(line).second)) {
        return "begins another section on what was verified";
      }
    }
    return std::nullopt;
  }

  Refused open_fence(const std::string& line) {
    const std::size_t ticks = std::min(line.find_first_not_of('`'), line.size());
    fence_ = line.substr(0, ticks);
    language_ = line.substr(ticks);
    text_.clear();
    fenced_refused_.reset();
    return language_.empty() || language_ == "toml" || language_ == "math"
               ? std::nullopt
               : Refused("begins a block of another language");
  }

  /// A fenced block is a quotation when it is the design file; then nothing in it may end the fence.
  Refused inside(const std::string& line) {
    if (line == fence_) {
      fence_.clear();
      plain_.skip_line();
      const bool is_design =
          sha256(text_) == verified_.design_sha256 ||
          (!text_.empty() && sha256(text_.substr(0, text_.size() - 1)) == verified_.design_sha256);
      return is_design ? std::nullopt : fenced_refused_;
    }
    if (line.find(fence_) != std::string::npos) {
      return "may end the fence around it";
    }
    text_ += line + "\n";
    if (!fenced_refused_) {
      fenced_refused_ = plain_.objection_to_fenced(line, language_ == "math");
    }
    return std::nullopt;
  }

  const Verification& verified_;
  const std::vector<Compared>& compared_;
  Lines quotations_;
  PlainMarkdown plain_;
  std::string section_;  ///< the heading
  std::set<std::string> sections_;
  std::string fence_, language_, text_;  ///< of the fence that is open
  Refused fenced_refused_;
};

/// "| requirement | **VERDICT** |" of a row of the table.
std::string first_two_cells(const std::string& row) {
  const std::size_t second = row.find(" | ", row.find(" | ") + 1);
  return row.substr(0, second) + " |";
}

/// The sentences with their verdicts come behind the headline, before anything else that is seen.
void check_top(const Lines& lines, Objections& objections) {
  const auto first = std::find_if(lines.begin() + (lines.empty() ? 0 : 1), lines.end(), [](const auto& line) {
    return !line.empty() && !line.starts_with(kStopped);
  });
  const bool is_block = first == lines.end() || first->starts_with("**") || first->starts_with("## ");
  if (!is_block) {
    objections.emplace_back("the document says something before the sentences that were verified");
  }
}

}  // namespace

std::string headline(const Verification& verified) {
  const bool is_asked = !verified.requirements.empty();
  const std::string text = !is_asked                      ? "Nothing is required of this design"
                           : verified.requirements_proved ? ""
                                                          : "NOT PROVED";
  std::string verdicts;
  const auto say = [&](Verdict verdict, const std::string& what) {
    verdicts += (verdicts.empty() ? "" : "; ") + word_of(verdict) + ": " + what;
  };
  for (const Sentence& sentence : verified.sentences) {
    if (!sentence.finding.empty() && sentence.verdict == Verdict::refuted) {
      say(sentence.verdict, sentence.finding);
    }
  }
  for (const Requirement& requirement : verified.requirements) {
    say(requirement.verdict, requirement.text);
  }
  return "# " + text + (text.empty() || verdicts.empty() ? "" : ". ") + verdicts;
}

void compare_with_markdown(const Verification& verified, const std::string& certificate_sha256,
                           const std::string& document, Objections& objections) {
  const Lines lines = lines_of(document);
  const bool is_published = !lines.empty() && lines[0] == kPublishedHeadline;
  const std::string first = is_published ? kPublishedHeadline : headline(verified);
  if (lines.empty() || lines[0] != first) {
    objections.emplace_back("the document begins with another headline: " + first);
  }
  if (document.find(certificate_sha256) == std::string::npos) {
    objections.emplace_back("the document does not name the SHA-256 of the certificate");
  }
  const Lines top = is_published ? Lines{} : first_page(verified.sentences);
  Lines all;
  for (const Sentence& sentence : verified.sentences) {
    if (concerns_publication(sentence.id) == is_published && (is_published || !sentence.is_summary)) {
      all.push_back("- **" + word_of(sentence.verdict) + "** `" + sentence.id + "`: " + sentence.text);
    }
  }
  check_first_page(section(lines, ""), top, objections);
  check_sentences(section(lines, kSectionOfTheChecker), all, objections);
  Lines rows;
  for (const Requirement& requirement : is_published ? std::vector<Requirement>{} : verified.requirements) {
    rows.push_back("| " + requirement.text + " | **" + word_of(requirement.verdict) + "** |");
  }
  Lines found;
  for (const std::string& line : section(lines, kSectionOfRequirements)) {
    const bool is_head = line == "| Requirement | Verdict | Ground |" || line == "| --- | --- | --- |";
    if (!line.empty() && !is_head && !rows.empty()) {
      found.push_back(first_two_cells(line));
    }
  }
  if (found != rows) {
    objections.emplace_back("the document says something else than was verified of what is required");
  }
  std::vector<Compared> compared{{kSectionOfTheChecker, all}};
  if (!is_published) {
    compared.push_back({"", top});
    compared.push_back({kSectionOfRequirements, rows});
    if (!top.empty()) {  // else the document says in its own words that there is nothing
      check_top(lines, objections);
    }
  }
  if (const auto objection = Elsewhere(verified, compared).objection_to(lines)) {
    objections.push_back(*objection);
  }
}

}  // namespace veritrack::checker

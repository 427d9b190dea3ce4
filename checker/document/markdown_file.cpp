#include "checker/document/markdown_file.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

namespace veritrack::checker {

namespace {

std::string word(Verdict verdict) {
  return verdict == Verdict::proved ? "PROVED" : verdict == Verdict::refuted ? "REFUTED" : "UNDECIDED";
}

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& document) {
  Lines lines;
  std::istringstream stream(document);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
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

/// The lines of the section that begin so are exactly the expected ones, in their order.
void check_lines(const Lines& section, const std::string& beginning, const Lines& expected,
                 const std::string& where, Objections& objections) {
  Lines found;
  std::copy_if(section.begin(), section.end(), std::back_inserter(found), [&](const std::string& line) {
    return line.starts_with(beginning) && !line.starts_with("**UNDECIDED**: ");
  });
  if (found != expected) {
    objections.push_back("the document says something else than was verified " + where);
  }
}

/// "| requirement | **VERDICT** |" of a row of the table.
std::string first_two_cells(const std::string& row) {
  const std::size_t second = row.find(" | ", row.find(" | ") + 1);
  return row.substr(0, second) + " |";
}

}  // namespace

std::string headline(const Verification& verified) {
  std::string text;
  for (const Requirement& requirement : verified.requirements) {
    text += (text.empty() ? "" : "; ") + word(requirement.verdict) + ": " + requirement.text;
  }
  return verified.requirements.empty() ? "# Nothing is required of this design"
                                       : (verified.requirements_proved ? "# " : "# NOT PROVED. ") + text;
}

void compare_with_markdown(const Verification& verified, const std::string& certificate_sha256,
                           const std::string& document, Objections& objections) {
  const Lines lines = lines_of(document);
  if (lines.empty() || lines[0] != headline(verified)) {
    objections.emplace_back("the document begins with another headline: " + headline(verified));
  }
  if (document.find(certificate_sha256) == std::string::npos) {
    objections.emplace_back("the document does not name the SHA-256 of the certificate");
  }
  Lines top;
  Lines all;
  for (const Sentence& sentence : verified.sentences) {
    const std::string verdict = "**" + word(sentence.verdict) + "**";
    if (sentence.is_summary) {
      top.push_back(verdict + ": " + sentence.text);
    }
    all.push_back("- " + verdict + " `" + sentence.id + "`: " + sentence.text);
  }
  check_lines(section(lines, ""), "**", top, "in the block at the top", objections);
  check_lines(section(lines, kSectionOfTheChecker), "- ", all, "in the section of the checker", objections);
  Lines rows;
  for (const Requirement& requirement : verified.requirements) {
    rows.push_back("| " + requirement.text + " | **" + word(requirement.verdict) + "** |");
  }
  Lines found;
  for (const std::string& line : section(lines, "## What was required")) {
    if (line.starts_with("| ") && !line.starts_with("| Requirement |") && !line.starts_with("| ---")) {
      found.push_back(first_two_cells(line));
    }
  }
  if (found != rows) {
    objections.emplace_back("the document says something else than was verified of what is required");
  }
}

}  // namespace veritrack::checker

#include "checker/document/markdown_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "checker/document/sha256.hpp"

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

/// Whether a claim is about a publication, not about the tracker.
bool concerns_publication(const std::string& id) {
  return id.starts_with("theorem-") || id.starts_with("proposition-") || id.ends_with("/conditions");
}

/// The block with the text of the design file: where its lines begin and end. Whoever reads the document sees
/// a design there, so that its words say nothing of verdicts.
std::optional<std::pair<std::size_t, std::size_t>> design_text(const Lines& lines, const std::string& hash) {
  const auto fence = [](const std::string& line) { return line.starts_with("```"); };
  const auto last = std::find_if(lines.rbegin(), lines.rend(), fence);
  const auto first =
      last == lines.rend() ? lines.rend() : std::find_if(last + 1, lines.rend(), [](const auto& line) {
        return line.starts_with("```") && line.ends_with("toml");
      });
  if (first == lines.rend()) {
    return std::nullopt;
  }
  const auto begin = static_cast<std::size_t>(lines.rend() - first);
  const auto end = static_cast<std::size_t>(lines.rend() - last) - 1;
  std::string text;
  for (std::size_t i = begin; i < end; ++i) {
    text += lines[i] + "\n";
  }
  const bool is_it =
      sha256(text) == hash || (!text.empty() && sha256(text.substr(0, text.size() - 1)) == hash);
  return is_it ? std::optional(std::pair(begin, end)) : std::nullopt;
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

/// "&zwj;" or "&#69;": a character by its name or number.
bool has_character_reference(const std::string& line) {
  for (std::size_t begin = line.find('&'); begin != std::string::npos; begin = line.find('&', begin + 1)) {
    const auto end =
        std::find_if(line.begin() + static_cast<std::ptrdiff_t>(begin) + 1, line.end(),
                     [](char c) { return c != '#' && std::isalnum(static_cast<unsigned char>(c)) == 0; });
    const bool is_empty = end == line.begin() + static_cast<std::ptrdiff_t>(begin) + 1;
    if (!is_empty && end != line.end() && *end == ';') {
      return true;
    }
  }
  return false;
}

/// A tag or a comment that goes on in the next line.
bool has_open_tag(const std::string& line) {
  const std::size_t begin = line.rfind('<');
  const bool is_tag = begin != std::string::npos && begin + 1 < line.size() &&
                      (std::isalpha(static_cast<unsigned char>(line[begin + 1])) != 0 ||
                       std::string_view("/!?").find(line[begin + 1]) != std::string_view::npos);
  return is_tag && line.find('>', begin) == std::string::npos;
}

/// Whether a reader may see a verdict in the line: as it is written; without the marks of Markdown and what
/// is not ASCII, which may be invisible; or without tags, too. A character reference or the rest of a tag may
/// hide in any word.
bool shows_a_verdict(const std::string& line) {
  std::string unmarked, untagged;
  bool is_in_tag = false;
  for (const char letter : line) {
    const bool is_ascii = static_cast<unsigned char>(letter) < 0x80U;
    const bool is_mark = !is_ascii || std::string_view("*_`~\\").find(letter) != std::string_view::npos;
    is_in_tag = letter == '<' || (is_in_tag && letter != '>');
    unmarked += is_mark ? "" : std::string(1, letter);
    untagged += is_mark || is_in_tag || letter == '>' ? "" : std::string(1, letter);
  }
  const Lines seen{line, unmarked, untagged};
  return has_character_reference(line) || has_open_tag(line) ||
         std::any_of(seen.begin(), seen.end(), [](const auto& text) {
           return text.find("PROVED") != std::string::npos || text.find("REFUTED") != std::string::npos;
         });
}

/// No verdict stands where it was not compared.
void check_elsewhere(const Verification& verified, const Lines& lines, const Lines& compared,
                     Objections& objections) {
  const auto design = design_text(lines, verified.design_sha256);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (design && i >= design->first && i < design->second) {
      continue;
    }
    const auto known = std::find_if(compared.begin(), compared.end(), [&](const std::string& one) {
      return lines[i] == one || (one.starts_with("| ") && lines[i].starts_with(one));
    });
    const std::string rest = known == compared.end() ? lines[i] : lines[i].substr(known->size());
    if (shows_a_verdict(rest)) {
      objections.push_back("line " + std::to_string(i + 1) +
                           " of the document gives a verdict that was not verified");
      return;
    }
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
  const bool is_published = !lines.empty() && lines[0] == kPublishedHeadline;
  const std::string first = is_published ? kPublishedHeadline : headline(verified);
  if (lines.empty() || lines[0] != first) {
    objections.emplace_back("the document begins with another headline: " + first);
  }
  if (document.find(certificate_sha256) == std::string::npos) {
    objections.emplace_back("the document does not name the SHA-256 of the certificate");
  }
  Lines top;
  for (const Sentence& sentence : verified.sentences) {
    if (sentence.is_summary && !is_published) {
      top.push_back("**" + word(sentence.verdict) + "**: " + sentence.text);
    }
  }
  Lines all;
  for (const Sentence& sentence : verified.sentences) {
    const std::string verdict = "**" + word(sentence.verdict) + "**";
    const bool is_at_top = std::find(top.begin(), top.end(), verdict + ": " + sentence.text) != top.end();
    if (concerns_publication(sentence.id) == is_published && !is_at_top) {
      all.push_back("- " + verdict + " `" + sentence.id + "`: " + sentence.text);
    }
  }
  check_lines(section(lines, ""), "**", top, "in the block at the top", objections);
  check_lines(section(lines, kSectionOfTheChecker), "- ", all, "in the section of the checker", objections);
  Lines rows;
  for (const Requirement& requirement : is_published ? std::vector<Requirement>{} : verified.requirements) {
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
  Lines compared{first};
  for (const Lines& some : {top, all, rows}) {
    compared.insert(compared.end(), some.begin(), some.end());
  }
  check_elsewhere(verified, lines, compared, objections);
}

}  // namespace veritrack::checker

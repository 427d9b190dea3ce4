#include "checker/document/first_page.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace veritrack::checker {

namespace {

using Lines = std::vector<std::string>;

constexpr const char* kAssume = "**Assume** (each claim below names those that it rests on)";
constexpr const char* kThen = "**Then**";

/// Words with which a hypothesis begins, after a comma or a full stop.
constexpr std::array<std::string_view, 20> kOpenings{"Its first prediction ",
                                                     "for a tone of ",
                                                     "for every tone of ",
                                                     "in a way that does not depend on the noise, plus ",
                                                     "on a tone ",
                                                     "on the signal of ",
                                                     "plus noise ",
                                                     "started at a level ",
                                                     "started exactly in ",
                                                     "started in the set ",
                                                     "started within ",
                                                     "the block tracker ",
                                                     "with Gaussian measurement noise ",
                                                     "with a sinusoidal disturbance ",
                                                     "with any disturbance ",
                                                     "with measurement noise ",
                                                     "with noise ",
                                                     "without disturbance",
                                                     "without measurement noise",
                                                     "without noise"};

bool opens(std::string_view text) {
  const auto is_there = [&](std::string_view opening) { return text.substr(0, opening.size()) == opening; };
  return std::any_of(kOpenings.begin(), kOpenings.end(), is_there);
}

/// Without the text between it and the next part.
std::string trimmed(std::string text) {
  if (text.ends_with(". Then ")) {
    text.erase(text.size() - std::string_view("Then ").size());
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == ',' || text.back() == '.')) {
    text.pop_back();
  }
  return text;
}

Lines hypotheses_of(const std::string& text) {
  Lines found;
  std::size_t begin = 0;
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at + 1)) {
    const bool is_end = at > 0 && (text[at - 1] == ',' || text[at - 1] == '.');
    if (is_end && opens(std::string_view(text).substr(at + 1))) {
      found.push_back(trimmed(text.substr(begin, at - begin)));
      begin = at + 1;
    }
  }
  found.push_back(trimmed(text.substr(begin)));
  return found;
}

/// In rising or any other order: three or more that follow each other as "2 to 4".
std::string listed(const std::vector<std::size_t>& numbers) {
  std::string text;
  std::size_t run = 0;  // where the present one began
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool goes_on = i + 1 < numbers.size() && numbers[i + 1] == numbers[i] + 1;
    if (goes_on) {
      continue;
    }
    text += (run == 0 ? "" : ", ") + std::to_string(numbers[run]);
    if (i > run) {
      text += (i > run + 1 ? " to " : ", ") + std::to_string(numbers[i]);
    }
    run = i + 1;
  }
  return text;
}

/// The part of a sentence after its hypotheses.
std::string conclusion(const Sentence& sentence) {
  std::string rest = sentence.text.substr(sentence.hypotheses.size());
  return rest.starts_with(", ") ? rest.substr(2) : rest;
}

bool is_reason(const std::string& line) {
  return line.starts_with("  Why: ") || line.starts_with("Why: ");
}

/// Whether a reader takes the line for one of the list, or for a sentence with its verdict.
bool is_of_list(const std::string& line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::string_view text = std::string_view(line).substr(begin);
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  const bool is_numbered = digits > 0 && digits < text.size() && (text[digits] == '.' || text[digits] == ')');
  return is_numbered || text.starts_with("**") || text.starts_with("- **") || text.starts_with("* **") ||
         text.starts_with("+ **");
}

}  // namespace

std::string word_of(Verdict verdict) {
  return verdict == Verdict::proved ? "PROVED" : verdict == Verdict::refuted ? "REFUTED" : "UNDECIDED";
}

Lines first_page(const std::vector<Sentence>& sentences) {
  Lines hypotheses;
  Lines claims;
  Lines others;
  for (const Sentence& sentence : sentences) {
    const std::string verdict = "**" + word_of(sentence.verdict) + "**";
    if (!sentence.is_summary) {
      continue;
    }
    if (sentence.hypotheses.empty() || !sentence.text.starts_with(sentence.hypotheses)) {
      others.push_back(verdict + ": " + sentence.text);
      continue;
    }
    std::vector<std::size_t> numbers;
    for (const std::string& part : hypotheses_of(sentence.hypotheses)) {
      const auto found = std::find(hypotheses.begin(), hypotheses.end(), part);
      numbers.push_back(static_cast<std::size_t>(std::distance(hypotheses.begin(), found)) + 1);
      if (found == hypotheses.end()) {
        hypotheses.push_back(part);
      }
    }
    claims.push_back("- " + verdict + " (" + listed(numbers) + "): " + conclusion(sentence));
  }
  Lines lines;
  if (!claims.empty()) {
    lines.emplace_back(kAssume);
    for (std::size_t i = 0; i < hypotheses.size(); ++i) {
      lines.push_back(std::to_string(i + 1) + ". " + hypotheses[i]);
    }
    lines.emplace_back(kThen);
    lines.insert(lines.end(), claims.begin(), claims.end());
  }
  lines.insert(lines.end(), others.begin(), others.end());
  return lines;
}

void check_first_page(const Lines& lines, const Lines& expected, Objections& objections) {
  Lines found;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(found), [](const std::string& line) {
    return is_of_list(line) && !line.starts_with("**UNDECIDED**: ");
  });
  if (found != expected) {
    objections.emplace_back("the document says something else than was verified in the block at the top");
    return;
  }
  if (expected.empty()) {
    return;
  }
  const auto first = std::find(lines.begin(), lines.end(), expected.front());
  const auto last = std::find(lines.begin(), lines.end(), expected.back());
  const auto is_foreign = [](const std::string& line) {
    return !line.empty() && !is_of_list(line) && !is_reason(line);
  };
  // A line that follows the last one at once is read as a part of it.
  if (std::any_of(first, std::find(last, lines.end(), ""), is_foreign)) {
    objections.emplace_back("the document says something between the sentences that were verified");
  }
}

}  // namespace veritrack::checker

#include "certificates/document/first_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Verdict;

/// The beginnings of a hypothesis behind ", " or ". ".
constexpr std::array<std::string_view, 20> kBeginnings{"for a tone of ",
                                                       "for every tone of ",
                                                       "on a tone ",
                                                       "on the signal of ",
                                                       "with measurement noise ",
                                                       "with Gaussian measurement noise ",
                                                       "with noise ",
                                                       "without measurement noise",
                                                       "without noise",
                                                       "with any disturbance ",
                                                       "with a sinusoidal disturbance ",
                                                       "without disturbance",
                                                       "started within ",
                                                       "started in the set ",
                                                       "started exactly in ",
                                                       "started at a level ",
                                                       "the block tracker ",
                                                       "plus noise ",
                                                       "in a way that does not depend on the noise, plus ",
                                                       "Its first prediction "};
constexpr std::array<std::string_view, 4> kEndings{". Then ", ", ", ". ", "."};

bool begins_hypothesis(std::string_view text) {
  return std::any_of(kBeginnings.begin(), kBeginnings.end(),
                     [&](std::string_view beginning) { return text.starts_with(beginning); });
}

std::string without_ending(std::string_view text) {
  for (const std::string_view ending : kEndings) {
    if (text.ends_with(ending)) {
      return std::string(text.substr(0, text.size() - ending.size()));
    }
  }
  return std::string(text);
}

/// The hypotheses one by one.
std::vector<std::string> parts_of(std::string_view hypotheses) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t i = 2; i < hypotheses.size(); ++i) {
    const std::string_view before = hypotheses.substr(i - 2, 2);
    if ((before == ", " || before == ". ") && begins_hypothesis(hypotheses.substr(i))) {
      parts.push_back(without_ending(hypotheses.substr(begin, i - begin)));
      begin = i;
    }
  }
  parts.push_back(without_ending(hypotheses.substr(begin)));
  return parts;
}

/// The part of a statement behind its hypotheses.
std::string conclusion_of(const Claim& claim) {
  if (!claim.statement.starts_with(claim.hypotheses)) {
    throw std::logic_error("the statement of " + claim.id + " does not begin with its hypotheses");
  }
  const std::string_view rest = std::string_view(claim.statement).substr(claim.hypotheses.size());
  return std::string(rest.starts_with(", ") ? rest.substr(2) : rest);
}

/// "1 to 4, 6".
std::string numbers_words(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) {
      ++last;
    }
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[i]);
    if (last > i) {
      text += fmt::format("{}{}", last > i + 1 ? " to " : ", ", numbers[last]);
    }
    i = last + 1;
  }
  return text;
}

std::string reason_of(const Claim& claim) {
  return claim.reason.empty() || claim.required ? "" : "Why: " + claim.reason;
}

/// Numbers the hypotheses in the order in which claims name them.
class List {
 public:
  void add(const Claim& claim) {
    std::vector<std::size_t> numbers;
    for (const std::string& part : parts_of(claim.hypotheses)) {
      const auto known = std::find(hypotheses_.begin(), hypotheses_.end(), part);
      numbers.push_back(static_cast<std::size_t>(known - hypotheses_.begin()) + 1);
      if (known == hypotheses_.end()) {
        hypotheses_.push_back(part);
      }
    }
    claims_ += fmt::format("- {} ({}): {}\n", markdown::verdict(claim.verdict), numbers_words(numbers),
                           conclusion_of(claim));
    const std::string reason = reason_of(claim);
    claims_ += reason.empty() ? "" : "  " + reason + "\n";
  }

  [[nodiscard]] std::string text() const {
    if (hypotheses_.empty()) {
      return "";
    }
    std::string text = "**Assume** (each claim below names those that it rests on)\n\n";
    for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
      text += fmt::format("{}. {}\n", i + 1, hypotheses_[i]);
    }
    return text + "\n**Then**\n\n" + claims_ + "\n";
  }

 private:
  std::vector<std::string> hypotheses_;
  std::string claims_;
};

std::string as_sentence(const Claim& claim, const std::string& reason) {
  return fmt::format("{}: {}\n\n{}", markdown::verdict(claim.verdict), claim.statement,
                     reason.empty() ? "" : reason + "\n\n");
}

}  // namespace

std::string first_page(const std::vector<const Claim*>& claims) {
  std::string undecided;
  std::string sentences;
  List list;
  for (const Claim* claim : claims) {
    if (claim->verdict == Verdict::undecided) {
      undecided += as_sentence(*claim, claim->reason.empty() ? "" : "Why not: " + claim->reason);
    } else if (claim->hypotheses.empty()) {
      sentences += as_sentence(*claim, reason_of(*claim));
    } else {
      list.add(*claim);
    }
  }
  return undecided + list.text() + sentences;
}

}  // namespace veritrack::certificates

#include "certificates/document/markdown_text.hpp"

#include <algorithm>
#include <array>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::certificates::markdown {

std::string math(std::string_view latex) {
  std::string text = "$`";
  for (std::size_t i = 0; i < latex.size(); ++i) {
    if (latex.substr(i, 2) == "\\|") {
      text += "\\Vert ";
      ++i;
    } else if (latex[i] == '|') {
      text += "\\vert ";
    } else {
      text += latex[i];
    }
  }
  return text + "`$";
}

std::string enclosure(const rigor::Interval& value, int digits) {
  if (rigor::is_empty(value)) {
    return "unknown";
  }
  const std::string lower = rigor::to_decimal(value.lower(), digits, rigor::Direction::down);
  const std::string upper = rigor::to_decimal(value.upper(), digits, rigor::Direction::up);
  return lower == upper ? "= " + lower : "∈ [" + lower + ", " + upper + "]";
}

std::string at_most(const rigor::Interval& value, int digits) {
  return rigor::is_empty(value) ? "unknown"
                                : "at most " + rigor::to_decimal(value.upper(), digits, rigor::Direction::up);
}

std::string at_least(const rigor::Interval& value, int digits) {
  return rigor::is_empty(value)
             ? "unknown"
             : "at least " + rigor::to_decimal(value.lower(), digits, rigor::Direction::down);
}

std::string verdict(rigor::Verdict value) {
  std::string word(rigor::to_string(value));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char letter) { return static_cast<char>(letter - 'a' + 'A'); });
  return "**" + word + "**";
}

std::string answer(rigor::Verdict value) {
  return value == rigor::Verdict::proved ? "yes" : value == rigor::Verdict::refuted ? "no" : "undecided";
}

std::string satisfied(rigor::Verdict value) {
  return value == rigor::Verdict::proved    ? "satisfied"
         : value == rigor::Verdict::refuted ? "not satisfied"
                                            : "undecided";
}

std::string escaped(std::string_view text) {
  static constexpr std::string_view kSpecial = "\\`*_{}[]()<>#+-!|$~&";
  std::string result;
  for (const char letter : text) {
    if (letter == '\n' || letter == '\r') {
      result += ' ';
      continue;
    }
    // a hyphen or a parenthesis is special only where it would start something, which escaping cannot harm
    // but which makes the source hard to read
    if (kSpecial.find(letter) != std::string_view::npos && letter != '-' && letter != '(' && letter != ')') {
      result += '\\';
    }
    result += letter;
  }
  return result;
}

std::string quotation(std::string_view name, std::string_view source) {
  return "> " + escaped(name) + (source.empty() ? "" : ", from: " + escaped(source)) + "\n\n";
}

std::string plain(std::string_view document) {
  constexpr std::array<std::string_view, 18> kOther{"—", "–", "²", "∈", "≈", "≤", "≥", "±", "·",
                                                    "×", "→", "−", "π", "é", "°", "µ", "α", "ε"};
  const auto begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  std::string result;
  for (std::size_t i = 0; i < document.size();) {
    const bool begins_line = i == 0 || document[i - 1] == '\n';
    std::size_t end = i + 1;
    if (begins_line && document.substr(i).starts_with("> ")) {
      end = std::min(document.find('\n', i), document.size());
      result += document.substr(i, end - i);
    } else {
      while (end < document.size() && !begins_character(document[end])) {
        ++end;
      }
      const std::string_view character = document.substr(i, end - i);
      const bool is_plain = character == "\n" ||
                            (character.size() == 1 && character[0] >= ' ' && character[0] < '\x7f') ||
                            std::find(kOther.begin(), kOther.end(), character) != kOther.end();
      result += is_plain ? character : "?";
    }
    i = end;
  }
  return result;
}

std::string file_name(std::string_view name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._-").find(c) != std::string_view::npos;
  });
  return is_plain ? std::string(name) : "design.toml";
}

namespace {

std::string table_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) {
    row += " ";
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const bool ends_the_cell = cell[i] == '|' && (i == 0 || cell[i - 1] != '\\');
      row += ends_the_cell ? "\\|" : cell.substr(i, 1);
    }
    row += " |";
  }
  return row + "\n";
}

}  // namespace

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string text = table_row(header);
  text += table_row(std::vector<std::string>(header.size(), "---"));
  for (const auto& row : rows) {
    text += table_row(row);
  }
  return text;
}

std::string fenced(std::string_view text, std::string_view language) {
  std::string fence = "```";
  while (text.find(fence) != std::string_view::npos) {
    fence += '`';
  }
  std::string block = fence + std::string(language) + "\n" + std::string(text);
  if (block.back() != '\n') {
    block += '\n';
  }
  return block + fence + "\n";
}

std::string with_lower_headings(const std::string& text) {
  std::string result;
  std::string fence;  // that is open
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string line = text.substr(begin, end - begin);
    const std::size_t ticks = std::min(line.find_first_not_of('`'), line.size());
    if (fence.empty()) {
      result += line.starts_with('#') ? "#" : "";
      fence = ticks >= 3 ? line.substr(0, ticks) : "";
    } else if (line.starts_with(fence)) {
      fence.clear();
    }
    result += line;
    begin = end;
  }
  return result;
}

}  // namespace veritrack::certificates::markdown

#include "checker/document/plain_markdown.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>

namespace veritrack::checker {

namespace {

/// The characters that the program escapes with a backslash.
constexpr std::string_view kEscapable = R"(\`*_{}[]<>#+!|$~&)";

/// Characters beyond ASCII. None of them looks like a letter of a verdict except one, which is taken for that
/// letter.
constexpr std::array<std::string_view, 18> kOther{"—", "–", "²", "∈", "≈", "≤", "≥", "±", "·",
                                                  "×", "→", "−", "π", "é", "°", "µ", "α", "ε"};

/// The commands of TeX in formulas. None of them changes letters, or draws one that PROVED or REFUTED has.
const std::set<std::string, std::less<>>& commands() {
  static const std::set<std::string, std::less<>> known{
      "Delta",  "Gamma",  "Lambda",    "Omega",      "Phi",    "Sigma",     "Vert",   "alpha", "angle",
      "approx", "arg",    "bar",       "begin",      "beta",   "big",       "bigl",   "bigr",  "cdot",
      "chi",    "circ",   "cos",       "delta",      "det",    "dim",       "ell",    "end",   "epsilon",
      "eta",    "exp",    "frac",      "gamma",      "ge",     "geq",       "hat",    "in",    "inf",
      "infty",  "int",    "kappa",     "lVert",      "lambda", "ldots",     "le",     "left",  "leq",
      "liminf", "limsup", "ln",        "log",        "lvert",  "mathcal",   "mathrm", "max",   "mid",
      "min",    "mu",     "ne",        "nu",         "omega",  "partial",   "phi",    "pi",    "pm",
      "psi",    "quad",   "rVert",     "rho",        "right",  "rvert",     "sigma",  "sin",   "sqrt",
      "sum",    "sup",    "tan",       "tau",        "text",   "textstyle", "tfrac",  "theta", "tilde",
      "times",  "to",     "underline", "varepsilon", "varphi", "varrho",    "vert",   "xi",    "zeta"};
  return known;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_letter_or_digit(char c) {
  return is_letter(c) || (c >= '0' && c <= '9');
}
bool is_control(char c) {
  return (c >= 0 && c < ' ') || c == '\x7f';
}

constexpr const char* kStrange = "a character that the program does not write";

/// The length of the character at the beginning, of those that may stand anywhere; 0 for another one.
std::size_t plain_character(std::string_view text) {
  if (static_cast<unsigned char>(text[0]) < 0x80U) {
    return is_control(text[0]) ? 0 : 1;
  }
  const auto* const other =
      std::find_if(kOther.begin(), kOther.end(), [&](std::string_view one) { return text.starts_with(one); });
  return other == kOther.end() ? 0 : other->size();
}

/// One line: the part that is refused, and the letters that are seen.
class Line {
 public:
  Line(std::string_view text, std::string& seen) : text_(text), seen_(seen) {}

  std::string as_it_is() {
    while (refused_.empty() && !rest().empty()) {
      take();
    }
    return refused_;
  }

  std::string as_tex() {
    while (refused_.empty() && !rest().empty()) {
      if (rest()[0] != '\\') {
        refused_ = rest()[0] == '%' || rest()[0] == '#' || rest()[0] == '$' ? "a mark of TeX" : "";
        take();
        continue;
      }
      const std::string_view behind = rest().substr(1);
      const auto length = static_cast<std::size_t>(std::find_if_not(behind.begin(), behind.end(), is_letter) -
                                                   behind.begin());
      if (length > 0
              ? commands().count(behind.substr(0, length)) == 0
              : behind.empty() || std::string_view(R"(,;:! {}|\)").find(behind[0]) == std::string::npos) {
        refused_ = "a command of TeX that the program does not write";
      }
      at_ += 1 + std::max<std::size_t>(length, 1);
    }
    return refused_;
  }

  std::string as_markdown() {
    if (text_.starts_with("![") && text_.ends_with(')')) {
      at_ = 2;  // a picture, on a line of its own
    }
    if (text_.substr(std::min(text_.find_first_not_of(" -*>"), text_.size())).starts_with("```")) {
      return "a fence inside a line";
    }
    while (refused_.empty() && !rest().empty()) {
      take_mark();
    }
    return refused_;
  }

 private:
  [[nodiscard]] std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }

  void take() {
    const std::size_t length = plain_character(rest());
    if (length == 0) {
      refused_ = kStrange;
      return;
    }
    if (is_letter_or_digit(rest()[0])) {
      seen_ += rest()[0];
    } else if (rest().starts_with("ε")) {
      seen_ += 'E';  // which it looks like
    }
    at_ += length;
  }

  void take_mark() {
    const std::string_view here = rest();
    const char next = here.size() > 1 ? here[1] : ' ';
    if (here[0] == '\\') {
      refused_ = kEscapable.find(next) == std::string_view::npos ? "a backslash" : "";
      at_ += 2;
    } else if (here[0] == '`') {
      take_code();
    } else if (here[0] == '$') {
      take_formula();
    } else if (here.starts_with("](")) {
      take_target();
    } else {
      refused_ =
          here[0] == '<' && (is_letter(next) || std::string_view("/!?").find(next) != std::string::npos)
              ? "HTML"
          : here[0] == '&' && (is_letter_or_digit(next) || next == '#') ? "a character reference"
          : here[0] == '~'                                              ? "a tilde"
          : here.starts_with("![")                                      ? "a picture inside a line"
          : here.starts_with("[^")                                      ? "a footnote"
          : here.starts_with("]:") && may_be_definition()               ? "the definition of a link"
          : here[0] == ':' && is_short_code()                           ? "an emoji"
                                                                        : "";
      take();
    }
  }

  /// The definition of a link, which a reader does not see, begins its line, or one before it.
  [[nodiscard]] bool may_be_definition() const {
    const std::size_t opening = text_.substr(0, at_).find('[');
    return opening == std::string_view::npos || text_.find_first_not_of(" >*-+.)0123456789") == opening;
  }

  /// ":name:", which some renderers show as a picture.
  [[nodiscard]] bool is_short_code() const {
    const std::string_view name = rest().substr(1, rest().find(':', 1) - 1);
    return rest().find(':', 1) != std::string_view::npos && !name.empty() &&
           std::all_of(name.begin(), name.end(),
                       [](char c) { return is_letter_or_digit(c) || c == '_' || c == '-' || c == '+'; });
  }

  void take_code() {
    const std::size_t ticks = std::min(rest().find_first_not_of('`'), rest().size());
    std::size_t end = ticks;
    std::size_t behind = ticks;
    do {  // the next row of as many
      end = std::min(rest().find('`', behind), rest().size());
      behind = std::min(rest().find_first_not_of('`', end), rest().size());
    } while (end < rest().size() && behind - end != ticks);
    if (end == rest().size()) {
      refused_ = "code that does not end in its line";
      return;
    }
    const std::string_view code = rest().substr(ticks, end - ticks);
    refused_ = code.find('$') != std::string_view::npos ? "a dollar in code" : Line(code, seen_).as_it_is();
    at_ += behind;
  }

  void take_formula() {
    const std::size_t end = rest().find("`$", 2);
    if (!rest().starts_with("$`") || end == std::string_view::npos) {
      refused_ = "a dollar that is no formula";
      return;
    }
    const std::string_view formula = rest().substr(2, end - 2);
    refused_ =
        formula.find('`') != std::string_view::npos ? "code in a formula" : Line(formula, seen_).as_tex();
    at_ += end + 2;
  }

  /// The target of a link or a picture: a file beside the document, or a place in it.
  void take_target() {
    const std::size_t end = rest().find(')');
    const std::string_view target = rest().substr(0, end).substr(2);
    const bool is_plain =
        end != std::string_view::npos && std::all_of(target.begin(), target.end(), [](char c) {
          return is_letter_or_digit(c) || std::string_view("._/#-").find(c) != std::string_view::npos;
        });
    refused_ = is_plain ? "" : "the target of a link";
    at_ += is_plain ? end + 1 : 0;
  }

  std::string_view text_;
  std::string& seen_;
  std::size_t at_ = 0;
  std::string refused_;
};

/// The word, with a zero for its O, and some of its letters small.
bool is_verdict(std::string_view letters, std::string_view word) {
  std::size_t capitals = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char small = static_cast<char>(word[i] - 'A' + 'a');
    const bool is_capital = letters[i] == word[i] || (word[i] == 'O' && letters[i] == '0');
    if (!is_capital && letters[i] != small) {
      return false;
    }
    capitals += is_capital ? 1 : 0;
  }
  // "Proved" begins a sentence.
  return capitals > 1;
}

}  // namespace

std::string quotation_of(const std::string& name, const std::string& source) {
  const auto escaped = [](const std::string& text) {
    std::string result;
    for (const char letter : text) {
      result += kEscapable.find(letter) != std::string_view::npos ? "\\" : "";
      result += letter == '\n' || letter == '\r' ? ' ' : letter;
    }
    return result;
  };
  return "> " + escaped(name) + (source.empty() ? "" : ", from: " + escaped(source));
}

std::optional<std::string> PlainMarkdown::objection_to_seen() {
  for (const std::string_view word : {"PROVED", "REFUTED"}) {
    for (std::size_t i = 0; i + word.size() <= seen_.size(); ++i) {
      if (is_verdict(std::string_view(seen_).substr(i), word)) {
        return "gives a verdict that was not verified";
      }
    }
  }
  constexpr std::size_t kLongestWord = 7;
  seen_.erase(0, seen_.size() - std::min(seen_.size(), kLongestWord - 1));
  return std::nullopt;
}

std::optional<std::string> PlainMarkdown::objection_to(std::string_view line) {
  const std::string refused = Line(line, seen_).as_markdown();
  return refused.empty() ? objection_to_seen() : "has " + refused;
}

std::optional<std::string> PlainMarkdown::objection_to_fenced(std::string_view line, bool is_math) {
  Line fenced(line, seen_);
  const std::string refused = is_math ? fenced.as_tex() : fenced.as_it_is();
  return refused.empty() ? objection_to_seen() : "has " + refused;
}

}  // namespace veritrack::checker

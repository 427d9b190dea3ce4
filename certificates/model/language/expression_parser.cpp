// The grammar of formulas, by PEGTL.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <tao/pegtl.hpp>
#include <tuple>

#include "certificates/design/input_error.hpp"
#include "certificates/model/language/expression.hpp"
#include "certificates/model/language/written_out.hpp"

namespace veritrack::certificates::language {

// NOLINTBEGIN(readability-identifier-naming): rules are written as those of PEGTL are.
namespace grammar {

using namespace tao::pegtl;  // NOLINT(google-build-using-namespace): a grammar is made of it

struct comment : seq<one<'#'>, until<at<eolf>>> {};
struct blank_space : sor<one<' ', '\t'>, comment> {};
struct any_space : sor<blank_space, eol> {};
/// Inside parentheses a formula goes on over the end of a line.
template <bool Inside>
struct spaces : star<std::conditional_t<Inside, any_space, blank_space>> {};

struct letter : sor<alpha, one<'_'>> {};
struct word : seq<letter, star<sor<letter, digit>>> {};
struct plain_name : list<word, one<'.'>> {};
struct name : seq<plain_name, opt<one<'\''>>> {};
struct digits : plus<digit> {};
struct scale : seq<one<'e', 'E'>, opt<one<'+', '-'>>, digits> {};
struct number : seq<sor<seq<digits, opt<one<'.'>, star<digit>>>, seq<one<'.'>, digits>>, opt<scale>> {};
struct exponent : digits {};

struct argument;  // the whole grammar again, between parentheses

struct function : word {};
struct comma : one<','> {};
struct close : one<')'> {};
struct open_call : one<'('> {};
/// Looks ahead, so that no action is applied to a name that turns out not to be a function.
struct starts_a_call : at<word, spaces<false>, one<'('>> {};
struct comparison : seq<one<'<', '>'>, opt<one<'='>>> {};
struct comparison_and_right : if_must<comparison, spaces<true>, argument> {};
/// A condition is the first argument of `if` (the compiler sees to it). Ends with the spaces behind it.
struct compared : seq<argument, spaces<true>, opt<comparison_and_right, spaces<true>>> {};
struct call : if_must<starts_a_call, function, spaces<false>, open_call, spaces<true>, compared,
                      star<if_must<comma, spaces<true>, compared>>, close> {};
struct group : if_must<one<'('>, spaces<true>, argument, spaces<true>, close> {};
struct primary : sor<number, call, name, group> {};
template <bool Inside>
struct power : seq<primary, opt<spaces<Inside>, if_must<one<'^'>, spaces<Inside>, exponent>>> {};
struct minus_sign : one<'-'> {};
template <bool Inside>
struct factor;
template <bool Inside>
struct negation : if_must<minus_sign, spaces<Inside>, factor<Inside>> {};
template <bool Inside>
struct factor : sor<negation<Inside>, power<Inside>> {};
template <bool Inside>
struct times : if_must<one<'*'>, spaces<Inside>, factor<Inside>> {};
template <bool Inside>
struct over : if_must<one<'/'>, spaces<Inside>, factor<Inside>> {};
template <bool Inside>
struct term : seq<factor<Inside>, star<spaces<Inside>, sor<times<Inside>, over<Inside>>>> {};
template <bool Inside>
struct plus_term : if_must<one<'+'>, spaces<Inside>, term<Inside>> {};
template <bool Inside>
struct minus_term : if_must<one<'-'>, spaces<Inside>, term<Inside>> {};
template <bool Inside>
struct sum : seq<term<Inside>, star<spaces<Inside>, sor<plus_term<Inside>, minus_term<Inside>>>> {};

struct argument : sum<true> {};
struct value : sum<false> {};
struct whole_text : must<spaces<true>, argument, spaces<true>, eof> {};

struct equals : one<'='> {};
struct defined_name : name {};
struct end_of_line : eolf {};
struct definition
    : if_must<defined_name, spaces<false>, equals, spaces<false>, value, spaces<false>, end_of_line> {};
struct no_more_lines : eof {};
struct whole_step : must<star<any_space>, star<definition, star<any_space>>, no_more_lines> {};

}  // namespace grammar
// NOLINTEND(readability-identifier-naming)

namespace {

/// The expected text where a rule failed.
template <typename Rule>
inline constexpr std::string_view kAllowed = "a number, a name, a function, a minus sign or (";
template <>
inline constexpr std::string_view kAllowed<grammar::compared> = kAllowed<grammar::argument>;
template <>
inline constexpr std::string_view kAllowed<grammar::close> = "an operator or ) (or a comma in a function)";
template <>
inline constexpr std::string_view kAllowed<grammar::exponent> =
    "a whole exponent, 1 or more (otherwise sqrt, or exp and log)";
template <>
inline constexpr std::string_view kAllowed<grammar::equals> = "= behind the name that is defined";
template <>
inline constexpr std::string_view kAllowed<grammar::end_of_line> = "an operator, or the end of the line";
template <>
inline constexpr std::string_view kAllowed<grammar::no_more_lines> =
    "a definition: name = formula, or state' = formula";
template <>
inline constexpr std::string_view kAllowed<tao::pegtl::eof> = "an operator, or the end of the formula";

constexpr int kDeepest = 1000;           // operations one inside the other
constexpr int kDeepestNesting = 64;      // open parentheses and minus signs before them
constexpr std::size_t kShownLimit = 30;  // bytes of the text found instead

/// The parts that the parser has built so far.
struct Building {
  Position start;  ///< of the text
  std::vector<Expression> operands;
  std::vector<std::size_t> open_calls;  ///< how many operands there were
  std::vector<std::pair<std::string, Position>> functions;
  std::vector<Position> minus_signs;
  std::vector<std::string> comparisons;  ///< whose right side is being read
  std::vector<Definition> definitions;

  [[nodiscard]] Position at(std::size_t line, std::size_t column) const {
    const int lines_down = static_cast<int>(line) - 1;
    const int across = static_cast<int>(column);
    return {start.line + lines_down, lines_down == 0 ? start.column + across - 1 : across};
  }
  template <typename Input>
  [[nodiscard]] Position place_of(const Input& input) const {
    const auto place = input.position();
    return at(place.line, place.column);
  }
  /// Adds a formula that is made of these.
  void push(Expression::Kind kind, Position position, std::string text, int exponent,
            std::vector<Expression> parts) {
    int depth = 0;
    for (const Expression& part : parts) {
      depth = std::max(depth, part.depth);
    }
    if (depth >= kDeepest) {
      throw LanguageError(position,
                          fmt::format("a formula with more than {} operations one inside the other; "
                                      "allowed: a name for a part of it, on a line of its own",
                                      kDeepest));
    }
    operands.push_back({kind, position, std::move(text), exponent, depth + 1, std::move(parts)});
  }
  /// Removes the last formula.
  [[nodiscard]] Expression pop() {
    Expression last = std::move(operands.back());
    operands.pop_back();
    return last;
  }
  void join(Expression::Kind kind) {
    std::vector<Expression> parts(2);
    parts[1] = pop();
    parts[0] = pop();
    const Position position = parts[0].position;
    push(kind, position, {}, 0, std::move(parts));
  }
  /// The last formula becomes the only operand of another one.
  void wrap(Expression::Kind kind, Position position, int exponent) {
    std::vector<Expression> parts(1);
    parts[0] = pop();
    push(kind, position, {}, exponent, std::move(parts));
  }
};

template <typename Rule>
struct Action {};
template <Expression::Kind kind>
struct Leaf {
  template <typename Input>
  static void apply(const Input& input, Building& building) {
    building.push(kind, building.place_of(input), input.string(), 0, {});
  }
};
template <>
struct Action<grammar::number> : Leaf<Expression::Kind::number> {};
template <>
struct Action<grammar::name> : Leaf<Expression::Kind::name> {};

template <Expression::Kind kind>
struct Join {
  static void apply0(Building& building) { building.join(kind); }
};
template <bool Inside>
struct Action<grammar::times<Inside>> : Join<Expression::Kind::product> {};
template <bool Inside>
struct Action<grammar::over<Inside>> : Join<Expression::Kind::quotient> {};
template <bool Inside>
struct Action<grammar::plus_term<Inside>> : Join<Expression::Kind::sum> {};
template <bool Inside>
struct Action<grammar::minus_term<Inside>> : Join<Expression::Kind::difference> {};

template <>
struct Action<grammar::exponent> {
  template <typename Input>
  static void apply(const Input& input, Building& building) {
    constexpr int kLargest = 16;
    int exponent = 0;
    const std::string text = input.string();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
    const bool is_read = error == std::errc() && end == text.data() + text.size();
    if (!is_read || exponent > kLargest || exponent == 0) {
      throw LanguageError(building.place_of(input),
                          fmt::format("the exponent {} is too {}; allowed: 1 to {}", printable(text, 40),
                                      is_read && exponent == 0 ? "small" : "large", kLargest));
    }
    const Position position = building.operands.back().position;
    building.wrap(Expression::Kind::power, position, exponent);
  }
};

template <>
struct Action<grammar::minus_sign> {
  template <typename Input>
  static void apply(const Input& input, Building& building) {
    building.minus_signs.push_back(building.place_of(input));
  }
};
template <bool Inside>
struct Action<grammar::negation<Inside>> {
  static void apply0(Building& building) {
    const Position position = building.minus_signs.back();
    building.minus_signs.pop_back();
    building.wrap(Expression::Kind::negation, position, 0);
  }
};

template <>
struct Action<grammar::function> {
  template <typename Input>
  static void apply(const Input& input, Building& building) {
    building.functions.emplace_back(input.string(), building.place_of(input));
  }
};
template <>
struct Action<grammar::open_call> {
  static void apply0(Building& building) { building.open_calls.push_back(building.operands.size()); }
};
template <>
struct Action<grammar::call> {
  static void apply0(Building& building) {
    auto [function, position] = std::move(building.functions.back());
    building.functions.pop_back();
    const auto first = building.operands.begin() + static_cast<std::ptrdiff_t>(building.open_calls.back());
    building.open_calls.pop_back();
    std::vector<Expression> arguments(std::make_move_iterator(first),
                                      std::make_move_iterator(building.operands.end()));
    building.operands.erase(first, building.operands.end());
    if (std::optional<Expression> formula = written_out(function, position, arguments)) {
      building.operands.push_back(*std::move(formula));
      return;
    }
    building.push(Expression::Kind::call, position, std::move(function), 0, std::move(arguments));
  }
};

template <>
struct Action<grammar::comparison> {
  template <typename Input>
  static void apply(const Input& input, Building& building) {
    building.comparisons.push_back(input.string());
  }
};
template <>
struct Action<grammar::comparison_and_right> {
  static void apply0(Building& building) {
    building.join(Expression::Kind::comparison);
    building.operands.back().text = std::move(building.comparisons.back());
    building.comparisons.pop_back();
  }
};

template <>
struct Action<grammar::defined_name> {
  template <typename Input>
  static void apply(const Input& input, Building& building) {
    building.definitions.push_back({input.string(), building.place_of(input), {}});
  }
};
template <>
struct Action<grammar::value> {
  static void apply0(Building& building) { building.definitions.back().value = building.pop(); }
};

/// The text there, for a message.
std::string found_at(std::string_view rest) {
  if (rest.empty()) {
    return "the text ends";
  }
  const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
  return line.empty() ? "the line ends" : fmt::format("found \"{}\"", printable(line, kShownLimit));
}

/// Advice where somebody has written a condition in the manner of another language: `x > 0 ? a : b`, `if x >
/// 0`.
std::string_view advice_on_conditions(std::string_view before, std::string_view rest) {
  constexpr std::string_view kBlank = " \t";
  constexpr std::string_view kSigns = "?<>!&|";
  before = before.substr(0, before.find_last_not_of(kBlank) + 1);
  const bool is_equality = rest.starts_with("==") || rest.starts_with("!=") || before.ends_with("==") ||
                           (rest.starts_with("=") && before.find('(') != std::string_view::npos);
  const bool is_sign = !rest.empty() && kSigns.find(rest.front()) != std::string_view::npos;
  bool is_word = false;
  constexpr std::string_view kBetween = " \t\r\n=()";
  for (const std::string_view word : {"if", "else", "then", "elif", "and", "or", "not"}) {
    const std::string_view earlier = before.substr(0, before.size() - std::min(word.size(), before.size()));
    const std::string_view later = rest.substr(std::min(word.size(), rest.size()));
    is_word =
        is_word ||
        (before.ends_with(word) &&
         (earlier.empty() || kBetween.find(earlier.back()) != std::string_view::npos)) ||
        (rest.starts_with(word) && (later.empty() || kBetween.find(later.front()) != std::string_view::npos));
  }
  return is_equality ? "; of two values in floating point write x < y, x <= y, x > y or x >= y"
         : is_sign || is_word
             ? "; a condition is written if(x > y, a, b), which is a where x > y, else b; other signs: < <= "
               ">=; two conditions: an if inside the other"
             : std::string_view();
}

/// The author of the text must repair a rule that must match and does not.
template <typename Rule>
struct Control : tao::pegtl::normal<Rule> {
  template <typename Input>
  [[noreturn]] static void raise(const Input& input, Building& building) {
    const std::string_view rest(input.current(), input.size());
    const std::string_view before(input.begin(), static_cast<std::size_t>(input.current() - input.begin()));
    throw LanguageError(
        building.place_of(input),
        fmt::format("{}; allowed: {}{}", found_at(rest), kAllowed<Rule>, advice_on_conditions(before, rest)));
  }
};

/// The grammar calls itself: nesting is limited before that can matter.
void require_modest_nesting(const SourceText& source) {
  int depth = 0;
  int minus_signs = 0;
  Position place = source.position;
  for (const char character : source.text) {
    depth += character == '(' ? 1 : 0;
    depth -= character == ')' && depth > 0 ? 1 : 0;
    minus_signs = character == '-'
                      ? minus_signs + 1
                      : (character == ' ' || character == '\t' || character == '(' ? minus_signs : 0);
    if (depth + minus_signs > kDeepestNesting) {
      throw LanguageError(place, fmt::format("parentheses and signs more than {} deep; allowed: a name for a "
                                             "part of the formula, on a line of its own",
                                             kDeepestNesting));
    }
    place = character == '\n' ? Position{place.line + 1, 1} : Position{place.line, place.column + 1};
  }
}

template <typename Rule>
Building parse(const SourceText& source) {
  require_modest_nesting(source);
  Building building;
  building.start = source.position;
  tao::pegtl::memory_input<tao::pegtl::tracking_mode::eager, tao::pegtl::eol::lf_crlf> input(source.text, "");
  tao::pegtl::parse<Rule, Action, Control>(input, building);
  return building;
}

}  // namespace

Expression parse_expression(const SourceText& source) {
  return parse<grammar::whole_text>(source).pop();
}

std::vector<Definition> parse_definitions(const SourceText& source) {
  return parse<grammar::whole_step>(source).definitions;
}

}  // namespace veritrack::certificates::language

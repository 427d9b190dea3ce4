#include "checker/model/formula.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

namespace veritrack::checker {

namespace {

using Kind = FormulaStep::Kind;

constexpr std::size_t kMostSteps = 100'000;
constexpr int kLargestExponent = 16;
constexpr int kMostArguments = 3;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// An operator that waits until its right operand is complete. Higher binds tighter.
struct Waiting {
  enum class What { open, call, binary, sign };
  What what = What::open;
  int strength = 0;
  FormulaStep step;
};

/// Reads formulas out of a text, one after the other.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return at_ == text_.size(); }
  [[noreturn]] void fail(const std::string& what) const {
    throw FormulaError(what + " at character " + std::to_string(at_ + 1));
  }
  /// Blanks and comments, and line ends if they mean nothing here.
  void skip(bool over_lines) {
    while (!at_end()) {
      const char c = text_[at_];
      if (c == '#') {
        while (!at_end() && text_[at_] != '\n') {
          ++at_;
        }
      } else if (c == ' ' || c == '\t' || (over_lines && is_line_end())) {
        ++at_;
      } else {
        return;
      }
    }
  }
  /// A line feed, or the carriage return before one.
  [[nodiscard]] bool is_line_end() const {
    return text_[at_] == '\n' || (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n');
  }
  void pass_line_end() {
    while (!at_end() && is_line_end()) {
      ++at_;
    }
  }
  [[nodiscard]] bool take(char expected) {
    if (at_end() || text_[at_] != expected) {
      return false;
    }
    ++at_;
    return true;
  }
  [[nodiscard]] std::string word() {
    const std::size_t begin = at_;
    while (!at_end() && (is_letter(text_[at_]) || is_digit(text_[at_]))) {
      ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }
  /// Words with points between them, and a prime: empty when there is no letter.
  [[nodiscard]] std::string name() {
    if (at_end() || !is_letter(text_[at_])) {
      return {};
    }
    std::string name = word();
    while (at_ + 1 < text_.size() && text_[at_] == '.' && is_letter(text_[at_ + 1])) {
      ++at_;
      name += '.' + word();
    }
    return take('\'') ? name + '\'' : name;
  }
  /// A formula, up to the end of the text or, with `lines`, of the line.
  [[nodiscard]] Formula formula(bool lines);

 private:
  [[nodiscard]] std::string digits() {
    const std::size_t begin = at_;
    while (!at_end() && is_digit(text_[at_])) {
      ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }
  [[nodiscard]] std::string number();
  void operand();
  [[nodiscard]] bool operation();
  void close();
  void comparison();
  void complete(int strength);
  void emit(FormulaStep step) {
    result_.push_back(std::move(step));
    if (result_.size() > kMostSteps) {
      fail("a formula without end");
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Formula result_;
  std::vector<Waiting> waiting_;
  int open_ = 0;  // parentheses
  bool operand_is_next_ = true;
};

std::string Reader::number() {
  std::string number = digits();
  const bool starts_with_digits = !number.empty();
  if (!at_end() && text_[at_] == '.') {
    ++at_;
    const std::string fraction = digits();
    if (!starts_with_digits && fraction.empty()) {
      fail("a point without digits");
    }
    number += '.' + fraction;
  }
  // An exponent has digits; otherwise the letter begins something else.
  std::size_t ahead = at_ + 1;
  if (ahead < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
    ahead += text_[ahead] == '+' || text_[ahead] == '-' ? 1U : 0U;
    if (ahead < text_.size() && is_digit(text_[ahead])) {
      number += text_.substr(at_, ahead - at_);
      at_ = ahead;
      number += digits();
    }
  }
  return number;
}

/// Waiting operators that bind at least this tightly now have their operands.
void Reader::complete(int strength) {
  while (!waiting_.empty() && waiting_.back().strength >= strength) {
    emit(waiting_.back().step);
    waiting_.pop_back();
  }
}

/// A number, a name, a sign, or what opens a parenthesis.
void Reader::operand() {
  constexpr int kSignStrength = 4;
  if (take('-')) {
    waiting_.push_back({Waiting::What::sign, kSignStrength, {Kind::negate, {}, 0}});
  } else if (take('(')) {
    waiting_.push_back({});
    ++open_;
  } else if (!at_end() && (is_digit(text_[at_]) || text_[at_] == '.')) {
    emit({Kind::number, number(), 0});
    operand_is_next_ = false;
  } else {
    const std::string read = name();
    if (read.empty()) {
      fail("something that is no operand");
    }
    skip(false);
    const bool can_be_called = read.find_first_of(".'") == std::string::npos;
    if (can_be_called && take('(')) {
      waiting_.push_back({Waiting::What::call, 0, {Kind::function, read, 1}});
      ++open_;
    } else {
      emit({Kind::name, read, 0});
      operand_is_next_ = false;
    }
  }
}

/// The innermost parenthesis closes.
void Reader::close() {
  constexpr int kAnyStrength = 1;
  complete(kAnyStrength);
  if (waiting_.empty()) {
    fail("a parenthesis that nothing opens");
  }
  if (waiting_.back().what == Waiting::What::call) {
    emit(waiting_.back().step);
  }
  waiting_.pop_back();
  --open_;
}

/// Between the two sides of a condition, the first argument of `if`: x < y is kept as x - y.
void Reader::comparison() {
  std::string sign(1, text_[at_++]);
  sign += take('=') ? "=" : "";
  constexpr int kStrength = 1;
  complete(kStrength);
  if (waiting_.empty() || waiting_.back().what != Waiting::What::call || waiting_.back().step.text != "if" ||
      waiting_.back().step.count != 1) {
    fail("a condition that is not the first argument of if");
  }
  waiting_.back().step.text += ' ' + sign;
  waiting_.push_back({Waiting::What::binary, kStrength, {Kind::subtract, {}, 0}});
  operand_is_next_ = true;
}

/// The token after an operand: false when it is not part of a formula.
bool Reader::operation() {
  if (take(')')) {
    close();
    return true;
  }
  if (take(',')) {
    complete(1);
    if (waiting_.empty() || waiting_.back().what != Waiting::What::call) {
      fail("a comma outside a function");
    }
    if (++waiting_.back().step.count > kMostArguments) {
      fail("too many arguments");
    }
    operand_is_next_ = true;
    return true;
  }
  if (!at_end() && (text_[at_] == '<' || text_[at_] == '>')) {
    comparison();
    return true;
  }
  if (take('^')) {
    skip(open_ > 0);
    const std::string exponent = digits();
    // x^0 is 1 where x is defined: a way not to look at x.
    if (exponent.empty() || exponent.size() > 2 || std::stoi(exponent) > kLargestExponent ||
        std::stoi(exponent) == 0) {
      fail("an exponent that is not allowed");
    }
    emit({Kind::power, {}, std::stoi(exponent)});
    skip(open_ > 0);
    if (!at_end() && text_[at_] == '^') {
      fail("a power of a power");
    }
    return true;
  }
  constexpr int kSumStrength = 2;
  constexpr int kProductStrength = 3;
  const auto binary = [&](Kind kind, int strength) {
    complete(strength);
    waiting_.push_back({Waiting::What::binary, strength, {kind, {}, 0}});
    operand_is_next_ = true;
    return true;
  };
  if (take('+')) {
    return binary(Kind::add, kSumStrength);
  }
  if (take('-')) {
    return binary(Kind::subtract, kSumStrength);
  }
  if (take('*')) {
    return binary(Kind::multiply, kProductStrength);
  }
  return take('/') && binary(Kind::divide, kProductStrength);
}

Formula Reader::formula(bool lines) {
  result_.clear();
  waiting_.clear();
  open_ = 0;
  operand_is_next_ = true;
  while (true) {
    skip(open_ > 0 || !lines);
    if (operand_is_next_) {
      operand();
    } else if (at_end() || (lines && open_ == 0 && is_line_end())) {
      break;
    } else if (!operation()) {
      fail("something that is no operator");
    }
  }
  complete(1);
  if (!waiting_.empty()) {
    fail("a parenthesis that is not closed");
  }
  return result_;
}

}  // namespace

Formula read_formula(std::string_view text) {
  return Reader(text).formula(false);
}

std::vector<FormulaLine> read_lines(std::string_view text) {
  Reader reader(text);
  std::vector<FormulaLine> lines;
  while (true) {
    reader.skip(true);
    if (reader.at_end()) {
      return lines;
    }
    const std::string name = reader.name();
    reader.skip(false);
    if (name.empty() || !reader.take('=')) {
      reader.fail("something that is no definition");
    }
    lines.push_back({name, reader.formula(true)});
    reader.pass_line_end();
  }
}

std::vector<FormulaLine> in_order_of_need(const std::vector<FormulaLine>& lines) {
  std::map<std::string, bool> is_placed;
  for (const FormulaLine& line : lines) {
    if (!is_placed.try_emplace(line.name, false).second) {
      throw FormulaError(line.name + " is defined twice");
    }
  }
  const auto can_be_placed = [&](const FormulaLine& line) {
    return std::all_of(line.value.begin(), line.value.end(), [&](const FormulaStep& step) {
      const auto needed = step.kind == Kind::name ? is_placed.find(step.text) : is_placed.end();
      return needed == is_placed.end() || needed->second;
    });
  };
  std::vector<FormulaLine> ordered;
  while (ordered.size() < lines.size()) {
    const std::size_t before = ordered.size();
    for (const FormulaLine& line : lines) {
      if (!is_placed.at(line.name) && can_be_placed(line)) {
        is_placed.at(line.name) = true;
        ordered.push_back(line);
      }
    }
    if (ordered.size() == before) {
      throw FormulaError("definitions that need each other");
    }
  }
  return ordered;
}

bool is_limit(const FormulaLine& line) {
  const FormulaStep& last = line.value.back();
  return last.kind == Kind::function && last.text == "stays_within";
}

void leave_out_outer_wraps(std::vector<FormulaLine>& lines, const std::vector<std::string>& angles) {
  std::set<std::string> used;
  for (const FormulaLine& line : lines) {
    for (const FormulaStep& step : line.value) {
      if (step.kind == Kind::name) {
        used.insert(step.text);
      }
    }
  }
  for (FormulaLine& line : lines) {
    const bool is_angle = std::any_of(angles.begin(), angles.end(),
                                      [&](const std::string& angle) { return line.name == angle + '\''; });
    const auto is_wrapped = [&] {
      const FormulaStep& last = line.value.back();
      return last.kind == Kind::function && last.text == "wrap" && last.count == 1;
    };
    while (is_angle && !used.contains(line.name) && !line.value.empty() && is_wrapped()) {
      line.value.pop_back();
    }
  }
}

const FormulaLine* unused_line(const std::vector<FormulaLine>& ordered,
                               const std::vector<std::string>& results) {
  std::set<std::string> needed(results.begin(), results.end());
  for (auto line = ordered.rbegin(); line != ordered.rend(); ++line) {
    if (!is_limit(*line) && !needed.contains(line->name)) {
      return &*line;
    }
    for (const FormulaStep& step : line->value) {
      if (step.kind == Kind::name) {
        needed.insert(step.text);
      }
    }
  }
  return nullptr;
}

}  // namespace veritrack::checker

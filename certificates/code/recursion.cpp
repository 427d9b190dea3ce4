#include "certificates/code/recursion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "analysis/model/code/listing_rounding.hpp"
#include "analysis/model/code/turned_sample.hpp"
#include "analysis/model/code/turns.hpp"
#include "certificates/code/angles.hpp"
#include "certificates/code/comparisons.hpp"

namespace veritrack::certificates::code {

namespace {

using model::code::kMostOfWrapped, model::code::kWrapSlack, model::code::Range, model::code::Turns;

using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

/// A formula, and how tightly its outermost operation binds.
struct Formula {
  enum class Binds { sum, product, atom };
  std::string text;
  Binds binds = Binds::atom;

  [[nodiscard]] std::string as_term() const { return text; }
  [[nodiscard]] std::string as_factor() const { return binds == Binds::sum ? "(" + text + ")" : text; }
  [[nodiscard]] std::string as_atom() const { return binds == Binds::atom ? text : "(" + text + ")"; }
};

/// The decimal that is exactly the number.
Formula exact_decimal(double number) {
  std::string text = fmt::format("{:.17g}", std::fabs(number));
  if (std::strtod(text.c_str(), nullptr) != std::fabs(number) || number != std::round(number)) {
    text = fmt::format("{:.800g}", std::fabs(number));
  }
  return number < 0.0 ? Formula{"-" + text, Formula::Binds::sum} : Formula{text};
}

struct Named {
  Operation operation;
  std::string_view name;
};
constexpr std::array kFunctions{
    Named{Operation::sqrt, "sqrt"},  Named{Operation::fabs, "abs"},  Named{Operation::sin, "sin"},
    Named{Operation::cos, "cos"},    Named{Operation::tan, "tan"},   Named{Operation::asin, "asin"},
    Named{Operation::acos, "acos"},  Named{Operation::atan, "atan"}, Named{Operation::exp, "exp"},
    Named{Operation::log, "log"},    Named{Operation::tanh, "tanh"}, Named{Operation::atan2, "atan2"},
    Named{Operation::hypot, "hypot"}};

class Writer {
 public:
  explicit Writer(const Listing& listing)
      : listing_(&listing), turns_(listing), angles_(listing, turns_), comparisons_(listing, turns_) {
    const auto take = [&](int value, const std::string& name) {
      std::string free = name;
      while (kTaken.contains(free) || !taken_.insert(free).second) {
        free += '_';
      }
      names_[value] = free;
      return free;
    };
    for (std::size_t i = 0; i < listing.samples.size(); ++i) {
      result_.samples.push_back(take(listing.samples[i], listing.sample_names[i]));
    }
    for (const trackers::code::State& state : listing.states) {
      result_.states.push_back(take(state.input, state.name));
    }
  }

  [[nodiscard]] Recursion written() {
    for (const bool counts : {true, false}) {
      counts_ = counts;
      formulas_.clear();
      lines_.clear();
      limits_.clear();
      given_.clear();
      write();
    }
    for (const std::string& line : lines_) {
      result_.step += line + "\n";
    }
    result_.ranges = angles_.ranges();
    result_.bases = angles_.bases();
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Instruction& at(int value) const {
    return listing_->instructions[static_cast<std::size_t>(value)];
  }
  [[noreturn]] void refuse(int value, const std::string& text) const {
    throw NoRecursion(text, at(value).place);
  }

  void write() {
    result_.angles.clear();
    result_.start.clear();
    std::vector<std::string> next;
    for (std::size_t i = 0; i < listing_->states.size(); ++i) {
      const trackers::code::State& state = listing_->states[i];
      const trackers::code::Format format = at(state.input).format;
      if (!format.is_float) {
        refuse(state.next,
               fmt::format("{} is an integer that the frequency depends on; allowed: numbers", state.name));
      }
      const bool is_angle = angles_.is_angle(state.input);
      const Formula value = is_angle ? angle(state.next) : formula(state.next);
      next.push_back(fmt::format("{}' = {}", result_.states[i], value.text));
      if (is_angle) {
        result_.angles.push_back(result_.states[i]);
      }
      result_.start.push_back(exact_decimal(trackers::code::number_of(format, state.start_bits)).text);
    }
    for (const trackers::code::Obligation& obligation : listing_->obligations) {
      write_obligation(obligation);
    }
    lines_.insert(lines_.end(), next.begin(), next.end());
    result_.frequency = inlined(listing_->frequency).text;
  }

  /// A formula of its own, without the lines of the step.
  [[nodiscard]] Formula inlined(int value) {
    inlines_ = true;
    formulas_.clear();
    Formula result = formula(value);
    inlines_ = false;
    formulas_.clear();
    return result;
  }

  // ---- angles

  /// A value modulo whole turns.
  [[nodiscard]] Formula angle(int value) {
    if (!turns_.is_wrapped(value)) {
      angles_.require_wraps(value);
      return unwrapped(value);
    }
    const int base = turns_.without_turns(value);
    limit_step(base);
    return unwrapped(base);
  }

  /// An angle and what a choice adds to it: that is a number.
  [[nodiscard]] Formula unwrapped(int value) {
    const std::optional<Angles::Rest> rest = angles_.rest_of(value);
    if (!rest || rest->choices == 0 || rest->arc >= 0) {
      return formula(value);
    }
    return {angle(rest->angle).as_term() + " + " + rest_formula(*rest).as_factor(), Formula::Binds::sum};
  }

  [[nodiscard]] Formula rest_formula(const Angles::Rest& rest) {
    Formula sum{"0"};
    for (std::size_t i = 0; i < rest.terms.size(); ++i) {
      const Angles::Term& term = rest.terms[i];
      const auto branch = [&](std::size_t k) {
        return rest_formula(*angles_.rest_of(at(term.value).operands[k]));
      };
      const Formula part = term.is_choice ? chosen_of(
                                                at(term.value).operands[0], [&] { return branch(1); },
                                                [&] { return branch(2); })
                                          : formula(term.value);
      if (i == 0) {
        sum = term.is_subtracted ? Formula{"-" + part.as_factor(), Formula::Binds::sum} : part;
      } else {
        sum = {sum.as_term() + (term.is_subtracted ? " - " : " + ") + part.as_factor(), Formula::Binds::sum};
      }
    }
    return sum;
  }

  /// The range of a wrapped value rests on steps of less than half a turn.
  void limit_step(int base) {
    const std::optional<Angles::Rest> rest = angles_.has_step(base) ? angles_.rest_of(base) : std::nullopt;
    if (!rest || rest->terms.empty() || !limits_.insert(base).second) {
      return;
    }
    const bool is_forward = rest->arc < 0 && angles_.steps() == Angles::Steps::forward;
    const bool is_backward = rest->arc < 0 && angles_.steps() == Angles::Steps::backward;
    const std::string least = fmt::format("{}", Angles::kLeastStep);
    const std::string step = rest_formula(*rest).text;
    lines_.push_back(fmt::format("{} = stays_within({}, {}, {})", free_name("turn"), step,
                                 is_forward ? least : "-pi", is_backward ? "-" + least : "pi"));
    if (turns_.is_wrapped(rest->angle)) {
      limit_step(turns_.without_turns(rest->angle));
    }
  }

  /// A wrapped value that is used as a number: between minus and plus half a turn.
  [[nodiscard]] Formula wrapped(int value) {
    const std::optional<Range> range = angles_.range(value);
    constexpr double kHalfTurn = std::numbers::pi + 10.0 * kWrapSlack;
    if (!range || range->low < -kHalfTurn || range->high > kHalfTurn) {
      refuse(value,
             "a difference of angles that is not certainly wrapped to minus half a turn to half a turn; "
             "allowed: "
             "e.g. if (e > PI) e -= 2*PI; else if (e < -PI) e += 2*PI, of two angles that are");
    }
    const int base = turns_.without_turns(value);
    limit_step(base);
    const Instruction& difference = at(base);
    const int arc = difference.operation == Operation::fsub ? turns_.plain(difference.operands[0]) : -1;
    if (arc < 0 || at(arc).operation != Operation::atan2) {
      return limited_wrap(value, fmt::format("wrap({})", formula(base).text));
    }
    const std::string y = formula(at(arc).operands[0]).as_factor();
    const std::string x = formula(at(arc).operands[1]).as_factor();
    const std::string z = angle(difference.operands[1]).text;
    return limited_wrap(
        value, fmt::format("atan2({0}*cos({2}) - {1}*sin({2}), {1}*cos({2}) + {0}*sin({2}))", y, x, z));
  }

  /// A line of its own for a wrapped value, or the angle of a sample that is turned back, which is to stay
  /// away from half a turn: next to it, rounding would turn it over.
  [[nodiscard]] Formula limited_wrap(int value, const std::string& text) {
    if (inlines_) {
      result_.ranges_keep_obligations = false;  // nothing limits it
      return {text};
    }
    const std::string name = free_name("r");
    lines_.push_back(fmt::format("{} = {}", name, text));
    if (limits_.insert(value).second) {
      lines_.push_back(
          fmt::format("{0} = stays_within({1}, -{2}, {2})", free_name("turn"), name, kMostOfWrapped));
    }
    return {name};
  }

  // ---- formulas

  [[nodiscard]] std::string free_name(const std::string& begin) {
    for (int i = 1;; ++i) {
      std::string name = fmt::format("{}{}", begin, i);
      if (!taken_.contains(name) && given_.insert(name).second) {
        return name;
      }
    }
  }

  /// The formula of a register: a name where it has a line of its own.
  [[nodiscard]] Formula formula(int value) {
    value = turns_.plain(value);
    if (const auto name = names_.find(value); name != names_.end()) {
      return {name->second};
    }
    if (!inlines_ && counts_) {
      ++uses_[value];
    }
    if (const auto known = formulas_.find(value); known != formulas_.end()) {
      return known->second;
    }
    Formula made = operation(value);
    constexpr std::size_t kLongest = 100;
    const bool is_constant = at(value).operation == Operation::constant;
    if (!inlines_ && !counts_ && !is_constant && (uses_[value] > 1 || made.text.size() > kLongest) &&
        !given_.contains(made.text)) {
      const std::string name = free_name("r");
      lines_.push_back(fmt::format("{} = {}", name, made.text));
      made = {name};
    }
    formulas_[value] = made;
    return made;
  }

  [[nodiscard]] Formula operation(int value) {
    const Instruction& instruction = at(value);
    const auto operand = [&](std::size_t i) { return formula(instruction.operands[i]); };
    using Binds = Formula::Binds;
    if (turns_.is_wrapped(value)) {
      return wrapped(value);
    }
    switch (instruction.operation) {
      case Operation::constant: {
        const double number = trackers::code::number_of(instruction.format, instruction.bits);
        if (!instruction.format.is_float || !std::isfinite(number)) {
          refuse(value, "a constant that is no number");
        }
        return exact_decimal(number);
      }
      case Operation::fadd:
        return {operand(0).as_term() + " + " + operand(1).as_factor(), Binds::sum};
      case Operation::fsub:
        return {operand(0).as_term() + " - " + operand(1).as_factor(), Binds::sum};
      case Operation::fmul:
        if (instruction.operands[0] == instruction.operands[1]) {
          return {operand(0).as_atom() + "^2", Binds::product};
        }
        return {operand(0).as_factor() + "*" + operand(1).as_factor(), Binds::product};
      case Operation::fdiv:
        return {operand(0).as_factor() + "/" + operand(1).as_atom(), Binds::product};
      case Operation::fneg:
        return {"-" + operand(0).as_factor(), Binds::sum};
      case Operation::fma:
        return {operand(0).as_factor() + "*" + operand(1).as_factor() + " + " + operand(2).as_factor(),
                Binds::sum};
      case Operation::select:
      case Operation::fmin:
      case Operation::fmax:
        return choice(value);
      default:
        return function(value);
    }
  }

  [[nodiscard]] Formula function(int value) {
    const Instruction& instruction = at(value);
    if (value == listing_->near_arc_tangent.value) {
      refuse(value,
             "the angle of the samples, nearly, which is used as a number; allowed: its difference to an "
             "angle, wrapped to minus half a turn to half a turn");
    }
    const auto* found = std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Named& entry) {
      return entry.operation == instruction.operation;
    });
    if (found == kFunctions.end()) {
      const auto* name = trackers::code::name_of(instruction.operation);
      refuse(value, fmt::format("{} has no rule yet that makes it a formula of real numbers",
                                name == nullptr ? "an input that is no number" : name->name));
    }
    const bool is_periodic =
        instruction.operation == Operation::sin || instruction.operation == Operation::cos;
    std::string operands =
        is_periodic ? angle(instruction.operands[0]).text : formula(instruction.operands[0]).text;
    if (instruction.operands[1] >= 0) {
      operands += ", " + formula(instruction.operands[1]).text;
    }
    const std::string text = fmt::format("{}({})", found->name, operands);
    return model::code::turned_back_by(*listing_, instruction) ? limited_wrap(value, text) : Formula{text};
  }

  // ---- choices

  [[nodiscard]] Formula choice(int value) {
    const Limited limits = comparisons_.limited(value);
    if (limits.low && limits.high) {
      return {fmt::format("clamp({}, {}, {})", formula(limits.value).text, exact_decimal(*limits.low).text,
                          exact_decimal(*limits.high).text)};
    }
    if (limits.low || limits.high) {
      return {fmt::format("{}({}, {})", limits.low ? "max" : "min", formula(limits.value).text,
                          exact_decimal(limits.low ? *limits.low : *limits.high).text)};
    }
    const Instruction& instruction = at(value);
    if (instruction.operation != Operation::select) {
      return {fmt::format("{}({}, {})", instruction.operation == Operation::fmin ? "min" : "max",
                          formula(instruction.operands[0]).text, formula(instruction.operands[1]).text)};
    }
    return chosen(instruction.operands[0], instruction.operands[1], instruction.operands[2]);
  }

  [[nodiscard]] Formula chosen(int condition, int yes, int no) {
    return chosen_of(
        condition, [&] { return formula(yes); }, [&] { return formula(no); });
  }

  [[nodiscard]] Formula chosen_of(int condition, const std::function<Formula()>& yes,
                                  const std::function<Formula()>& no) {
    const Instruction& instruction = at(condition);
    const int a = instruction.operands[0];
    const int b = instruction.operands[1];
    if (instruction.operation == Operation::bit_and) {
      return chosen_of(
          a, [&] { return chosen_of(b, yes, no); }, no);
    }
    if (instruction.operation == Operation::bit_or) {
      return chosen_of(a, yes, [&] { return chosen_of(b, yes, no); });
    }
    if (instruction.operation == Operation::select) {
      const int c = instruction.operands[2];
      return chosen_of(
          a, [&] { return chosen_of(b, yes, no); }, [&] { return chosen_of(c, yes, no); });
    }
    if (instruction.operation == Operation::constant) {
      return instruction.bits != 0 ? yes() : no();
    }
    if (instruction.operation == Operation::bit_xor && at(b).operation == Operation::constant &&
        at(b).bits != 0) {
      return chosen_of(a, no, yes);
    }
    if (instruction.operation == Operation::fcmp && instruction.predicate == Predicate::uno) {
      return no();  // a certified value is a number
    }
    if (instruction.operation == Operation::fcmp && instruction.predicate == Predicate::ord) {
      return yes();
    }
    const std::optional<Less> comparison = comparisons_.less(condition);
    if (!comparison) {
      refuse(condition,
             "a choice by an integer, or by whether two numbers are equal, which no rule makes a formula of "
             "real numbers");
    }
    const std::string first = formula(comparison->first).text;
    const std::string second = formula(comparison->second).text;
    Formula if_less = comparison->negated ? no() : yes();
    const Formula otherwise = comparison->negated ? yes() : no();
    if (if_less.text == otherwise.text) {
      return if_less;
    }
    if (second == "0" && otherwise.text == first && if_less.text == "-" + first) {
      return {fmt::format("abs({})", first)};
    }
    if (if_less.text == first && otherwise.text == second) {
      return {fmt::format("min({}, {})", first, second)};
    }
    if (if_less.text == second && otherwise.text == first) {
      return {fmt::format("max({}, {})", first, second)};
    }
    return {fmt::format("if({} < {}, {}, {})", first, second, if_less.text, otherwise.text)};
  }

  // ---- obligations

  void write_obligation(const trackers::code::Obligation& obligation) {
    const int condition = obligation.must_be_zero;
    for (const auto& [base, range] : angles_.bases()) {
      if (turns_.is_never(condition, base, range)) {
        limit_step(base);
        return;
      }
    }
    result_.ranges_keep_obligations = false;
    const std::optional<Less> comparison = comparisons_.less(condition);
    if (!comparison) {
      throw NoRecursion(fmt::format("nothing shows that {}", obligation.why), obligation.place);
    }
    const std::string difference =
        fmt::format("{} - {}", formula(comparison->second).text, formula(comparison->first).as_factor());
    constexpr std::string_view kFar = "1e30";
    lines_.push_back(comparison->negated
                         ? fmt::format("{} = stays_within({}, 0, {})", free_name("must"), difference, kFar)
                         : fmt::format("{} = stays_within({}, -{}, 0)", free_name("must"), difference, kFar));
  }

  inline static const std::set<std::string> kTaken{
      "A",    "phi",  "omega", "pi",    "sqrt", "exp", "log",  "sin",   "cos",   "tan",
      "asin", "acos", "atan",  "atan2", "min",  "max", "abs",  "sign",  "clamp", "if",
      "else", "then", "elif",  "and",   "or",   "not", "wrap", "hypot", "tanh",  "stays_within"};

  const Listing* listing_;
  Turns turns_;
  Angles angles_;
  Comparisons comparisons_;
  Recursion result_;
  std::map<int, std::string> names_;
  std::set<std::string> taken_;  ///< names of samples and states
  std::set<std::string> given_;  ///< names of lines
  std::set<int> limits_;         ///< of these, those whose step is limited by a line
  std::map<int, Formula> formulas_;
  std::map<int, int> uses_;
  std::vector<std::string> lines_;
  bool counts_ = false;   ///< the first time through, which counts uses
  bool inlines_ = false;  ///< no lines
};

}  // namespace

Recursion recursion_of(const Listing& listing) {
  return Writer(listing).written();
}

}  // namespace veritrack::certificates::code

#include "certificates/model/language/written_listing.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/language/definition_order.hpp"

namespace veritrack::certificates::language {

namespace {

namespace ieee = trackers::code;
using Code = ieee::Operation;

/// Of a decimal, or pi.
rigor::Interval exact_number(const std::string& text) {
  const rigor::UpwardRounding upward;
  return text == "pi" ? rigor::pi() : rigor::parse_decimal(text);
}

/// The number of the format nearest to a decimal.
double nearest_number(const std::string& decimal, ieee::Format format) {
  if (format.bits == 64) {
    return rigor::nearest_double(decimal);
  }
  const rigor::NearestRounding nearest;
  float value = 0.0F;
  const auto [end, error] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Too large, or below the range: what that is off is in the bounds.
    return rigor::nearest_double(decimal) > 1.0 ? std::numeric_limits<double>::infinity() : 0.0;
  }
  return static_cast<double>(value);
}

struct NamedCode {
  std::string_view name;
  Code operation;
};
constexpr std::array kIeeeFunctions{
    NamedCode{"sqrt", Code::sqrt}, NamedCode{"exp", Code::exp},     NamedCode{"log", Code::log},
    NamedCode{"sin", Code::sin},   NamedCode{"cos", Code::cos},     NamedCode{"tan", Code::tan},
    NamedCode{"asin", Code::asin}, NamedCode{"acos", Code::acos},   NamedCode{"atan", Code::atan},
    NamedCode{"abs", Code::fabs},  NamedCode{"atan2", Code::atan2}, NamedCode{"min", Code::fmin},
    NamedCode{"max", Code::fmax},
};

class ListingWriter {
 public:
  explicit ListingWriter(ieee::Format format) : format_(format) {}

  [[nodiscard]] WrittenListing write(const WrittenRecursion& recursion) {
    for (const NamedFormula& parameter : recursion.parameters) {
      names_[parameter.name] = place_of(parameter.formula);
      result_.names.try_emplace(names_[parameter.name], parameter.name);
    }
    ieee::Listing& listing = result_.listing;
    for (const std::string& state : recursion.states) {
      names_[state] = input();
      listing.states.push_back({state, names_[state], -1, 0});
    }
    for (const std::string& sample : recursion.samples) {
      names_[sample] = input();
      listing.samples.push_back(names_[sample]);
      listing.sample_names.push_back(sample);
    }
    for (const Definition* line : in_order(recursion.step)) {
      const int place = place_of(line->value);
      names_[line->name] = place;
      result_.names.try_emplace(place, line->name);
      if (line->value.kind == Expression::Kind::call && line->value.text == "stays_within") {
        const auto& limits = line->value.operands;
        result_.facts.limits.push_back({place, place_of(limits[1]), place_of(limits[2])});
      }
    }
    for (ieee::State& state : listing.states) {
      const bool is_angle =
          std::find(recursion.angles.begin(), recursion.angles.end(), state.name) != recursion.angles.end();
      const int next = names_.at(state.name + "'");
      state.next = is_angle ? wrapped(next) : next;
    }
    listing.frequency = place_of(recursion.frequency);
    std::erase_if(result_.facts.limits, [&](const model::code::RegisterLimit& limit) {
      return !is_constant(limit.low) || !is_constant(limit.high);
    });
    return std::move(result_);
  }

 private:
  /// An operation that is there already is that one.
  int append(Code operation, const std::vector<int>& operands,
             ieee::Predicate predicate = ieee::Predicate::none) {
    ieee::Instruction made;
    made.operation = operation;
    made.format = predicate == ieee::Predicate::none ? format_ : ieee::kBit;
    made.predicate = predicate;
    made.place = {-1, position_.line, position_.column};
    std::copy(operands.begin(), operands.end(), made.operands.begin());
    const auto [known, is_new] = known_.try_emplace({operation, predicate, made.operands}, registers());
    if (is_new) {
      result_.listing.instructions.push_back(made);
    }
    return known->second;
  }
  [[nodiscard]] int registers() const { return static_cast<int>(result_.listing.instructions.size()); }
  int input() {
    ieee::Instruction made;
    made.operation = Code::input;
    made.format = format_;
    result_.listing.instructions.push_back(made);
    return registers() - 1;
  }
  int number(const std::string& text) {
    const auto known = names_.find(text);
    if (known != names_.end()) {
      return known->second;
    }
    const rigor::NearestRounding nearest;
    const bool is_pi = text == "pi";
    const double value = ieee::number_of(
        format_, ieee::bits_of(format_, is_pi ? std::numbers::pi : nearest_number(text, format_)));
    const int place = input();
    result_.facts.numbers[place] = {exact_number(text), value};
    return names_[text] = place;
  }
  /// A constant of the program itself.
  int constant(double value) {
    ieee::Instruction made;
    made.format = format_;
    made.bits = ieee::bits_of(format_, value);
    result_.listing.instructions.push_back(made);
    return registers() - 1;
  }
  int wrapped(int value) {
    const rigor::NearestRounding nearest;
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const int turn = constant(kTurn);
    const int count = append(Code::rint, {append(Code::fmul, {value, constant(1.0 / kTurn)})});
    return append(Code::fsub, {value, append(Code::fmul, {turn, count})});
  }
  /// Whether it is made of numbers alone.
  [[nodiscard]] bool is_constant(int place) const {
    const ieee::Instruction& made = result_.listing.instructions[static_cast<std::size_t>(place)];
    if (made.operation == Code::input) {
      return result_.facts.numbers.contains(place);
    }
    return std::all_of(made.operands.begin(), made.operands.end(),
                       [&](int operand) { return operand < 0 || is_constant(operand); });
  }

  [[nodiscard]] int place_of(const Expression& formula) {
    if (formula.kind == Expression::Kind::number || formula.text == "pi") {
      return number(formula.text);
    }
    if (formula.kind == Expression::Kind::name) {
      return names_.at(formula.text);
    }
    if (formula.kind == Expression::Kind::call && formula.text == "if") {
      return choice(formula);
    }
    std::vector<int> operands;
    for (const Expression& operand : formula.operands) {
      operands.push_back(place_of(operand));
    }
    position_ = formula.position;
    switch (formula.kind) {
      case Expression::Kind::negation:
        return append(Code::fneg, operands);
      case Expression::Kind::sum:
        return append(Code::fadd, operands);
      case Expression::Kind::difference:
        return append(Code::fsub, operands);
      case Expression::Kind::product:
        return append(Code::fmul, operands);
      case Expression::Kind::quotient:
        return append(Code::fdiv, operands);
      case Expression::Kind::power: {
        int power = operands[0];
        for (int i = 1; i < formula.exponent; ++i) {
          power = append(Code::fmul, {power, operands[0]});
        }
        return power;
      }
      default:
        return call(formula.text, operands);
    }
  }

  [[nodiscard]] int call(const std::string& name, const std::vector<int>& operands) {
    if (name == "stays_within") {
      return operands[0];
    }
    if (name == "clamp") {
      result_.facts.ordered.emplace_back(operands[1], operands[2]);
      return append(Code::fmin, {append(Code::fmax, {operands[0], operands[1]}), operands[2]});
    }
    if (name == "sign") {
      const int zero = number("0");
      const int one = number("1");
      const int below = append(Code::select, {append(Code::fcmp, {operands[0], zero}, ieee::Predicate::olt),
                                              append(Code::fneg, {one}), zero});
      return append(Code::select,
                    {append(Code::fcmp, {operands[0], zero}, ieee::Predicate::ogt), one, below});
    }
    const auto* const found = std::find_if(kIeeeFunctions.begin(), kIeeeFunctions.end(),
                                           [&](const NamedCode& each) { return each.name == name; });
    if (found == kIeeeFunctions.end()) {
      throw std::logic_error("the function " + name + " has no operation");
    }
    return append(found->operation, operands);
  }
  [[nodiscard]] int choice(const Expression& call) {
    const Expression& condition = call.operands[0];
    const int left = place_of(condition.operands[0]);
    const int right = place_of(condition.operands[1]);
    const int yes = place_of(call.operands[1]);
    const int no = place_of(call.operands[2]);
    position_ = call.position;
    const ieee::Predicate predicate = condition.text == "<"    ? ieee::Predicate::olt
                                      : condition.text == "<=" ? ieee::Predicate::ole
                                      : condition.text == ">"  ? ieee::Predicate::ogt
                                                               : ieee::Predicate::oge;
    return append(Code::select, {append(Code::fcmp, {left, right}, predicate), yes, no});
  }

  ieee::Format format_;
  WrittenListing result_;
  std::map<std::string, int> names_;
  std::map<std::tuple<Code, ieee::Predicate, std::array<int, 3>>, int> known_;
  Position position_;
};

}  // namespace

WrittenListing written_listing(const WrittenRecursion& recursion, ieee::Format format) {
  return ListingWriter(format).write(recursion);
}

ieee::Listing with_constants(const WrittenListing& written) {
  ieee::Listing listing = written.listing;
  for (const auto& [place, number] : written.facts.numbers) {
    ieee::Instruction& made = listing.instructions[static_cast<std::size_t>(place)];
    made.operation = Code::constant;
    made.bits = ieee::bits_of(made.format, number.value);
  }
  return listing;
}

}  // namespace veritrack::certificates::language

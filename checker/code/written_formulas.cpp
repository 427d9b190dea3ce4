#include "checker/code/written_formulas.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "checker/model/formula.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

struct Renamed {
  std::string_view formula, listing;
};
constexpr std::array kOneToOne{Renamed{"sqrt", "sqrt"}, Renamed{"exp", "exp"},   Renamed{"log", "log"},
                               Renamed{"sin", "sin"},   Renamed{"cos", "cos"},   Renamed{"tan", "tan"},
                               Renamed{"asin", "asin"}, Renamed{"acos", "acos"}, Renamed{"atan", "atan"},
                               Renamed{"abs", "fabs"}};
constexpr std::array kOfTwo{Renamed{"atan2", "atan2"}, Renamed{"min", "fmin"}, Renamed{"max", "fmax"}};

class FormulaLister {
 public:
  explicit FormulaLister(ListedFormat format) : format_(format) {}

  WrittenFormulas list(const Tree& model) {
    for (const Tree& parameter : model.at("parameters").elements()) {
      places_[parameter.at("name").text()] = place_of(read_formula(parameter.at("formula").text()));
    }
    for (const Tree& state : model.at("states").elements()) {
      ListedState listed;
      listed.name = state.text();
      listed.input = places_[listed.name] = add("input", {});
      result_.listing.states.push_back(std::move(listed));
    }
    for (const Tree& sample : model.at("samples").elements()) {
      result_.listing.samples.push_back(places_[sample.text()] = add("input", {}));
      result_.listing.sample_names.push_back(sample.text());
    }
    std::vector<std::string> angles;
    for (const Tree& angle : model.at("angles").elements()) {
      angles.push_back(angle.text());
    }
    std::vector<FormulaLine> lines = read_lines(model.at("step").text());
    leave_out_outer_wraps(lines, angles);
    for (const FormulaLine& line : in_order_of_need(lines)) {
      places_[line.name] = place_of(line.value);
      if (is_limit(line) && is_of_numbers(limit_.low) && is_of_numbers(limit_.high)) {
        result_.known.limits.push_back(limit_);
      }
    }
    for (ListedState& state : result_.listing.states) {
      state.next = known_place(state.name + '\'');
      if (std::find(angles.begin(), angles.end(), state.name) != angles.end()) {
        keep_in_half_turn(state);
      }
    }
    result_.listing.frequency = place_of(read_formula(model.at("frequency").text()));
    return std::move(result_);
  }

 private:
  const ListedOperation& at(int place) const { return result_.listing.at(place); }

  int add(std::string name, std::vector<int> operands, std::string predicate = {}) {
    ListedOperation operation;
    operation.name = std::move(name);
    operation.format = predicate.empty() ? format_ : ListedFormat{false, 1};
    operation.predicate = std::move(predicate);
    operation.operands = std::move(operands);
    // The same operation on the same registers is the same value.
    std::vector<ListedOperation>& all = result_.listing.operations;
    const bool is_new = operation.is("input") || operation.is("turned");
    const auto same = std::find_if(all.begin(), all.end(), [&](const ListedOperation& other) {
      return !is_new && other.name == operation.name && other.predicate == operation.predicate &&
             other.operands == operation.operands;
    });
    if (same != all.end()) {
      return static_cast<int>(same - all.begin());
    }
    constexpr std::size_t kMostOperations = 20'000;
    if (all.size() >= kMostOperations) {
      throw FormulaError("formulas with very many operations");
    }
    all.push_back(std::move(operation));
    return static_cast<int>(all.size()) - 1;
  }

  int number(const std::string& text) {
    const auto known = places_.find(text);
    if (known != places_.end()) {
      return known->second;
    }
    const bool is_pi = text == "pi";
    const char* digits = is_pi ? "3.14159265358979323846264338" : text.c_str();
    const double value =
        format_.bits == 32 ? static_cast<double>(std::strtof(digits, nullptr)) : std::strtod(digits, nullptr);
    const int place = add("input", {});
    result_.known.numbers[place] = {is_pi ? pi() : from_decimal(text), value};
    return places_[text] = place;
  }

  int known_place(const std::string& name) const {
    const auto found = places_.find(name);
    if (found == places_.end()) {
      throw FormulaError(name + " is unknown");
    }
    return found->second;
  }

  /// Made of numbers alone.
  bool is_of_numbers(int place) const {
    const std::vector<int>& operands = at(place).operands;
    return at(place).is("input")
               ? result_.known.numbers.contains(place)
               : std::all_of(operands.begin(), operands.end(), [&](int each) { return is_of_numbers(each); });
  }

  void keep_in_half_turn(ListedState& state) {
    constexpr double kMostAngle = 3.1417;  // half a turn, and what the wrap may be off
    ListedWrap wrap;
    wrap.base = state.next;
    wrap.is_of_any_base = true;
    state.next = add("turned", {wrap.base});
    result_.known.wraps[state.next] = wrap;
    result_.known.states[state.input] = Ball::within(Ball(kMostAngle));
  }

  int place_of(const Formula& formula) {
    std::vector<int> stack;
    const auto take = [&](std::size_t count) {
      if (stack.size() < count) {
        throw FormulaError("a formula that is not whole");
      }
      std::vector<int> taken(stack.end() - static_cast<std::ptrdiff_t>(count), stack.end());
      stack.resize(stack.size() - count);
      return taken;
    };
    for (const FormulaStep& step : formula) {
      if (step.kind == FormulaStep::Kind::number ||
          (step.kind == FormulaStep::Kind::name && step.text == "pi")) {
        stack.push_back(number(step.text));
      } else if (step.kind == FormulaStep::Kind::name) {
        stack.push_back(known_place(step.text));
      } else if (step.kind == FormulaStep::Kind::negate) {
        stack.push_back(add("fneg", take(1)));
      } else if (step.kind == FormulaStep::Kind::power) {
        stack.push_back(power(take(1)[0], step.count));
      } else if (step.kind == FormulaStep::Kind::function) {
        stack.push_back(function(step.text, take(static_cast<std::size_t>(step.count))));
      } else {
        const char* name = step.kind == FormulaStep::Kind::add        ? "fadd"
                           : step.kind == FormulaStep::Kind::subtract ? "fsub"
                           : step.kind == FormulaStep::Kind::multiply ? "fmul"
                                                                      : "fdiv";
        stack.push_back(add(name, take(2)));
      }
    }
    return take(1)[0];
  }

  int power(int x, int n) {
    int product = x;
    for (int i = 1; i < n; ++i) {
      product = add("fmul", {product, x});
    }
    return product;
  }

  int function(const std::string& name, const std::vector<int>& x) {
    const auto is = [&](std::string_view known, std::size_t count) {
      return name == known && x.size() == count;
    };
    const auto renamed = [&](const auto& all, std::size_t count) -> const Renamed* {
      const auto found =
          std::find_if(all.begin(), all.end(), [&](const Renamed& each) { return is(each.formula, count); });
      return found == all.end() ? nullptr : &*found;
    };
    for (const Renamed* found : {renamed(kOneToOne, 1), renamed(kOfTwo, 2)}) {
      if (found != nullptr) {
        return add(std::string(found->listing), x);
      }
    }
    if (is("hypot", 2)) {
      return add("sqrt", {add("fadd", {power(x[0], 2), power(x[1], 2)})});
    }
    if (is("tanh", 1)) {
      const int growth = add("exp", {add("fmul", {number("2"), x[0]})});
      return add("fsub", {number("1"), add("fdiv", {number("2"), add("fadd", {growth, number("1")})})});
    }
    if (is("wrap", 1)) {
      return add("atan2", {add("sin", x), add("cos", x)});
    }
    if (is("stays_within", 3)) {
      limit_ = {x[0], x[1], x[2]};
      return x[0];
    }
    if (is("clamp", 3)) {
      result_.known.ordered.emplace_back(x[1], x[2]);
      return add("fmin", {add("fmax", {x[0], x[1]}), x[2]});
    }
    if (is("sign", 1)) {
      const int zero_place = number("0");
      const int below =
          add("select", {add("fcmp", {x[0], zero_place}, "olt"), add("fneg", {number("1")}), zero_place});
      return add("select", {add("fcmp", {x[0], zero_place}, "ogt"), number("1"), below});
    }
    return choice(name, x);
  }

  /// if(x < y, a, b) has x - y, a and b.
  int choice(const std::string& name, const std::vector<int>& x) {
    const std::string sign = name.starts_with("if ") ? name.substr(3) : "";
    const std::string predicate = sign == "<"    ? "olt"
                                  : sign == "<=" ? "ole"
                                  : sign == ">"  ? "ogt"
                                  : sign == ">=" ? "oge"
                                                 : "";
    if (predicate.empty() || x.size() != 3 || !at(x[0]).is("fsub")) {
      throw FormulaError("no function " + name + " with that many arguments");
    }
    return add("select", {add("fcmp", at(x[0]).operands, predicate), x[1], x[2]});
  }

  ListedFormat format_;
  WrittenFormulas result_;
  std::map<std::string, int> places_;
  ListedLimit limit_;  ///< the one that was read last
};

}  // namespace

WrittenFormulas written_formulas(const Tree& model, ListedFormat format) {
  return FormulaLister(format).list(model);
}

std::optional<ListedFormat> written_format(const Tree& model) {
  const Tree* arithmetic = model.find("arithmetic");
  if (arithmetic == nullptr || arithmetic->is("exact")) {
    return std::nullopt;
  }
  if (!arithmetic->is("binary32") && !arithmetic->is("binary64")) {
    throw Malformed("the arithmetic is exact, binary32 or binary64");
  }
  return ListedFormat{true, arithmetic->is("binary32") ? 32 : 64};
}

}  // namespace veritrack::checker

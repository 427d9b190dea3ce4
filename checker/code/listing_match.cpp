#include "checker/code/listing_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "checker/code/choice_match.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

using Kind = FormulaStep::Kind;

/// Calls in each other, so that no input exhausts the memory for them.
class Level {
 public:
  explicit Level(int& depth) : depth_(&depth) {
    constexpr int kDeepest = 400;
    if (++*depth_ > kDeepest) {
      throw Malformed("the listing's operations are nested too deeply");
    }
    spend();
  }
  ~Level() { --*depth_; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

 private:
  int* depth_;
};

struct SameFunction {
  std::string_view formula, operation;
};
/// Of numbers: those of angles are apart.
constexpr std::array kSameFunctions{
    SameFunction{"sqrt", "sqrt"},   SameFunction{"abs", "fabs"},   SameFunction{"tan", "tan"},
    SameFunction{"asin", "asin"},   SameFunction{"acos", "acos"},  SameFunction{"atan", "atan"},
    SameFunction{"exp", "exp"},     SameFunction{"log", "log"},    SameFunction{"tanh", "tanh"},
    SameFunction{"hypot", "hypot"}, SameFunction{"atan2", "atan2"}};

}  // namespace

bool ListingMatch::number(int node, int place) {
  node = graph_->without_limits(node);
  place = wraps_.plain(place);
  const Pair pair{node, place};
  if (const auto known = numbers_.find(pair); known != numbers_.end()) {
    return known->second;
  }
  const Level level(depth_);
  const bool is_same = number_by_rules(node, place);
  numbers_[pair] = is_same;
  if (is_same) {
    matched_.insert(pair);
  }
  return is_same;
}

bool ListingMatch::number_by_rules(int node, int place) {
  const FormulaNode& formula = graph_->at(node);
  const ListedOperation& operation = listing_->at(place);
  if (formula.state >= 0) {
    const auto state = static_cast<std::size_t>(formula.state);
    return place == listing_->states[state].input && !is_angle_[state];
  }
  if (formula.sample >= 0) {
    return place == listing_->samples[static_cast<std::size_t>(formula.sample)];
  }
  if (operation.is("input")) {
    return false;
  }
  if (operation.name == "constant") {
    return operation.format.is_float && is_constant(node, operation.number);
  }
  if (wraps_.is_wrapped(place)) {
    return is_within_half_turn(node, place);
  }
  if (is_function(node, place)) {
    return true;
  }
  if (is_choice_of_registers(operation) || is_choice_of_formulas(formula)) {
    return ChoiceMatch(*this).is_same(node, place);
  }
  return is_sum(node, place, false) || is_product(node, place) || is_fused(node, place);
}

bool ListingMatch::is_constant(int node, double number) const {
  bool is_negative = false;
  while (graph_->at(node).kind == Kind::negate) {
    node = graph_->at(node).arguments[0];
    is_negative = !is_negative;
  }
  if (graph_->at(node).kind != Kind::number || !std::isfinite(number)) {
    return false;
  }
  ExactDecimal written = exact_decimal(graph_->at(node).text);
  written.is_negative = is_negative && !written.digits.empty();
  return written == exact_decimal(number);
}

bool ListingMatch::is_function(int node, int place) {
  const FormulaNode& formula = graph_->at(node);
  const ListedOperation& operation = listing_->at(place);
  if (formula.kind != Kind::function || formula.arguments.size() != operation.operands.size()) {
    return false;
  }
  if ((formula.text == "sin" && operation.is("sin")) || (formula.text == "cos" && operation.is("cos"))) {
    return congruent(formula.arguments[0], operation.operands[0]);
  }
  const bool is_same = std::any_of(
      kSameFunctions.begin(), kSameFunctions.end(),
      [&](const SameFunction& each) { return formula.text == each.formula && operation.is(each.operation); });
  if (!is_same) {
    return false;
  }
  for (std::size_t i = 0; i < formula.arguments.size(); ++i) {
    if (!number(formula.arguments[i], operation.operands[i])) {
      return false;
    }
  }
  return true;
}

bool ListingMatch::is_fused(int node, int place) {
  const FormulaNode& formula = graph_->at(node);
  const ListedOperation& operation = listing_->at(place);
  if (formula.kind != Kind::add || !operation.is("fma")) {
    return false;
  }
  const std::vector<int> factors{operation.operands[0], operation.operands[1]};
  const int added = operation.operands[2];
  const int first = formula.arguments[0];
  const int second = formula.arguments[1];
  return (number(second, added) && same_factors(first, factors)) ||
         (number(first, added) && same_factors(second, factors));
}

// ---- angles

bool ListingMatch::congruent(int node, int place) {
  node = graph_->without_limits(node);
  place = wraps_.plain(place);
  const Pair pair{node, place};
  if (const auto known = congruences_.find(pair); known != congruences_.end()) {
    return known->second;
  }
  const Level level(depth_);
  return congruences_[pair] = congruent_by_rules(node, place);
}

bool ListingMatch::congruent_by_rules(int node, int place) {
  const FormulaNode& formula = graph_->at(node);
  if (wraps_.is_wrapped(place)) {
    return congruent(node, wraps_.base_of(place));
  }
  if (formula.is_function("wrap", 1)) {
    return congruent(formula.arguments[0], place);
  }
  if (formula.state >= 0 && is_angle_[static_cast<std::size_t>(formula.state)]) {
    return place == listing_->states[static_cast<std::size_t>(formula.state)].input;
  }
  return number(node, place) || is_sum(node, place, true) || is_whole_multiple(node, place) ||
         is_choice_of_sums(terms_of_node(node), place, -1);
}

/// Turns stay turns in k*angle with a whole number k.
bool ListingMatch::is_whole_multiple(int node, int place) {
  const FormulaNode& formula = graph_->at(node);
  const ListedOperation& operation = listing_->at(place);
  if (formula.kind != Kind::multiply || !operation.is("fmul")) {
    return false;
  }
  constexpr double kMost = 1024.0;
  for (const std::size_t k : {0U, 1U}) {
    const std::optional<double> factor = wraps_.number(operation.operands[k]);
    if (factor && *factor == std::nearbyint(*factor) && std::fabs(*factor) <= kMost) {
      for (const std::size_t i : {0U, 1U}) {
        if (is_constant(formula.arguments[i], *factor) &&
            congruent(formula.arguments[1 - i], operation.operands[1 - k])) {
          return true;
        }
      }
    }
  }
  return false;
}

bool ListingMatch::is_within_half_turn(int node, int place) {
  const FormulaNode& formula = graph_->at(node);
  const int base = wraps_.base_of(place);
  const bool is_wrap = formula.is_function("wrap", 1);
  if (!is_wrap && !formula.is_function("atan2", 2)) {
    return false;
  }
  const std::optional<Span> range = span(place);
  constexpr double kHalfTurn = std::numbers::pi + kHalfTurnSlack;
  if (!range || range->low < -kHalfTurn || range->high > kHalfTurn) {
    return false;
  }
  if (is_wrap) {
    return congruent(formula.arguments[0], base);
  }
  const FormulaNode& sine = graph_->at(graph_->without_limits(formula.arguments[0]));
  const FormulaNode& cosine = graph_->at(graph_->without_limits(formula.arguments[1]));
  if (sine.is_function("sin", 1) && cosine.is_function("cos", 1)) {
    return congruent(sine.arguments[0], base) && congruent(cosine.arguments[0], base);
  }
  return is_difference(formula, base);
}

/// atan2(y, x) - z, wrapped, is atan2(y cos z - x sin z, x cos z + y sin z).
bool ListingMatch::is_difference(const FormulaNode& arc, int base) {
  const ListedOperation& difference = listing_->at(base);
  const ListedOperation* direction =
      difference.is("fsub") ? &listing_->at(wraps_.plain(difference.operands[0])) : nullptr;
  if (direction == nullptr || !(direction->is("atan2") || direction->is("arc"))) {
    return false;
  }
  const int angle = difference.operands[1];
  const auto is_part = [&](int product, int factor, std::string_view function) {
    const FormulaNode& both = graph_->at(product);
    if (both.kind != Kind::multiply) {
      return false;
    }
    const FormulaNode& turned = graph_->at(both.arguments[1]);
    return turned.is_function(function, 1) && congruent(turned.arguments[0], angle) &&
           number(both.arguments[0], factor);
  };
  const FormulaNode& sine = graph_->at(arc.arguments[0]);
  const FormulaNode& cosine = graph_->at(arc.arguments[1]);
  const int y = direction->operands[0];
  const int x = direction->operands[1];
  return sine.kind == Kind::subtract && cosine.kind == Kind::add && is_part(sine.arguments[0], y, "cos") &&
         is_part(sine.arguments[1], x, "sin") && is_part(cosine.arguments[0], x, "cos") &&
         is_part(cosine.arguments[1], y, "sin");
}

// ---- the whole

Objections ListingMatch::objections() {
  Objections objections;
  find_spans(objections);
  for (std::size_t i = 0; i < listing_->states.size(); ++i) {
    const ListedState& state = listing_->states[i];
    const bool is_same = !listing_->at(state.input).format.is_float ? false
                         : is_angle_[i]                             ? congruent(graph_->next()[i], state.next)
                                                                    : number(graph_->next()[i], state.next);
    if (!is_same) {
      objections.push_back("no rule shows that the new value of " + state.name + " is that of the listing");
    }
  }
  if (!number(graph_->frequency(), listing_->frequency)) {
    objections.emplace_back("no rule shows that the frequency is that of the listing");
  }
  for (const ListedObligation& obligation : listing_->obligations) {
    if (!is_always(obligation.must_be_zero, false)) {
      objections.push_back("nothing shows what the listing needs: " + obligation.why);
    }
  }
  check_numbers(objections);
  return objections;
}

}  // namespace veritrack::checker

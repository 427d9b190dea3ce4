// What a listing needs besides, and what shows it.
#include "checker/code/listing_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace veritrack::checker {

bool ListingMatch::is_always(int condition, bool truth, int depth) {
  constexpr int kDeepest = 200;
  const ListedOperation& operation = listing_->at(condition);
  if (depth > kDeepest) {
    return false;
  }
  if (operation.is_bit()) {
    return (operation.integer != 0) == truth;
  }
  if (const std::optional<bool> are_numbers = wraps_.tests_for_numbers(condition)) {
    return *are_numbers == truth;
  }
  const auto is = [&](std::size_t k, bool wanted) {
    return is_always(operation.operands[k], wanted, depth + 1);
  };
  if (operation.is("xor") && listing_->at(operation.operands[1]).is_bit()) {
    return is(0, truth != (listing_->at(operation.operands[1]).integer != 0));
  }
  if (operation.is("and") || operation.is("or")) {
    const bool one_is_enough = operation.is("or") == truth;
    if (one_is_enough ? is(0, truth) || is(1, truth) : is(0, truth) && is(1, truth)) {
      return true;
    }
  } else if (is_always_compared(operation, truth)) {
    return true;
  }
  if (depth > 0) {
    return false;
  }
  for (std::size_t place = 0; place < listing_->operations.size(); ++place) {
    const int base = wraps_.base_of(static_cast<int>(place));
    const std::optional<Span> range = base >= 0 ? span(base) : std::nullopt;
    if (range && wraps_.is_always(condition, truth, base, *range)) {
      compared_.insert(base);
      return true;
    }
  }
  return false;
}

bool ListingMatch::is_always_compared(const ListedOperation& comparison, bool truth) {
  const std::optional<OrderedPair> pair = ordered_pair(comparison);
  if (!pair) {
    return false;
  }
  compared_.insert(comparison.operands.begin(), comparison.operands.end());
  const bool wanted = truth != pair->is_opposite;
  using Relation = OrderedPair::Relation;
  const std::vector<Span> found = differences(pair->first, pair->second);
  // Open intervals: their ends are not attained.
  return std::any_of(found.begin(), found.end(), [&](const Span& difference) {
    return pair->relation == Relation::equal ? !wanted && (difference.low >= 0.0 || difference.high <= 0.0)
           : wanted                          ? difference.low >= 0.0
                                             : difference.high <= 0.0;
  });
}

std::vector<Span> ListingMatch::differences(int first, int second) {
  std::vector<Span> found;
  const std::optional<Span> a = span(first);
  const std::optional<Span> b = span(second);
  if (a && b) {
    found.push_back(slightly_wider({b->low - a->high, b->high - a->low}));
  }
  const std::optional<double> least = wraps_.number(first);
  const std::optional<double> most = wraps_.number(second);
  const auto behind = [](Span bounds, double number) {
    return number == 0.0 ? bounds : slightly_wider({bounds.low - number, bounds.high - number});
  };
  for (const int limit : graph_->limits()) {
    const std::optional<Span> bounds = bounds_of(limit);
    if (!bounds) {
      continue;
    }
    const int of = graph_->without_limits(graph_->at(limit).arguments[0]);
    const FormulaNode& formula = graph_->at(of);
    if (formula.kind == FormulaStep::Kind::subtract) {
      const int x = formula.arguments[0];
      const int y = formula.arguments[1];
      if (number(x, second) && number(y, first)) {
        found.push_back(*bounds);
      } else if (number(x, first) && number(y, second)) {
        found.push_back({-bounds->high, -bounds->low});
      }
    }
    if (least && number(of, second)) {
      found.push_back(behind(*bounds, *least));
    } else if (most && number(of, first)) {
      const Span behind_most = behind(*bounds, *most);
      found.push_back({-behind_most.high, -behind_most.low});
    }
  }
  return found;
}

/// Registers that are tested for being numbers, or compared, are numbers: their operations have a value where
/// the formulas have one.
void ListingMatch::check_numbers(Objections& objections) {
  constexpr std::array<std::string_view, 23> kAlways{
      "arc",  "fadd", "fsub", "fmul", "fneg", "fma",   "fabs", "floor", "ceil", "ftrunc", "rint",   "round",
      "fmin", "fmax", "sin",  "cos",  "atan", "atan2", "exp",  "hypot", "tanh", "fpext",  "fptrunc"};
  constexpr std::array<std::string_view, 6> kWhereMatched{"fdiv", "sqrt", "log", "asin", "acos", "tan"};
  std::set<int> has_value;
  for (const auto& [node, place] : matched_) {
    if (graph_->is_always_needed()[static_cast<std::size_t>(node)]) {
      has_value.insert(place);
    }
  }
  const auto is_among = [](const auto& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<bool> is_number;
  for (const ListedOperation& operation : listing_->operations) {
    const int place = static_cast<int>(is_number.size());
    bool is = operation.is("input") || operation.is("select") ||
              (operation.is_number() && std::isfinite(operation.number)) ||
              is_among(kAlways, operation.name) ||
              (is_among(kWhereMatched, operation.name) && has_value.contains(place));
    for (std::size_t k = operation.is("select") ? 1 : 0; k < operation.operands.size(); ++k) {
      is = is && is_number[static_cast<std::size_t>(operation.operands[k])];
    }
    is_number.push_back(is && operation.format.is_float);
  }
  std::set<int> needed = compared_;
  needed.insert(wraps_.taken_for_numbers().begin(), wraps_.taken_for_numbers().end());
  if (!std::all_of(needed.begin(), needed.end(),
                   [&](int place) { return is_number[static_cast<std::size_t>(place)]; })) {
    objections.emplace_back("nothing shows that a value that the listing compares is a number");
  }
}

}  // namespace veritrack::checker

// Ranges of angles, from the wraps of a listing and from the limits among the formulas.
#include "checker/code/listing_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>

#include "checker/code/turned_pair.hpp"

namespace veritrack::checker {

namespace {

using RangeKind = FormulaStep::Kind;

/// What angles may be off by rounding, and more.
constexpr double kRoundedAngle = 3e-4;

Span hull(Span a, Span b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
Span times(Span a, Span b) {
  const auto [least, largest] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {least, largest};
}
std::optional<Span> if_finite(Span span) {
  return std::isfinite(span.low) && std::isfinite(span.high) ? std::optional(slightly_wider(span))
                                                             : std::nullopt;
}

}  // namespace

std::optional<Span> ListingMatch::span(int place) {
  place = wraps_.plain(place);
  if (const auto known = spans_.find(place); known != spans_.end()) {
    return known->second;
  }
  constexpr int kDeepest = 400;
  if (depth_ > kDeepest) {
    return std::nullopt;
  }
  ++depth_;
  const std::optional<Span> found = span_by_rules(place);
  --depth_;
  spans_[place] = found;
  return found;
}

std::optional<Span> ListingMatch::span_by_rules(int place) {
  constexpr double kHalf = std::numbers::pi;
  const ListedOperation& operation = listing_->at(place);
  if (const auto state = state_spans_.find(place); state != state_spans_.end()) {
    return state->second;
  }
  if (const auto number = wraps_.number(place)) {
    return Span{*number, *number};
  }
  if (operation.is("arc")) {
    return slightly_wider({-listing_->largest_arc, listing_->largest_arc});
  }
  if (operation.is("atan2") || operation.is("acos")) {
    return slightly_wider({operation.is("acos") ? 0.0 : -kHalf, kHalf});
  }
  if (operation.is("atan") || operation.is("asin")) {
    return slightly_wider({-kHalf / 2, kHalf / 2});
  }
  if (operation.is("sin") || operation.is("cos") || operation.is("tanh")) {
    return Span{-1.0, 1.0};
  }
  if (wraps_.is_wrapped(place)) {
    const int base = wraps_.base_of(place);
    const std::optional<Span> of_base = span(base);
    return of_base ? wraps_.range(place, base, *of_base) : std::nullopt;
  }
  if (operation.is("fneg")) {
    const std::optional<Span> of = span(operation.operands[0]);
    return of ? std::optional(Span{-of->high, -of->low}) : std::nullopt;
  }
  const bool is_sum = operation.is("fadd") || operation.is("fsub");
  if (!is_sum && !operation.is("fmul") && !operation.is("select")) {
    return std::nullopt;
  }
  const std::size_t first = operation.is("select") ? 1 : 0;
  const std::optional<Span> a = span(operation.operands[first]);
  const std::optional<Span> b = a || is_sum ? span(operation.operands[first + 1]) : std::nullopt;
  if (!a || !b) {
    return is_sum ? span_of_sum(place) : span_of_choice(place);
  }
  return operation.is("select") ? if_finite(hull(*a, *b))
         : operation.is("fmul") ? if_finite(times(*a, *b))
         : operation.is("fadd") ? if_finite({a->low + b->low, a->high + b->high})
                                : if_finite({a->low - b->high, a->high - b->low});
}

std::optional<Span> ListingMatch::span_of_term(const Signed& term) {
  const std::optional<double> constant = wraps_.number(term.of);
  // The sign of a constant is apart.
  const std::optional<Span> size =
      constant ? std::optional(Span{std::fabs(*constant), std::fabs(*constant)}) : span(term.of);
  return size && term.is_negative ? std::optional(Span{-size->high, -size->low}) : size;
}

/// A sum of values whose ranges are known, one of them perhaps, and others that the formulas limit together.
std::optional<Span> ListingMatch::span_of_sum(int place) {
  const std::vector<Signed> terms = terms_of_register(place);
  const auto with_limit = [&](const std::vector<bool>& is_limited) -> std::optional<Span> {
    std::vector<Signed> rest;
    Span sum;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const std::optional<Span> known = is_limited[i] ? std::nullopt : span_of_term(terms[i]);
      if (known) {
        sum = {sum.low + known->low, sum.high + known->high};
      } else {
        rest.push_back(terms[i]);
      }
    }
    const std::optional<Span> limits = limits_of(rest);
    return limits ? if_finite({sum.low + limits->low, sum.high + limits->high}) : std::nullopt;
  };
  if (const auto found = with_limit(std::vector<bool>(terms.size(), false))) {
    return found;
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    std::vector<bool> all_but_one(terms.size(), true);
    all_but_one[i] = false;
    if (const auto found = span_of_term(terms[i]) ? with_limit(all_but_one) : std::nullopt) {
      return found;
    }
  }
  return std::nullopt;
}

/// An angle, and a step that is chosen, which the formulas limit.
std::optional<Span> ListingMatch::span_of_choice(int place) {
  for (const auto& [angle, range] : state_spans_) {
    for (const int limit : graph_->limits()) {
      const std::optional<Span> bounds = step_bounds_of(limit);
      if (bounds && is_choice_of_sums(terms_of_node(graph_->at(limit).arguments[0]), place, angle)) {
        return if_finite({range.low + bounds->low, range.high + bounds->high});
      }
    }
  }
  return std::nullopt;
}

std::optional<double> ListingMatch::bound(int node) const {
  bool is_negative = false;
  while (graph_->at(node).kind == RangeKind::negate) {
    node = graph_->at(node).arguments[0];
    is_negative = !is_negative;
  }
  const FormulaNode& formula = graph_->at(node);
  double value = 0.0;
  if (formula.kind == RangeKind::number) {
    value = std::strtod(formula.text.c_str(), nullptr);
    // What is next to zero is not taken for it.
    if ((value == 0.0) != exact_decimal(formula.text).digits.empty()) {
      return std::nullopt;
    }
  } else if (formula.kind == RangeKind::name && formula.text == "pi") {
    value = std::numbers::pi;
  } else {
    return std::nullopt;
  }
  return is_negative ? -value : value;
}

std::optional<Span> ListingMatch::bounds_of(int limit) const {
  const FormulaNode& formula = graph_->at(limit);
  if (!formula.is_function("stays_within", 3)) {
    return std::nullopt;
  }
  const std::optional<double> low = bound(formula.arguments[1]);
  const std::optional<double> high = bound(formula.arguments[2]);
  return low && high && *low <= *high ? std::optional(Span{*low, *high}) : std::nullopt;
}

/// Those of at most half a turn.
std::optional<Span> ListingMatch::step_bounds_of(int limit) const {
  constexpr double kHalfTurn = std::numbers::pi + 1e-9;
  const std::optional<Span> bounds = bounds_of(limit);
  return bounds && bounds->low >= -kHalfTurn && bounds->high <= kHalfTurn
             ? std::optional(slightly_wider(*bounds))
             : std::nullopt;
}

std::optional<Span> ListingMatch::limits_of(const std::vector<Signed>& terms) {
  for (const int limit : graph_->limits()) {
    const std::optional<Span> bounds = step_bounds_of(limit);
    if (bounds && same_terms(terms_of_node(graph_->at(limit).arguments[0]), terms, false)) {
      return bounds;
    }
  }
  return std::nullopt;
}

/// The ranges that wraps keep the angles in: from their starts on, until they do not grow.
void ListingMatch::find_spans(Objections& objections) {
  constexpr int kMostRounds = 16;
  for (std::size_t i = 0; i < listing_->states.size(); ++i) {
    const ListedState& state = listing_->states[i];
    if (is_angle_[i] && std::isfinite(state.start) && wraps_.is_wrapped(state.next)) {
      state_spans_[state.input] = {state.start, state.start};
    } else if (is_angle_[i]) {
      objections.push_back("the listing does not wrap " + state.name);
    }
  }
  bool has_grown = true;
  for (int round = 0; has_grown && round < kMostRounds; ++round) {
    has_grown = false;
    numbers_.clear();
    congruences_.clear();
    matched_.clear();
    spans_.clear();
    for (const ListedState& state : listing_->states) {
      const auto known = state_spans_.find(state.input);
      const std::optional<Span> next = known != state_spans_.end() ? span(state.next) : std::nullopt;
      if (known == state_spans_.end()) {
        continue;
      }
      if (!next) {
        objections.push_back("no rule shows in which range the listing keeps " + state.name);
        state_spans_.erase(known);
        has_grown = true;  // what rests on it is asked again
      } else if (const Span both = hull(known->second, *next); !(both == known->second)) {
        known->second = both;
        has_grown = true;
      }
    }
  }
  if (has_grown) {
    objections.emplace_back(
        "the listing does not keep its angles in a range, for steps of up to half a turn");
  }
}

std::optional<ListedWrap> ListingMatch::wrap_of(int place) {
  const int base = wraps_.base_of(place);
  std::optional<Span> before = span(base);
  if (before) {
    // The program's values are rounded.
    before = Span{before->low - kRoundedAngle, before->high + kRoundedAngle};
  }
  const std::optional<Span> after = before ? wraps_.range(place, base, *before) : std::nullopt;
  const auto shifts = before ? wraps_.shifts(place, base, *before) : std::nullopt;
  if (!after || !shifts) {
    return std::nullopt;
  }
  const double largest = std::max(
      {std::fabs(before->low), std::fabs(before->high), std::fabs(after->low), std::fabs(after->high)});
  return ListedWrap{base, largest, *shifts, is_away_from_half_turn(place)};
}

bool ListingMatch::is_away_from_half_turn(int place) {
  constexpr double kMost = 3.14 + 1e-9;
  return std::any_of(graph_->limits().begin(), graph_->limits().end(), [&](int limit) {
    const std::optional<Span> bounds = bounds_of(limit);
    return bounds && bounds->low >= -kMost && bounds->high <= kMost &&
           number(graph_->at(limit).arguments[0], place);
  });
}

bool ListingMatch::is_kept_by_wraps(int condition) {
  for (std::size_t i = 0; i < listing_->operations.size(); ++i) {
    const int place = static_cast<int>(i);
    const std::optional<Span> of_base = wraps_.is_wrapped(place) ? span(wraps_.base_of(place)) : std::nullopt;
    if (of_base && wraps_.is_always(condition, false, wraps_.base_of(place), *of_base)) {
      return true;
    }
  }
  return false;
}

bool ListingMatch::is_kept_when_rounded(const ListedState& state) {
  constexpr double kOfStep = 1e-4;  // more than a sum and its wrap are off
  const int place = wraps_.plain(state.next);
  const int base = wraps_.base_of(place);
  const Span range = state_spans_.at(state.input);
  const std::optional<Span> before = base < 0 ? std::nullopt : span(base);
  const std::optional<Span> after =
      before ? wraps_.range(place, base, {before->low - kRoundedAngle, before->high + kRoundedAngle})
             : std::nullopt;
  return after && after->low >= range.low - kRoundedAngle + kOfStep &&
         after->high <= range.high + kRoundedAngle - kOfStep;
}

std::optional<ListedAngles> ListingMatch::angles() {
  ListedAngles result;
  for (const ListedState& state : listing_->states) {
    if (state_spans_.contains(state.input) && !is_kept_when_rounded(state)) {
      return std::nullopt;
    }
  }
  for (const auto& [place, span] : state_spans_) {
    result.states.emplace(place, Ball::hull(Ball(span.low - kRoundedAngle), Ball(span.high + kRoundedAngle)));
  }
  for (std::size_t i = 0; i < listing_->operations.size(); ++i) {
    const int place = static_cast<int>(i);
    if (wraps_.is_wrapped(place) && wraps_.plain(place) == place) {
      if (std::optional<ListedWrap> wrap = wrap_of(place)) {
        result.wraps.emplace(place, *std::move(wrap));
      }
    }
    if (angle_of_turned_pair(*listing_, place) && is_away_from_half_turn(place)) {
      result.arcs.emplace(place, Ball::within(Ball(3.14001)));
    }
  }
  const bool are_kept = std::all_of(
      listing_->obligations.begin(), listing_->obligations.end(),
      [&](const ListedObligation& obligation) { return is_kept_by_wraps(obligation.must_be_zero); });
  return are_kept ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace veritrack::checker

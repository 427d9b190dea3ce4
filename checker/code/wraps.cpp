#include "checker/code/wraps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "checker/document/json_tree.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostParts = 256;
constexpr int kDeepestWrap = 400;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

bool is_whole_turns(double number) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kMostTurns = 8.0;
  const double turns = std::round(number / kTurn);
  return std::fabs(turns) >= 1.0 && std::fabs(turns) <= kMostTurns &&
         std::fabs(number - turns * kTurn) <= kTurnSlack;
}

bool is_sum(const ListedOperation& operation) {
  return operation.is("fadd") || operation.is("fsub");
}

}  // namespace

Span slightly_wider(Span span) {
  constexpr double kPart = 1e-12;
  const auto more = [](double end) { return kPart * (1.0 + std::fabs(end)); };
  return {span.low - more(span.low), span.high + more(span.high)};
}

std::optional<OrderedPair> ordered_pair(const ListedOperation& comparison) {
  using Relation = OrderedPair::Relation;
  if (!comparison.is("fcmp")) {
    return std::nullopt;
  }
  const int a = comparison.operands[0];
  const int b = comparison.operands[1];
  // Numbers are never unordered.
  const std::string relation = comparison.predicate.substr(1);
  return relation == "lt"   ? std::optional(OrderedPair{a, b, Relation::less, false})
         : relation == "gt" ? std::optional(OrderedPair{b, a, Relation::less, false})
         : relation == "le" ? std::optional(OrderedPair{a, b, Relation::at_most, false})
         : relation == "ge" ? std::optional(OrderedPair{b, a, Relation::at_most, false})
         : relation == "eq" ? std::optional(OrderedPair{a, b, Relation::equal, false})
         : relation == "ne" ? std::optional(OrderedPair{a, b, Relation::equal, true})
                            : std::nullopt;
}

Wraps::Wraps(const CodeListing& listing) : listing_(&listing), bases_(listing.operations.size(), -1) {
  find_bases();
}

std::optional<bool> Wraps::tests_for_numbers(int condition) const {
  bool truth = true;
  while (true) {
    const ListedOperation& operation = listing_->at(condition);
    if (operation.is("xor") && listing_->at(operation.operands[1]).is_bit()) {
      truth = truth != (listing_->at(operation.operands[1]).integer != 0);
      condition = operation.operands[0];
      continue;
    }
    if (!operation.is("fcmp")) {
      return std::nullopt;
    }
    const bool of_itself = operation.operands[0] == operation.operands[1];
    const bool is_ordered = operation.predicate == "ord" || (of_itself && operation.predicate == "oeq");
    const bool is_unordered = operation.predicate == "uno" || (of_itself && operation.predicate == "une");
    if (!is_ordered && !is_unordered) {
      return std::nullopt;
    }
    taken_.insert(operation.operands.begin(), operation.operands.end());
    return truth == is_ordered;
  }
}

/// One step of `plain` behind a register that it looks through.
int Wraps::behind(int place) const {
  const ListedOperation& operation = listing_->at(place);
  return operation.operands[operation.is("select") ? (*tests_for_numbers(operation.operands[0]) ? 1 : 2) : 0];
}

int Wraps::plain(int place) const {
  while (true) {
    const ListedOperation& operation = listing_->at(place);
    if (operation.is("fpext") || operation.is("fptrunc")) {
      place = operation.operands[0];
      continue;
    }
    const std::optional<bool> are_numbers = operation.is("select") && operation.format.is_float
                                                ? tests_for_numbers(operation.operands[0])
                                                : std::nullopt;
    if (!are_numbers) {
      return place;
    }
    place = operation.operands[*are_numbers ? 1 : 2];
  }
}

std::optional<double> Wraps::number(int place) const {
  const ListedOperation& operation = listing_->at(place);  // behind a conversion it may be another one
  return operation.is_number() && std::isfinite(operation.number) ? std::optional(operation.number)
                                                                  : std::nullopt;
}

/// x, where half a turn is added, wraps follow, and it is taken away again; -1 for anything else.
int Wraps::before_half_turns(int place) const {
  const auto without_half = [&](int sum) {
    const ListedOperation& operation = listing_->at(sum);
    const std::optional<double> moved = is_sum(operation) ? number(operation.operands[1]) : std::nullopt;
    const bool is_half = moved && !is_whole_turns(*moved) && is_whole_turns(*moved + *moved);
    return is_half ? operation.operands[0] : -1;
  };
  const int wrapped = without_half(place);
  const int base = wrapped < 0 ? -1 : bases_[static_cast<std::size_t>(plain(wrapped))];
  return base < 0 ? -1 : without_half(base);
}

void Wraps::find_bases() {
  // For each register the only one that its choices and turns lead to, and whether it is one of its choices.
  struct Leads {
    int to = -1;
    bool without_turn = false;
  };
  std::vector<Leads> leads(listing_->operations.size());
  for (std::size_t i = 0; i < leads.size(); ++i) {
    const int place = static_cast<int>(i);
    const ListedOperation& operation = listing_->at(place);
    leads[i] = {place, true};
    if (!operation.format.is_float) {
      continue;
    }
    if (const int behind = plain(place); behind != place) {
      leads[i] = leads[static_cast<std::size_t>(behind)];
    } else if (const std::optional<Remainder> left = remainder(place)) {
      leads[i] = {leads[static_cast<std::size_t>(plain(left->of))].to, true};
      bases_[i] = leads[i].to;
    } else if (operation.is("select")) {
      const Leads yes = leads[static_cast<std::size_t>(plain(operation.operands[1]))];
      const Leads no = leads[static_cast<std::size_t>(plain(operation.operands[2]))];
      if (yes.to == no.to) {
        leads[i] = {yes.to, yes.without_turn || no.without_turn};
        bases_[i] = leads[i].without_turn ? yes.to : -1;
      }
    } else if (is_sum(operation)) {
      const std::optional<double> turns = number(operation.operands[1]);
      if (turns && is_whole_turns(*turns)) {
        leads[i] = {leads[static_cast<std::size_t>(plain(operation.operands[0]))].to, false};
      } else if (const int before = before_half_turns(place); before >= 0) {
        leads[i] = {leads[static_cast<std::size_t>(plain(before))].to, true};
        bases_[i] = leads[i].to;
      }
    }
  }
}

std::optional<Span> Wraps::range(int place, int base, Span of_base) const {
  const auto parts = shifted(place, base, {of_base, {}, {}}, 0);
  if (!parts || parts->empty()) {
    return std::nullopt;
  }
  Span all{kInfinite, -kInfinite};
  for (const auto& [part, shift] : *parts) {
    all.low = std::min(all.low, part.of_base.low + shift.by);
    all.high = std::max(all.high, part.of_base.high + shift.by);
  }
  return slightly_wider(all);
}

std::optional<std::vector<ListedShift>> Wraps::shifts(int place, int base, Span of_base) const {
  const auto parts = shifted(place, base, {of_base, {}, {}}, 0);
  if (!parts || parts->empty()) {
    return std::nullopt;
  }
  std::vector<ListedShift> all;
  for (const auto& part : *parts) {
    all.push_back(part.second);
  }
  return all;
}

bool Wraps::is_always(int condition, bool truth, int base, Span of_base) const {
  const auto parts = decided(condition, base, {of_base, {}, {}}, 0);
  return parts && !parts->empty() &&
         std::all_of(parts->begin(), parts->end(), [&](const auto& each) { return each.second == truth; });
}

std::optional<Wraps::Shifted> Wraps::shifted(int place, int base, const Part& part, int depth) const {
  spend();
  double converted = 0.0;
  for (const int end = plain(place); place != end; place = behind(place)) {
    converted += listing_->at(place).is("fptrunc") ? half_unit(listing_->at(place).format) : 0.0;
  }
  const ListedOperation& operation = listing_->at(place);
  if (place == base) {
    return Shifted{{part, {0.0, converted}}};
  }
  if (depth > kDeepestWrap || place < base) {
    return std::nullopt;
  }
  if (const std::optional<Remainder> left = remainder(place)) {
    auto parts = without_count(place, *left, base, part, depth + 1);
    for (std::size_t i = 0; parts && i < parts->size(); ++i) {
      (*parts)[i].second.roundings += converted;
    }
    return parts;
  }
  if (is_sum(operation)) {
    const std::optional<double> constant = number(operation.operands[1]);
    auto parts = constant ? shifted(operation.operands[0], base, part, depth + 1) : std::nullopt;
    if (parts) {
      for (auto& each : *parts) {
        each.second.by += operation.is("fadd") ? *constant : -*constant;
        each.second.roundings += converted + half_unit(operation.format);
      }
    }
    return parts;
  }
  if (!operation.is("select")) {
    return std::nullopt;
  }
  const auto conditions = decided(operation.operands[0], base, part, depth + 1);
  if (!conditions) {
    return std::nullopt;
  }
  Shifted all;
  for (const auto& [where, holds] : *conditions) {
    const auto branch = shifted(operation.operands[holds ? 1 : 2], base, where, depth + 1);
    if (!branch || all.size() > kMostParts) {
      return std::nullopt;
    }
    for (const auto& [there, shift] : *branch) {
      all.push_back({there, {shift.by, shift.roundings + converted}});
    }
  }
  return all;
}

std::optional<std::string> Wraps::count_of_turns(int place, int of, double turn) const {
  const ListedOperation& rounded = listing_->at(plain(place));
  const bool rounds = rounded.is("rint") || rounded.is("round") || rounded.is("floor") ||
                      rounded.is("ceil") || rounded.is("ftrunc");
  if (!rounds) {
    return std::nullopt;
  }
  const ListedOperation& share = listing_->at(plain(rounded.operands[0]));
  const bool is_quotient = share.is("fdiv");
  if (!is_quotient && !share.is("fmul")) {
    return std::nullopt;
  }
  constexpr double kRoundedConstant = 2e-7;  // one of single precision is off by 6e-8
  for (const std::size_t constant : {1U, 0U}) {
    const std::optional<double> by = number(share.operands[constant]);
    if (!by || plain(share.operands[1 - constant]) != plain(of) || (is_quotient && constant == 0)) {
      continue;
    }
    const double ratio = is_quotient ? *by / turn : *by * turn;
    if (std::fabs(ratio - 1.0) <= kRoundedConstant) {
      return rounded.name;
    }
  }
  return std::nullopt;
}

std::optional<Wraps::Remainder> Wraps::remainder(int place) const {
  const ListedOperation& operation = listing_->at(place);
  const auto one_turn = [&](int of) -> std::optional<double> {
    const std::optional<double> turn = number(of);
    return turn && std::fabs(*turn - 2.0 * std::numbers::pi) <= kTurnSlack ? turn : std::nullopt;
  };
  if (operation.is("fmod")) {
    const std::optional<double> turn = one_turn(operation.operands[1]);
    return turn ? std::optional(Remainder{operation.operands[0], "ftrunc", *turn, 0.0}) : std::nullopt;
  }
  if (!operation.is("fsub") || !listing_->at(operation.operands[1]).is("fmul")) {
    return std::nullopt;
  }
  const std::vector<int>& factors = listing_->at(operation.operands[1]).operands;
  for (const std::size_t constant : {0U, 1U}) {
    const std::optional<double> turn = one_turn(factors[constant]);
    const auto rounding =
        turn ? count_of_turns(factors[1 - constant], operation.operands[0], *turn) : std::nullopt;
    if (rounding) {
      // A product that is at most the sum of both, and a difference.
      return Remainder{operation.operands[0], *rounding, *turn, 3.0 * half_unit(operation.format)};
    }
  }
  return std::nullopt;
}

std::optional<Wraps::Shifted> Wraps::without_count(int place, const Remainder& remainder, int base,
                                                   const Part& part, int depth) const {
  // Up to three turns, a quotient's rounding moves the place where its count changes by less than the slack.
  constexpr int kMostCount = 3;
  const auto before = shifted(remainder.of, base, part, depth);
  if (!before) {
    return std::nullopt;
  }
  Shifted all;
  for (const auto& [where, shift] : *before) {
    const Span value{where.of_base.low + shift.by, where.of_base.high + shift.by};
    const double most = kMostCount * remainder.turn;
    if (!(value.low >= -most && value.high <= most)) {
      return std::nullopt;
    }
    for (int count = -kMostCount - 1; count <= kMostCount + 1; ++count) {
      // The turns x/T of which this may be the count.
      Span turns{count - 0.5, count + 0.5};
      if (remainder.rounding == "floor") {
        turns = {count + 0.0, count + 1.0};
      } else if (remainder.rounding == "ceil") {
        turns = {count - 1.0, count + 0.0};
      } else if (remainder.rounding == "ftrunc") {
        turns = {count <= 0 ? count - 1.0 : count + 0.0, count >= 0 ? count + 1.0 : count + 0.0};
      }
      Part there = where;
      there.of_base.low = std::max(where.of_base.low, turns.low * remainder.turn - kTurnSlack - shift.by);
      there.of_base.high = std::min(where.of_base.high, turns.high * remainder.turn + kTurnSlack - shift.by);
      const auto known = there.counts.emplace(place, count).first;
      if (there.of_base.low <= there.of_base.high && known->second == count) {
        all.emplace_back(std::move(there), ListedShift{shift.by - count * remainder.turn,
                                                       shift.roundings + remainder.roundings});
      }
    }
  }
  return all.size() <= kMostParts ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<Wraps::Decided> Wraps::decided(int condition, int base, const Part& part, int depth) const {
  spend();
  const ListedOperation& operation = listing_->at(condition);
  if (depth > kDeepestWrap) {
    return std::nullopt;
  }
  if (operation.is_bit()) {
    return Decided{{part, operation.integer != 0}};
  }
  if (const std::optional<bool> are_numbers = tests_for_numbers(condition)) {
    return Decided{{part, *are_numbers}};
  }
  if (const auto known = part.decided.find(condition); known != part.decided.end()) {
    return Decided{{part, known->second}};
  }
  const bool is_joined =
      operation.is("and") || operation.is("or") || operation.is("xor") || operation.is("select");
  auto parts =
      is_joined ? joined(operation, base, part, depth + 1) : compared(condition, base, part, depth + 1);
  if (parts || is_joined || !ordered_pair(operation)) {
    return parts;
  }
  // Of other numbers: either way.
  Decided both{{part, true}, {part, false}};
  for (auto& [where, holds] : both) {
    where.decided[condition] = holds;
  }
  return both;
}

std::optional<Wraps::Decided> Wraps::joined(const ListedOperation& both, int base, const Part& part,
                                            int depth) const {
  const auto first = decided(both.operands[0], base, part, depth);
  if (!first) {
    return std::nullopt;
  }
  Decided all;
  for (const auto& [where, holds] : *first) {
    if ((both.is("and") && !holds) || (both.is("or") && holds)) {
      all.emplace_back(where, holds);
      continue;
    }
    const std::size_t other = both.is("select") && !holds ? 2 : 1;
    const auto second = decided(both.operands[other], base, where, depth);
    if (!second || all.size() > kMostParts) {
      return std::nullopt;
    }
    for (const auto& [inside, also_holds] : *second) {
      all.emplace_back(inside, both.is("xor") ? holds != also_holds : also_holds);
    }
  }
  return all;
}

std::optional<Wraps::Decided> Wraps::compared(int condition, int base, const Part& part, int depth) const {
  const std::optional<OrderedPair> pair = ordered_pair(listing_->at(condition));
  if (!pair || pair->relation == OrderedPair::Relation::equal) {
    return std::nullopt;
  }
  const bool limit_is_second = number(pair->second).has_value();
  const std::optional<double> limit = number(limit_is_second ? pair->second : pair->first);
  const auto parts =
      limit ? shifted(limit_is_second ? pair->first : pair->second, base, part, depth) : std::nullopt;
  if (!parts) {
    return std::nullopt;
  }
  Decided all;
  for (const auto& each : *parts) {
    const Part& where = each.first;
    const double at_base = *limit - each.second.by;
    const auto add = [&](double low, double high, bool holds) {
      const Span cut{std::max(where.of_base.low, low), std::min(where.of_base.high, high)};
      if (cut.low <= cut.high) {
        all.push_back({{cut, where.decided, where.counts}, holds});
        all.back().first.decided[condition] = holds;
      }
    };
    // Sums in single precision may be to the other side of a limit next to it.
    add(-kInfinite, at_base + kTurnSlack, limit_is_second);
    add(at_base - kTurnSlack, kInfinite, !limit_is_second);
  }
  return all;
}

}  // namespace veritrack::checker

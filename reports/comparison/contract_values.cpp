#include "reports/comparison/contract_values.hpp"

#include <algorithm>
#include <set>

#include "reports/comparison/measured_number.hpp"

namespace veritrack::reports {

namespace {

using certificates::KeyContract;
using certificates::Measure;
using certificates::Stronger;
using rigor::Interval;
using Json = nlohmann::ordered_json;

bool same_rate(const ContractValue& a, const ContractValue& b) {
  return !a.sample_rate || !b.sample_rate || rigor::identical(*a.sample_rate, *b.sample_rate);
}

/// -1, 0 or 1: `a` is certainly less, both are the same, or `a` is certainly more.
std::optional<int> order_of(const Measured& a, const Measured& b, bool at_same_rate) {
  const bool by_physical =
      (a.written_in_hertz && b.written_in_hertz) || (!at_same_rate && a.physical && b.physical);
  const std::optional<Interval>& x = by_physical ? a.physical : a.sampled;
  const std::optional<Interval>& y = by_physical ? b.physical : b.sampled;
  if (!x || !y || !rigor::is_finite(*x) || !rigor::is_finite(*y)) {
    return std::nullopt;
  }
  if (rigor::identical(*x, *y)) {
    return 0;
  }
  return rigor::certainly_less(*x, *y)   ? std::optional(-1)
         : rigor::certainly_less(*y, *x) ? std::optional(1)
                                         : std::nullopt;
}

Relation by_order(const std::optional<int>& order, Stronger stronger) {
  if (!order) {
    return Relation::incomparable;
  }
  if (*order == 0) {
    return Relation::equal;
  }
  if (stronger != Stronger::larger && stronger != Stronger::smaller) {
    return Relation::incomparable;
  }
  return (*order < 0) == (stronger == Stronger::larger) ? Relation::stronger : Relation::weaker;
}

/// Both at once: stronger only where neither is weaker.
Relation both(Relation a, Relation b) {
  return a == Relation::equal ? b : b == Relation::equal ? a : a == b ? a : Relation::incomparable;
}

/// A range of numbers, and how much may differ in it: one number, one number out of it, or another one at
/// every sample.
struct Range {
  Measured low;
  Measured high;
  int freedom = 0;
};

std::optional<Range> range_between(const Json& low, const Json& high, const ContractValue& context,
                                   Measure measure, int freedom) {
  const auto from = measured(low, context, measure);
  const auto to = measured(high, context, measure);
  return from && to ? std::optional(Range{*from, *to, freedom}) : std::nullopt;
}

std::optional<Range> range_in(const Json& json, const ContractValue& context, Measure measure) {
  constexpr int kConstant = 1;
  constexpr int kFree = 2;
  const auto is_pair = [](const Json& list) { return list.is_array() && list.size() == 2; };
  if (json == "steady-state") {  // a covariance, of which ranges name multiples
    const Measured once{Interval(1.0)};
    return Range{once, once};
  }
  if (is_pair(json)) {
    return range_between(json[0], json[1], context, measure, kFree);
  }
  if (json.is_object() && json.size() == 1 && json.contains("constant") && is_pair(json.at("constant"))) {
    return range_between(json.at("constant")[0], json.at("constant")[1], context, measure, kConstant);
  }
  if (json.is_object() && json.size() == 2 && json.contains("from") && json.contains("to")) {
    return range_between(json.at("from"), json.at("to"), context, measure, kFree);
  }
  return range_between(json, json, context, measure, 0);
}

Relation relation_of_ranges(const Range& before, const Range& after, bool at_same_rate) {
  const Relation ends = both(by_order(order_of(before.low, after.low, at_same_rate), Stronger::smaller),
                             by_order(order_of(before.high, after.high, at_same_rate), Stronger::larger));
  const Relation freedom = before.freedom == after.freedom  ? Relation::equal
                           : before.freedom < after.freedom ? Relation::stronger
                                                            : Relation::weaker;
  return both(ends, freedom);
}

/// Numbers by their ends, everything else as it is.
bool is_same(const Json& a, const Json& b) {
  const auto x = number_in(a);
  const auto y = number_in(b);
  if (x && y) {
    return rigor::identical(*x, *y);
  }
  if (x || y || a.type() != b.type() || a.size() != b.size() || !a.is_structured()) {
    return !x && !y && a == b;
  }
  if (a.is_array()) {
    return std::equal(a.begin(), a.end(), b.begin(), is_same);
  }
  for (const auto& [name, value] : a.items()) {
    if (!b.contains(name) || !is_same(value, b.at(name))) {
      return false;
    }
  }
  return true;
}

bool has_members(const Json& json) {
  return json.is_object() && !json.contains("text");
}

Relation relation_of_members(const ContractValue& before, const ContractValue& after,
                             const KeyContract& contract) {
  std::set<std::string> names;
  for (const Json* json : {before.json, after.json}) {
    for (const auto& [name, value] : json->items()) {
      names.insert(name);
    }
  }
  Relation relation = Relation::equal;
  for (const std::string& name : names) {
    const auto known = std::find_if(contract.members.begin(), contract.members.end(),
                                    [&](const auto& member) { return member.name == name; });
    const Stronger stronger = known != contract.members.end() ? known->stronger : Stronger::unknown;
    if (stronger == Stronger::neither) {
      continue;
    }
    if (!before.json->contains(name) || !after.json->contains(name)) {
      return Relation::incomparable;
    }
    ContractValue from = before;
    ContractValue to = after;
    from.json = &before.json->at(name);
    to.json = &after.json->at(name);
    relation = both(relation, relation_of(from, to, {stronger, contract.measure}));
  }
  return relation;
}

}  // namespace

Relation relation_of(const ContractValue& before, const ContractValue& after, const KeyContract& contract) {
  if (before.json == nullptr || after.json == nullptr) {
    const bool has_direction = contract.stronger == Stronger::larger ||
                               contract.stronger == Stronger::smaller || contract.stronger == Stronger::wider;
    return before.json == after.json                ? Relation::equal
           : contract.stronger == Stronger::neither ? Relation::equal
           : !has_direction                         ? Relation::incomparable
           : before.json == nullptr                 ? Relation::stronger
                                                    : Relation::weaker;
  }
  const bool at_same_rate = same_rate(before, after);
  const bool in_same_units =
      contract.measure == Measure::plain || (at_same_rate && before.in_hertz == after.in_hertz &&
                                             before.sample_rate.has_value() == after.sample_rate.has_value());
  if (contract.stronger == Stronger::neither || (in_same_units && is_same(*before.json, *after.json))) {
    return Relation::equal;
  }
  if (!contract.members.empty() && (has_members(*before.json) || has_members(*after.json))) {
    return has_members(*before.json) && has_members(*after.json)
               ? relation_of_members(before, after, contract)
               : Relation::incomparable;
  }
  if (contract.stronger == Stronger::larger || contract.stronger == Stronger::smaller) {
    const auto from = measured(*before.json, before, contract.measure);
    const auto to = measured(*after.json, after, contract.measure);
    return from && to ? by_order(order_of(*from, *to, at_same_rate), contract.stronger)
                      : Relation::incomparable;
  }
  if (contract.stronger == Stronger::wider) {
    const auto from = range_in(*before.json, before, contract.measure);
    const auto to = range_in(*after.json, after, contract.measure);
    return from && to ? relation_of_ranges(*from, *to, at_same_rate) : Relation::incomparable;
  }
  return Relation::incomparable;
}

Relation relation_of_formulas(const std::string* before, const std::string* after) {
  if (before == nullptr || after == nullptr) {
    return before == after ? Relation::equal : before == nullptr ? Relation::stronger : Relation::weaker;
  }
  if (*before == *after) {
    return Relation::equal;
  }
  const auto from = decimal_in(*before);
  const auto to = decimal_in(*after);
  return from && to ? by_order(order_of({from}, {to}, true), Stronger::larger) : Relation::incomparable;
}

}  // namespace veritrack::reports

#include "checker/document/statement.hpp"

#include <algorithm>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

template <typename Range>
auto find_named(const Range& range, const std::string& name) {
  return std::find_if(range.begin(), range.end(), [&](const auto& item) { return item.name == name; });
}

/// "[a, b]" as two balls.
std::pair<Ball, Ball> read_decimals(const std::string& text) {
  const std::size_t comma = text.find(", ");
  if (text.size() < 6 || text.front() != '[' || text.back() != ']' || comma == std::string::npos) {
    throw Malformed("not a pair of decimals: " + text);
  }
  return {from_decimal(std::string_view(text).substr(1, comma - 1)),
          from_decimal(std::string_view(text).substr(comma + 2, text.size() - comma - 3))};
}

bool is_unproved(const Tree& quantity) {
  const Tree* proved = quantity.find("proved");
  return proved != nullptr && !proved->truth();
}

}  // namespace

Verdict decide_less(const Ball& x, const Ball& y) {
  return certainly_less(x, y)      ? Verdict::proved
         : certainly_at_most(y, x) ? Verdict::refuted
                                   : Verdict::undecided;
}
Verdict decide_at_most(const Ball& x, const Ball& y) {
  return certainly_at_most(x, y) ? Verdict::proved
         : certainly_less(y, x)  ? Verdict::refuted
                                 : Verdict::undecided;
}

Verdict all_of(const std::vector<Verdict>& verdicts) {
  const auto is = [](Verdict wanted) { return [wanted](Verdict verdict) { return verdict == wanted; }; };
  if (std::any_of(verdicts.begin(), verdicts.end(), is(Verdict::refuted))) {
    return Verdict::refuted;
  }
  return proved_if(!verdicts.empty() && std::all_of(verdicts.begin(), verdicts.end(), is(Verdict::proved)));
}

Verdict verdict_from(const std::string& text) {
  if (text == "proved") {
    return Verdict::proved;
  }
  if (text == "refuted") {
    return Verdict::refuted;
  }
  if (text != "undecided") {
    throw Malformed("not a verdict: " + text);
  }
  return Verdict::undecided;
}

Ball read_enclosure(const Tree& enclosure, const std::string& name, Objections& objections) {
  const Ball low = low_of(enclosure);
  const Ball high = high_of(enclosure);
  const auto [decimal_low, decimal_high] = read_decimals(enclosure.at("decimal").text());
  if (!certainly_at_most(low, high)) {
    objections.push_back(name + ": lo exceeds hi");
  }
  // Decimals are read as balls: up to 2^-100 of the number, which no reader can see.
  const bool outward = (certainly_at_most(decimal_low, low) ||
                        certainly_at_most(decimal_low - low, abs(low) * Ball(0x1p-100))) &&
                       (certainly_at_most(high, decimal_high) ||
                        certainly_at_most(high - decimal_high, abs(high) * Ball(0x1p-100)));
  if (!outward) {
    objections.push_back(name + ": the decimals are narrower than the enclosure");
  }
  return Ball::hull(low, high);
}

Ball read_number(const Tree& number, Objections& objections) {
  const std::string& text = number.at("text").text();
  Ball value = from_decimal(text);
  check_enclosure(number, {text, value}, objections);
  return value;
}

void check_enclosure(const Tree& enclosure, const Quantity& quantity, Objections& objections) {
  const auto& [name, value, sense] = quantity;
  read_enclosure(enclosure, name, objections);
  const Ball low = low_of(enclosure);
  const Ball high = high_of(enclosure);
  const bool above = certainly_at_most(low, value.low);
  const bool below = certainly_at_most(value.high, high);
  const std::string found = ", found " + value.low.text();
  if (sense == Sense::encloses && (certainly_less(value.high, low) || certainly_less(high, value.low))) {
    objections.push_back("ALARM: " + name + " lies outside its enclosure" + found);
  } else if (sense == Sense::encloses && !(above && below)) {
    objections.push_back(name + " is not proved to lie in its enclosure" + found);
  } else if (sense == Sense::bounds_above && !below) {
    objections.push_back(name + " is not proved to be an upper bound" + found);
  } else if (sense == Sense::bounds_below && !above) {
    objections.push_back(name + " is not proved to be a lower bound" + found);
  }
}

void check_verdict(const std::string& claimed, Verdict found, const std::string& name,
                   Objections& objections) {
  const Verdict verdict = verdict_from(claimed);
  if (verdict != Verdict::undecided && verdict != found) {
    objections.push_back(name + " is claimed to be " + claimed + ", which could not be verified");
  }
}

void check_claim(const Tree& claimed, const Claim& found, Objections& objections) {
  const std::string& verdict = claimed.at("verdict").text();
  const bool decided = verdict_from(verdict) != Verdict::undecided;
  if (decided && claimed.at("statement").text() != found.statement) {
    objections.emplace_back("the statement is not the one that was checked");
  }
  check_verdict(verdict, found.verdict, "the claim", objections);
  for (const auto& [name, value] : claimed.at("evidence").members()) {
    if (is_unproved(value)) {
      continue;
    }
    const auto known = find_named(found.evidence, name);
    if (known == found.evidence.end()) {
      objections.push_back(name + " is not evidence of this claim");
    } else {
      check_enclosure(value, *known, objections);
    }
  }
}

void check_derivation(const Tree& claimed, const Derivation& found, Objections& objections) {
  if (claimed.at("title").text() != found.title) {
    objections.push_back("the title is not that of the derivation");
  }
  for (const auto& [name, value] : claimed.at("quantities").members()) {
    const auto known = find_named(found.quantities, name);
    if (is_unproved(value)) {
      continue;
    }
    if (known == found.quantities.end()) {
      objections.push_back(name + " is not a quantity of this derivation");
    } else {
      check_enclosure(value, *known, objections);
    }
  }
  std::vector<Verdict> verdicts;
  const auto& conditions = claimed.at("conditions").elements();
  if (conditions.size() != found.conditions.size()) {
    objections.push_back("the conditions are not all there, or too many");
    return;
  }
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Condition& known = found.conditions[i];
    const Tree& condition = conditions[i];
    if (condition.at("id").text() != known.id || condition.at("statement").text() != known.statement) {
      objections.push_back("condition " + condition.at("id").text() + " is not the one that was checked");
      continue;
    }
    check_verdict(condition.at("verdict").text(), known.verdict, "condition " + known.id, objections);
    verdicts.push_back(verdict_from(condition.at("verdict").text()));
    const auto check_side = [&](const char* side, const std::optional<Range>& value, Sense sense) {
      if (const Tree* enclosure = condition.find(side)) {
        check_enclosure(*enclosure, {known.id + " " + side, value.value_or(Ball::everything()), sense},
                        objections);
      }
    };
    check_side("lhs", known.lhs, known.lhs_sense);
    check_side("rhs", known.rhs, Sense::encloses);
  }
  check_verdict(claimed.at("verdict").text(), all_of(verdicts), "the derivation", objections);
}

std::optional<Ball> decimal_between(const std::string& text, const std::string& before,
                                    const std::string& after) {
  if (text.size() <= before.size() + after.size() || !text.starts_with(before) || !text.ends_with(after)) {
    return std::nullopt;
  }
  return from_decimal(
      std::string_view(text).substr(before.size(), text.size() - before.size() - after.size()));
}

}  // namespace veritrack::checker

#include "checker/document/statement.hpp"

#include <algorithm>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

template <typename Range>
auto find_named(const Range& range, const std::string& name) {
  return std::find_if(range.begin(), range.end(), [&](const auto& item) { return item.name == name; });
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
  throw Malformed("not a verdict: " + text.substr(0, 60));
}

Ball read_enclosure(const Tree& enclosure, const std::string& name, Objections& objections) {
  const Ball low = low_of(enclosure);
  const Ball high = high_of(enclosure);
  if (!certainly_at_most(low, high)) {
    objections.push_back(name + ": lo exceeds hi");
  }
  return Ball::hull(low, high);
}

void check_enclosure(const Tree& enclosure, const Quantity& quantity, Objections& objections) {
  const auto& [name, value, sense] = quantity;
  const auto end = [&](const char* which) {
    const Tree* number = enclosure.find(which);
    return number != nullptr ? std::optional(exact_number(*number)) : std::nullopt;
  };
  const std::optional<Ball> low = end("lo");
  const std::optional<Ball> high = end("hi");
  const std::string found = ", found " + value.low.text();
  if (!low && !high) {
    objections.push_back(name + " says nothing");
  }
  // cannot bind (*high): low is at most the value and the value at most high, or there are objections below.
  if (low && high && !certainly_at_most(*low, *high)) {
    objections.push_back(name + ": lo exceeds hi");
  }
  if (low && sense == Sense::bounds_above) {
    objections.push_back(name + " can only be bounded from above");
  } else if (low && !certainly_at_most(*low, value.low)) {
    // cannot bind (value.high): there is an objection either way; this only chooses one of its words.
    const bool alarm = certainly_less(value.high, *low);
    objections.push_back((alarm ? "ALARM: " : "") + name + " is not proved to be at least lo" + found);
  }
  if (high && sense == Sense::bounds_below) {
    objections.push_back(name + " can only be bounded from below");
  } else if (high && !certainly_at_most(value.high, *high)) {
    const bool alarm = sense == Sense::encloses && certainly_less(*high, value.low);
    objections.push_back((alarm ? "ALARM: " : "") + name + " is not proved to be at most hi" + found);
  }
}

void check_verdict(const std::string& claimed, Verdict found, const std::string& name,
                   Objections& objections) {
  if (verdict_from(claimed) != found) {
    objections.push_back(name + " is claimed to be " + claimed + ", which could not be verified");
  }
}

Verdict verdict_of(const Tree& derivation) {
  const Tree* verdict = derivation.find("verdict");
  return verdict != nullptr ? verdict_from(verdict->text()) : Verdict::undecided;
}

namespace {

/// Objects to values that are not known, and to those that are not true.
void check_values(const Tree& claimed, const std::vector<Quantity>& known, Objections& objections) {
  for (const auto& [name, value] : claimed.members()) {
    const auto quantity = find_named(known, name);
    if (quantity == known.end()) {
      objections.push_back(name + " is not known here");
    } else {
      check_enclosure(value, *quantity, objections);
    }
  }
}

/// The verdict on a condition and the statement on its sides.
Verdict check_condition(const Tree& claimed, const Condition& known, Objections& objections) {
  check_verdict(claimed.at("verdict").text(), known.verdict, "condition " + known.id, objections);
  const auto check_side = [&](const char* side, const std::optional<Range>& value, Sense sense) {
    if (const Tree* enclosure = claimed.find(side)) {
      check_enclosure(*enclosure, {known.id + " " + side, value.value_or(Ball::everything()), sense},
                      objections);
    }
  };
  check_side("lhs", known.lhs, known.lhs_sense);
  check_side("rhs", known.rhs, Sense::encloses);
  return verdict_from(claimed.at("verdict").text());
}

}  // namespace

void check_claim(const Tree& claimed, const Claim& found, Objections& objections) {
  check_verdict(claimed.at("verdict").text(), found.verdict, "the claim", objections);
  if (found.statement.empty()) {
    objections.emplace_back("there is no sentence for this claim");
  }
  check_values(claimed.at("evidence"), found.evidence, objections);
}

std::string check_derivation(const Tree& claimed, const Derivation& found, Objections& objections) {
  check_values(claimed.at("quantities"), found.quantities, objections);
  std::vector<Verdict> verdicts;
  auto next = found.conditions.begin();
  for (const Tree& condition : claimed.at("conditions").elements()) {
    const std::string& id = condition.at("id").text();
    next =
        std::find_if(next, found.conditions.end(), [&](const Condition& one_of) { return one_of.id == id; });
    if (next == found.conditions.end()) {
      objections.push_back("condition " + id + " is not one of this derivation, or not in its place");
      return found.title;
    }
    verdicts.push_back(check_condition(condition, *next, objections));
    ++next;
  }
  const Verdict verdict = verdict_of(claimed);
  if (verdict == Verdict::undecided) {
    return found.title;
  }
  const bool complete = verdicts.size() == found.conditions.size();
  const Verdict together = all_of(verdicts);
  if (together != verdict || (verdict == Verdict::proved && !complete)) {
    objections.push_back("the verdict of the derivation is not that of its conditions together");
  }
  return found.title;
}

}  // namespace veritrack::checker

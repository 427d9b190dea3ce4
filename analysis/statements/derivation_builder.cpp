#include "analysis/statements/derivation_builder.hpp"

#include <utility>

namespace veritrack::theorems {

using rigor::Interval;

void set_value(Quantity& quantity, const Interval& value, std::string why_not) {
  if (is_finite(value)) {
    quantity.value = value;
    quantity.not_applicable.reset();
    return;
  }
  quantity.value = Interval::empty();
  quantity.not_applicable =
      why_not.empty() ? quantity.name + " is undefined, or overflows, for the values of this design."
                      : std::move(why_not);
}

void add_quantity(Derivation& derivation, QuantityText text, const Interval& value, std::string why_not) {
  Quantity quantity{std::move(text.name),
                    std::move(text.symbol),
                    std::move(text.formula),
                    std::move(text.source),
                    Interval::empty(),
                    std::nullopt,
                    text.sense,
                    std::move(text.words)};
  set_value(quantity, value, std::move(why_not));
  derivation.quantities.push_back(std::move(quantity));
}

void conclude(Derivation& derivation) {
  std::vector<rigor::Verdict> verdicts;
  verdicts.reserve(derivation.conditions.size());
  for (const Condition& condition : derivation.conditions) {
    verdicts.push_back(condition.verdict);
  }
  derivation.verdict = rigor::conjunction(verdicts);
}

}  // namespace veritrack::theorems

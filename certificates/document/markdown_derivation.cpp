#include "certificates/document/markdown_derivation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates::markdown {

namespace {

/// "(2.43)" for an equation of the thesis; other conditions go by their name.
std::string condition_name(const std::string& id) {
  const bool is_equation = id.find_first_not_of("0123456789.") == std::string::npos;
  return is_equation ? "(" + id + ")" : "`" + id + "`";
}

}  // namespace

std::string conditions_table(const theorems::Derivation& derivation) {
  std::vector<theorems::Condition> conditions = derivation.conditions;
  std::stable_partition(conditions.begin(), conditions.end(), [](const theorems::Condition& condition) {
    return condition.verdict != rigor::Verdict::proved;  // what fails is what the reader looks for
  });
  std::vector<std::vector<std::string>> rows;
  rows.reserve(conditions.size());
  for (const theorems::Condition& condition : conditions) {
    rows.push_back({condition_name(condition.id), math(condition.statement),
                    rigor::is_empty(condition.lhs) ? "—" : enclosure(condition.lhs),
                    verdict(condition.verdict), condition.reason});
  }
  return table({"Condition", "Statement", "Left side", "Verdict", "Ground"}, rows);
}

std::string quantities_table(const theorems::Derivation& derivation,
                             QuantityText (*describe)(const std::string& name)) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(derivation.quantities.size());
  for (const theorems::Quantity& quantity : derivation.quantities) {
    const QuantityText text = describe(quantity.name);
    const std::string value =
        quantity.proved ? text.value(quantity.value, 4)
                        : fmt::format("≈ {:.3g} (sampled, not proved)", rigor::midpoint(quantity.value));
    rows.push_back({text.description, quantity.symbol.empty() ? "—" : math(quantity.symbol),
                    quantity.formula.empty() ? "—" : math(quantity.formula),
                    quantity.not_applicable ? "not applicable: " + *quantity.not_applicable : value});
  }
  return table({"Quantity", "Symbol", "Formula", "Value"}, rows);
}

std::string notes_list(const theorems::Derivation& derivation) {
  std::string text;
  for (const std::string& note : derivation.notes) {
    text += "- " + note + "\n";
  }
  return text;
}

}  // namespace veritrack::certificates::markdown

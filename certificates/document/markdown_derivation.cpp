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
    return condition.verdict != rigor::Verdict::proved;  // the reader looks for failures first
  });
  std::vector<std::vector<std::string>> rows;
  rows.reserve(conditions.size());
  for (const theorems::Condition& condition : conditions) {
    rows.push_back({condition_name(condition.id), math(condition.statement),
                    rigor::is_empty(condition.lhs) ? "—" : enclosure(condition.lhs),
                    answer(condition.verdict), condition.reason});
  }
  return table({"Condition", "Statement", "Left side", "Satisfied", "Ground"}, rows);
}

std::string value_text(const theorems::Quantity& quantity, int enclosure_digits) {
  constexpr int kDigits = 4;
  if (quantity.not_applicable) {
    return "not applicable: " + *quantity.not_applicable;
  }
  switch (quantity.sense) {
    case theorems::Sense::at_most:
      return at_most(quantity.value, kDigits);
    case theorems::Sense::at_least:
      return at_least(quantity.value, kDigits);
    case theorems::Sense::sampled:
      return fmt::format("≈ {:.3g} (sampled, not proved)", rigor::midpoint(quantity.value));
    case theorems::Sense::enclosure:
    case theorems::Sense::equal:
      break;
  }
  return enclosure(quantity.value, enclosure_digits);
}

std::string quantities_table(const theorems::Derivation& derivation, int enclosure_digits) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(derivation.quantities.size());
  for (const theorems::Quantity& quantity : derivation.quantities) {
    rows.push_back({quantity.words.empty() ? "`" + quantity.name + "`" : quantity.words,
                    quantity.symbol.empty() ? "—" : math(quantity.symbol),
                    quantity.formula.empty() ? "—" : math(quantity.formula),
                    value_text(quantity, enclosure_digits)});
  }
  return table({"Quantity", "Symbol", "Formula", "Value"}, rows);
}

std::string values_table(const theorems::Derivation& derivation) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(derivation.quantities.size());
  for (const theorems::Quantity& quantity : derivation.quantities) {
    rows.push_back(
        {quantity.words.empty() ? "`" + quantity.name + "`" : quantity.words, value_text(quantity)});
  }
  return table({"Quantity", "Value"}, rows);
}

std::string notes_list(const theorems::Derivation& derivation) {
  std::string text;
  for (const std::string& note : derivation.notes) {
    text += "- " + note + "\n";
  }
  return text;
}

}  // namespace veritrack::certificates::markdown

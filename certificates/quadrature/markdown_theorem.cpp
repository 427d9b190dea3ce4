#include "certificates/quadrature/markdown_theorem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"

namespace veritrack::certificates {

namespace {

using markdown::math;

constexpr const char* kTheorem = "theorem-2.9/";

/// "printed" of "theorem-2.9/printed".
std::string reading(const std::string& id) {
  return id.substr(id.find('/') + 1);
}

/// The quantity of that name, or null.
const theorems::Quantity* find(const theorems::Derivation& derivation, const std::string& name) {
  const auto found = std::find_if(derivation.quantities.begin(), derivation.quantities.end(),
                                  [&](const theorems::Quantity& quantity) { return quantity.name == name; });
  return found == derivation.quantities.end() ? nullptr : &*found;
}

/// The names of all quantities, in the order in which the readings bring them up.
std::vector<std::string> quantity_names(const Certificate& certificate) {
  std::vector<std::string> names;
  for (const auto& derivation : derivations_of(certificate, kTheorem)) {
    for (const auto& quantity : derivation.quantities) {
      if (std::find(names.begin(), names.end(), quantity.name) == names.end()) {
        names.push_back(quantity.name);
      }
    }
  }
  return names;
}

/// `text`, unless it is already there; several readings are distinguished by name.
void add_variant(std::string& cell, const std::string& text, const std::string& name) {
  if (cell.empty()) {
    cell = text;
  } else if (cell.find(text) == std::string::npos) {
    cell += "; " + name + ": " + text;
  }
}

/// Approximately the room: as a share of the bound, or in multiples of it where the value is far beyond a
/// lower bound.
std::string margin_text(const theorems::AuditPoint& point) {
  const double relative = rigor::midpoint(point.relative_margin);
  if (std::isfinite(relative)) {
    return std::fabs(relative) < 10.0 ? fmt::format("≈ {:.3g} % of the bound", 100.0 * relative)
                                      : fmt::format("≈ {:.2g} times the bound", relative);
  }
  const double margin = rigor::midpoint(point.margin);
  return std::isfinite(margin) ? fmt::format("≈ {:.3g}", margin) : "unknown";
}

std::string outcome_text(const theorems::Audit& audit, const theorems::AuditedInequality& inequality) {
  if (inequality.not_applicable) {
    return "not applicable: " + *inequality.not_applicable;
  }
  std::string text;
  if (inequality.violated > 0) {
    text = fmt::format("violated at {} of {} steps, first at step {}", inequality.violated,
                       inequality.steps_checked(), *inequality.first_violation);
    if (audit.refutes(inequality)) {
      text += ", while every assumption was satisfied: **not a bound for this run**";
    } else if (inequality.kind == theorems::AuditKind::claim) {
      text += ", after the run had left the theorem's assumptions";
    }
  } else {
    text = fmt::format("satisfied at {} of {} steps", inequality.satisfied, inequality.steps_checked());
  }
  if (inequality.undecided > 0) {
    text += fmt::format("; undecided at {}", inequality.undecided);
  }
  return text;
}

/// Whether some choice of the free parameters satisfies the conditions, and the point or the argument.
std::string feasibility_text(const theorems::Feasibility& feasibility) {
  std::string text =
      fmt::format("Satisfied for some choice of the free parameters: {}. {}",
                  markdown::answer(feasibility.verdict), markdown::escaped(feasibility.argument));
  const auto add_point = [&](const char* title, const std::vector<theorems::Quantity>& point) {
    std::string separator = title;
    for (const theorems::Quantity& quantity : point) {
      text += fmt::format("{}`{}` {}", separator, quantity.name, markdown::enclosure(quantity.value, 4));
      separator = ", ";
    }
    text += point.empty() ? "" : ".";
  };
  add_point(" Witness: ", feasibility.witness);
  add_point(" The least left side of (2.43) that a search found: ", feasibility.best_found);
  return text;
}

std::vector<std::string> audit_row(const theorems::Audit& audit,
                                   const theorems::AuditedInequality& inequality) {
  const bool evaluated = inequality.worst.has_value() && !inequality.not_applicable;
  return {math(inequality.statement),
          inequality.kind == theorems::AuditKind::assumption ? "assumed" : "claimed",
          outcome_text(audit, inequality), evaluated ? margin_text(*inequality.worst) : "—",
          evaluated ? fmt::format("{}", inequality.worst->step) : "—"};
}

}  // namespace

std::string audit_section(const Certificate& certificate) {
  std::string text = "## The constants along the simulated run\n\n";
  text +=
      "Each constant that is claimed to be a bound is compared with the run at every step; every inequality "
      "is evaluated in interval arithmetic on the run's own numbers. The margin is the distance from the "
      "value to the bound at the worst step, as a fraction of the bound. The run proves nothing, but a claim "
      "that it violates while every assumption is satisfied is refuted as a bound for this run.\n\n";
  for (const AuditedDerivation& audited : quadrature_particulars(certificate).audits) {
    text += fmt::format("### {}\n\n", reading(audited.derivation));
    std::vector<std::vector<std::string>> rows;
    for (const theorems::AuditedInequality& inequality : audited.audit.inequalities) {
      rows.push_back(audit_row(audited.audit, inequality));
    }
    text +=
        markdown::table({"Inequality", "In the thesis", "Along the run", "Worst margin", "At step"}, rows) +
        "\n";
  }
  return text;
}

std::string theorem_summary(const Certificate& certificate) {
  std::string text;
  for (const auto& derivation : derivations_of(certificate, kTheorem)) {
    const auto condition = [&](const std::string& id) {
      return std::find_if(derivation.conditions.begin(), derivation.conditions.end(),
                          [&](const theorems::Condition& candidate) { return candidate.id == id; });
    };
    const auto stability = condition("2.43");
    const auto start = condition("2.45");
    if (stability == derivation.conditions.end() || start == derivation.conditions.end()) {
      continue;
    }
    if (rigor::is_empty(stability->lhs)) {
      text += fmt::format(
          "- Theorem 2.9, *{}*: it cannot be evaluated, as some of its constants do not exist for this "
          "design.\n",
          reading(derivation.id));
      continue;
    }
    text += fmt::format(
        "- Theorem 2.9, *{}*: its main condition (2.43) requires that {} is below 1; for this design it is "
        "{}. It admits start errors of {}; the assumed start error is {}.\n",
        reading(derivation.id), math("\\beta(\\zeta + \\eta) + \\alpha"),
        stability->verdict == rigor::Verdict::proved ? markdown::at_most(stability->lhs)
                                                     : markdown::at_least(stability->lhs),
        markdown::at_most(start->rhs), markdown::at_most(start->lhs));
  }
  return text + (text.empty() ? "" : "\n");
}

std::string conditions_section(const Certificate& certificate) {
  std::string text = "## What Theorem 2.9 says about it: the conditions\n\n";
  text +=
      "The theorem (La Scala 1994, section 2.4.5) guarantees a bounded estimation error when all of its "
      "conditions are satisfied. There are two readings of its text: *printed* is the body of the thesis, "
      "*errata* has the changes of its errata sheet. *repaired* is our own theorem of the same form, with "
      "every gap of the proof closed (docs/repaired-theorem.md). The theorem is evaluated, not endorsed: "
      "conditions that are satisfied in the readings of the thesis guarantee nothing by themselves.\n\n";
  for (const auto& derivation : derivations_of(certificate, kTheorem)) {
    text += fmt::format("### {}: {}\n\n", derivation.title, markdown::satisfied(derivation.verdict));
    text += markdown::conditions_table(derivation) + "\n";
    if (derivation.feasibility) {
      text += feasibility_text(*derivation.feasibility) + "\n\n";
    }
    text += markdown::notes_list(derivation) + "\n";
  }
  return text;
}

std::string constants_section(const Certificate& certificate) {
  std::string text = "## Constants of Theorem 2.9\n\n";
  std::vector<std::string> header{"Constant", "Formula"};
  for (const auto& derivation : derivations_of(certificate, kTheorem)) {
    header.push_back(reading(derivation.id));
  }
  header.emplace_back("Source");

  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : quantity_names(certificate)) {
    std::string symbol;
    std::string formula;
    std::string source;
    std::vector<std::string> values;
    for (const auto& derivation : derivations_of(certificate, kTheorem)) {
      const theorems::Quantity* quantity = find(derivation, name);
      if (quantity == nullptr) {
        values.emplace_back("—");
        continue;
      }
      symbol = math(quantity->symbol);
      add_variant(formula, math(quantity->formula), reading(derivation.id));
      add_variant(source, quantity->source, reading(derivation.id));
      values.push_back(quantity->not_applicable ? "not applicable: " + *quantity->not_applicable
                                                : markdown::enclosure(quantity->value));
    }
    std::vector<std::string> row{symbol, formula};
    row.insert(row.end(), values.begin(), values.end());
    row.push_back(source);
    rows.push_back(row);
  }
  text += markdown::table(header, rows);
  return text +
         "\nEach value is enclosed: the true value of the formula lies between the two decimals, which are "
         "rounded outward.\n\n";
}

}  // namespace veritrack::certificates

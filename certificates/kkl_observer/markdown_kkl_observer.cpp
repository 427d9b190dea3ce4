#include "certificates/kkl_observer/markdown_kkl_observer.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"

namespace veritrack::certificates {

namespace {

using markdown::math;

std::string code(const Number& number) {
  return "`" + number.text + "`";
}

std::string range(const std::array<Number, 2>& bounds) {
  return fmt::format("[{}, {}]", code(bounds[0]), code(bounds[1]));
}

std::string design_section(const Certificate& certificate, const KklObserverTables& tables) {
  const Design& design = certificate.design;
  std::string text = "## The design and what is assumed\n\n";
  text += fmt::format("{}The tracker is `{}`.\n\n", markdown::quotation(design.name, design.source),
                      design.tracker);
  std::string rates;
  for (const Number& rate : tables.design.lambda) {
    rates += (rates.empty() ? "" : ", ") + code(rate);
  }
  const KklEll ell = kkl_ell_in_use(certificate);
  std::vector<std::vector<std::string>> rows{
      {"filter rates", math("\\lambda"), rates, "1/s"},
      {"constant of (9)", math("\\ell"),
       ell.decimal ? "`" + *ell.decimal + "`" : "the lower end of the proved one", "—"},
      {"frequency of the signal, always within", math("\\omega"), range(tables.assume.frequency), "rad/s"},
      {"amplitude of the signal, always within", math("A"), range(tables.assume.amplitude), "signal units"}};
  if (tables.design.sampling_interval) {
    rows.push_back({"interval between samples", math("h"), code(*tables.design.sampling_interval), "s"});
  }
  if (const auto& disturbance = tables.assume.disturbance; disturbance && disturbance->bound) {
    rows.push_back(
        {"disturbance, at all times", math("|d(t)| \\le"), code(*disturbance->bound), "signal units"});
  } else if (disturbance) {
    rows.push_back(
        {"sinusoidal disturbance, amplitude", math("a ="), code(*disturbance->amplitude), "signal units"});
    rows.push_back({"its frequency, at least", math("\\Omega \\ge"), code(*disturbance->frequency), "rad/s"});
  } else {
    rows.push_back({"disturbance", "—", "none", "—"});
  }
  return text + markdown::table({"Value", "Symbol", "Is", "Unit"}, rows) + "\n";
}

std::string derivation_section(const Certificate& certificate, const std::string& id,
                               const std::string& title, bool has_verdict) {
  std::string text;
  for (const theorems::Derivation& derivation : derivations_of(certificate, id)) {
    text += "## " + title + (has_verdict ? ": conditions " + markdown::satisfied(derivation.verdict) : "") +
            "\n\n";
    text += derivation.title +
            ". The computation and its proof are in `docs/kkl-observer.md` of the program's sources.\n\n";
    if (!derivation.conditions.empty()) {
      text += markdown::conditions_table(derivation) + "\n";
    }
    text += markdown::quantities_table(derivation) + "\n";
    text += markdown::notes_list(derivation) + "\n";
  }
  return text;
}

std::string figures_section(const MarkdownOptions& options) {
  std::string text;
  for (const FigureReference& figure : options.figures) {
    text += picture(figure);
  }
  return text.empty() ? text : "## In simulation\n\n" + text;
}

std::string coverage_section(const KklObserverTables& tables) {
  const char* filters =
      tables.design.sampling_interval
          ? "- Covered: the program, `KklObserver` of `trackers/kkl_observer/kkl_observer.hpp` for double, "
            "stepped along straight lines between samples: what lies between samples, and all rounding. "
            "Statements about a time are about the samples from then on."
          : "- Covered: estimates of the program (`kkl_inverse` and `in_engineering_units` of "
            "`trackers/kkl_observer/kkl_observer.hpp` for double, rounding included) from filters that solve "
            "their differential equations to within 1e-9 of the signal's amplitude over their rates. Not "
            "covered: how the filters are solved. With `sampling_interval` and a disturbance of which a "
            "bound "
            "is assumed, that is covered, too.";
  return fmt::format(
      "## What this certificate covers, and what it does not\n\n{} Every signal of constant amplitude and "
      "frequency within the assumed range, with any disturbance that satisfies the assumption. The "
      "assumptions on the compiler are in `docs/rounding.md`.\n- Not covered: the estimated phase.\n- The "
      "constant of (10) and the paper's claims are about exact arithmetic.\n- Every enclosure was computed "
      "with outward-rounded interval arithmetic. Results of solvers and simulations are marked as not "
      "proved, and no verdict depends on them.\n\n",
      filters);
}

}  // namespace

std::vector<const Claim*> kkl_observer_answers(const Certificate& certificate) {
  std::vector<const Claim*> found;
  for (const Claim& claim : certificate.claims) {
    if (claim.required && claim.verdict != rigor::Verdict::undecided) {
      found.push_back(&claim);
    }
  }
  return found;
}

std::string kkl_observer_sections(const Certificate& certificate, const MarkdownOptions& options) {
  return design_section(certificate, kkl_observer_tables(certificate.design)) +
         derivation_section(certificate, "kkl-robustness", "Errors under a disturbance", true) +
         derivation_section(certificate, "kkl-ell", "The constant of (10)", true) + figures_section(options) +
         coverage_section(kkl_observer_tables(certificate.design));
}

std::string kkl_observer_published(const Certificate& certificate) {
  return derivation_section(certificate, "kkl-paper", "The paper's claims", false) +
         derivation_section(certificate, "kkl-section-v", "The simulations of section V", false);
}

}  // namespace veritrack::certificates

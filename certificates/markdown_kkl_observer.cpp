#include "certificates/markdown_kkl_observer.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "certificates/kkl_observer.hpp"
#include "certificates/markdown_derivation.hpp"
#include "certificates/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

using markdown::escaped;
using markdown::math;

std::string code(const Number& number) {
  return "`" + number.text + "`";
}

std::string range(const std::array<Number, 2>& bounds) {
  return fmt::format("[{}, {}]", code(bounds[0]), code(bounds[1]));
}

/// What a quantity is, for people.
std::string description(const std::string& name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kDescriptions{{
      {"ell", "the constant of (10), verified"},
      {"ell_ipopt", "what Ipopt finds for (10) (not proved)"},
      {"ell_nlopt", "what NLopt finds locally (not proved)"},
      {"ell_nlopt_global", "what NLopt finds globally (not proved)"},
      {"argmin_omega", "the frequencies that can attain it, rad/s"},
      {"frequency_error_bound", "frequency error once settled, rad/s, at most"},
      {"amplitude_error_bound", "amplitude error once settled, signal units, at most"},
      {"settling_time", "settled after, s"},
      {"largest_ell", "the largest ell that leaves the disturbed inverse exact, at least"},
      {"frequency_error_simulated", "largest frequency error seen in simulation, rad/s (not proved)"},
      {"amplitude_error_simulated", "largest amplitude error seen in simulation, signal units (not proved)"},
      {"vandermonde_singular_value", "smallest singular value of the Vandermonde matrix"},
      {"injectivity_constant", "constant of the injectivity of T"},
      {"continuity_modulus", "bound on the slope of the inverse"},
  }};
  for (const auto& [known, text] : kDescriptions) {
    if (known == name) {
      return std::string(text);
    }
  }
  return name;
}

std::string design_section(const Certificate& certificate, const KklObserverTables& tables) {
  const Design& design = certificate.design;
  std::string text = "## The design and what is assumed\n\n";
  text += fmt::format("{} — tracker `{}`", escaped(design.name), design.tracker);
  text += design.source.empty() ? ".\n\n" : fmt::format(", from: {}.\n\n", escaped(design.source));
  std::string rates;
  for (const Number& rate : tables.design.lambda) {
    rates += (rates.empty() ? "" : ", ") + code(rate);
  }
  std::vector<std::vector<std::string>> rows{
      {"filter rates", math("\\lambda"), rates, "1/s"},
      {"constant of (9)", math("\\ell"),
       tables.design.ell ? code(*tables.design.ell) : "the lower end of the proved one", "—"},
      {"frequency of the signal, always within", math("\\omega"), range(tables.assume.frequency), "rad/s"},
      {"amplitude of the signal, always within", math("A"), range(tables.assume.amplitude), "signal units"}};
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
    text += "## " + title + (has_verdict ? ": " + markdown::verdict(derivation.verdict) : "") + "\n\n";
    text += derivation.title +
            ". What is computed, and why it is a proof, is in `docs/kkl-observer.md` of the "
            "program's sources.\n\n";
    text += markdown::conditions_table(derivation) + "\n";
    text += markdown::quantities_table(derivation, description) + "\n";
    text += markdown::notes_list(derivation) + "\n";
  }
  return text;
}

std::string figures_section(const MarkdownOptions& options) {
  std::string text;
  for (const FigureReference& figure : options.figures) {
    text += fmt::format("![{}]({})\n\n*{}*\n\n", escaped(figure.caption), figure.path, figure.caption);
  }
  return text.empty() ? text : "## In simulation\n\n" + text;
}

std::string coverage_section() {
  return "## What this certificate covers, and what it does not\n\n"
         "- Covered: the observer in continuous time and exact arithmetic, for every signal of constant "
         "amplitude and frequency within the assumed range, with any disturbance that keeps to the "
         "assumption. "
         "Not covered: sampling of the input, and rounding errors in double precision.\n"
         "- Every enclosure was computed with outward-rounded interval arithmetic. What solvers and "
         "simulation "
         "say is marked as not proved, and no verdict rests on it.\n\n";
}

}  // namespace

std::string kkl_observer_headline(const Certificate& certificate) {
  const auto frequency = proved_kkl_bound(certificate, "frequency_error_bound");
  const auto time = proved_kkl_bound(certificate, "settling_time");
  if (!frequency || !time) {
    return "Nothing is required of this design, and no bound on its errors is certified";
  }
  const auto shown = [](const rigor::Interval& value) {
    return rigor::to_decimal(value.upper(), 3, rigor::Direction::up);
  };
  return fmt::format(
      "Nothing is required of this design; PROVED of it: after {} s the frequency error stays at or below {} "
      "rad/s",
      shown(*time), shown(*frequency));
}

std::string kkl_observer_sections(const Certificate& certificate, const KklObserverTables& tables,
                                  const MarkdownOptions& options) {
  return design_section(certificate, tables) +
         derivation_section(certificate, "kkl-robustness", "What a disturbance does to it", true) +
         figures_section(options) + derivation_section(certificate, "kkl-ell", "The constant of (10)", true) +
         derivation_section(certificate, "kkl-paper", "The paper's claims", false) + coverage_section();
}

}  // namespace veritrack::certificates

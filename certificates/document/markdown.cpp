#include "certificates/document/markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/versions.hpp"
#include "certificates/document/markdown_formal_proofs.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/kkl_observer/markdown_kkl_observer.hpp"
#include "certificates/quadrature/comparison_table.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/markdown_contraction.hpp"
#include "certificates/quadrature/markdown_other_results.hpp"
#include "certificates/quadrature/markdown_theorem.hpp"
#include "certificates/quadrature/theorem_claims.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/single_channel/markdown_single_channel.hpp"

namespace veritrack::certificates {

namespace {

using markdown::escaped;
using markdown::math;
using rigor::Verdict;

/// "Theorem 2.9 guarantees nothing for it", or what else its readings together say.
std::string theorem_sentence(const Certificate& certificate) {
  std::vector<theorems::Derivation> readings = derivations_of(certificate, "theorem-2.9/");
  std::erase_if(readings, [](const theorems::Derivation& reading) {
    return reading.id == "theorem-2.9/repaired";  // ours, not the published theorem
  });
  const auto all_are = [&](Verdict verdict) {
    return std::all_of(readings.begin(), readings.end(),
                       [verdict](const theorems::Derivation& reading) { return reading.verdict == verdict; });
  };
  if (all_are(Verdict::refuted)) {
    return "Theorem 2.9 guarantees nothing for it: its conditions are REFUTED";
  }
  if (all_are(Verdict::proved)) {
    return "the conditions of Theorem 2.9 hold for it";
  }
  return "whether Theorem 2.9 applies to it is UNDECIDED";
}

std::string upper_case(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 32) : letter;
  });
  return text;
}

std::string requirement_section(const Certificate& certificate) {
  std::string text = "## What was required\n\n";
  if (!certificate.verdict) {
    return text +
           "Nothing: the design file's `[require]` is empty. What follows is what is certified of the design "
           "all the same, and what the published theorem says of it.\n\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      rows.push_back({claim.statement, markdown::verdict(claim.verdict), claim.reason});
    }
  }
  return text + markdown::table({"Requirement", "Verdict", "Ground"}, rows) + "\n";
}

std::string design_section(const Certificate& certificate) {
  const Design& design = certificate.design;
  const QuadratureEkfDesign& chosen = design.quadrature_ekf().design;
  std::string text = "## The design\n\n";
  text += fmt::format("{} — tracker `{}`", escaped(design.name), design.tracker);
  text += design.source.empty() ? ".\n\n" : fmt::format(", from: {}.\n\n", escaped(design.source));
  const auto row = [](const std::string& what, const std::string& symbol, const Number& number,
                      const std::string& unit) {
    return std::vector<std::string>{what, math(symbol), "`" + number.text + "`", unit};
  };
  text += markdown::table(
      {"Design value", "Symbol", "Value", "Unit"},
      {row("process noise variance, in-phase and quadrature", "q_1", chosen.q1, "signal units²"),
       row("process noise variance, frequency", "q_2", chosen.q2, "(rad/sample)²"),
       row("measurement noise variance, per channel", "r", chosen.r, "signal units²"),
       row("leak of the frequency state", "\\epsilon", chosen.epsilon, "—")});
  return text + "\n";
}

std::string covariance_text(const std::optional<CovarianceArray>& covariance) {
  if (!covariance) {
    return "the filter's steady state, in the frame of the estimated phase";
  }
  std::string text = "in the frame of the estimated phase, row by row:";
  for (const auto& row : *covariance) {
    text += fmt::format(" `[{}, {}, {}]`", row[0].text, row[1].text, row[2].text);
  }
  return text;
}

std::string assumptions_section(const Assumptions& assume) {
  const auto row = [](const std::string& what, const std::string& relation, const std::string& value,
                      const std::string& unit) {
    return std::vector<std::string>{what, relation.empty() ? value : math(relation) + " " + value, unit};
  };
  const auto code = [](const Number& number) { return "`" + number.text + "`"; };
  std::string text = "## Assumed of the signal and the start\n\n";
  text += markdown::table(
      {"Assumption", "Value", "Unit"},
      {row("amplitude of the signal", "A =", code(assume.amplitude), "signal units"),
       row("frequency, always within", "",
           fmt::format("[{}, {}]", code(assume.frequency[0]), code(assume.frequency[1])), "rad/sample"),
       row("measurement noise, every sample", "|v(k)| \\le", code(assume.noise), "signal units"),
       row("change of frequency, every sample", "|\\omega(k+1) - \\omega(k)| \\le", code(assume.slew),
           "rad/sample per sample"),
       row("error of frequency at the start", "|\\hat x_3(0) - \\omega(0)| \\le",
           code(assume.initial_frequency_error), "rad/sample"),
       row("error of phase at the start", "\\le", code(assume.initial_phase_error), "rad"),
       row("error of amplitude at the start", "\\le", code(assume.initial_amplitude_error), "signal units"),
       row("covariance at the start", "P(0|0):", covariance_text(assume.initial_covariance), "")});
  return text +
         "\nA decimal in these tables stands for itself: every computation covers both the decimal and the "
         "double nearest to it, which is what the filter runs with.\n\n";
}

std::string figures_section(const Certificate& certificate, const SimulationSettings& run,
                            const MarkdownOptions& options) {
  if (options.figures.empty()) {
    return "";
  }
  std::string text = "## The simulated run\n\n";
  text += fmt::format(
      "The double-precision tracker on the signal `{}`, {} samples, seed {}, started at the edge of the "
      "assumed start errors. A simulation proves nothing; it shows what the bounds are to be compared "
      "with.\n\n",
      run.signal, run.samples, run.seed);
  for (const std::string& note : certificate.simulation.notes) {
    text += note + "\n\n";
  }
  for (const FigureReference& figure : options.figures) {
    text += fmt::format("![{}]({})\n\n*{}*\n\n", escaped(figure.caption), figure.path, figure.caption);
  }
  return text;
}

std::string coverage_section() {
  return "## What this certificate covers, and what it does not\n\n"
         "- Covered: every enclosure here was computed with outward-rounded interval arithmetic from the "
         "design "
         "values; the true value lies in it. A verdict PROVED or REFUTED follows from the enclosures; "
         "UNDECIDED "
         "means that neither could be shown.\n"
         "- The contraction certificate holds for every signal and every start that keep to the assumptions: "
         "any "
         "noise and any change of frequency within the bounds, whatever their statistics. It covers a signal "
         "of "
         "constant amplitude.\n"
         "- Covered is the tracker in exact arithmetic. Not covered: its rounding errors in double "
         "precision.\n"
         "- Theorem 2.9 is evaluated, not endorsed: the readings *printed* and *errata* take the thesis at "
         "its word. "
         "Conditions that hold in them are no guarantee by themselves, and no PROVED requirement rests on "
         "them. A "
         "REFUTED condition says that the theorem is silent about this design, not that the tracker fails.\n"
         "- The audit and the figures are one simulated run in double precision; its numbers are marked ≈ "
         "and prove "
         "nothing. A bound that the run violates is no bound for that run.\n\n";
}

std::string reproduction_section(const Certificate& certificate, const MarkdownOptions& options) {
  std::string text = "## How to reproduce it\n\n";
  text += fmt::format("Save the design file below as `{}` and run\n\n", certificate.design_file);
  text += markdown::fenced(
      "veritrack certify " + certificate.design_file + (certificate.formal_proofs ? " --coq" : ""), "");
  text +=
      "\nThe same file gives the same bytes. `certificate.json` beside this document holds every number with "
      "all its digits, as hexadecimal floats.\n\n";
  std::vector<std::vector<std::string>> rows{{"veritrack", VERITRACK_VERSION}};
  for (const auto& [name, version] : rigor::arithmetic_versions()) {
    rows.push_back({escaped(name), escaped(version)});
  }
  if (!options.drawn_with.empty()) {
    rows.push_back({"figures", escaped(options.drawn_with)});
  }
  text += markdown::table({"Software", "Version"}, rows) + "\n";
  return text + fmt::format("`{}`:\n\n", certificate.design_file) +
         markdown::fenced(certificate.design_text, "toml");
}

/// The document of a quadrature tracker.
std::string document(const Certificate& certificate, const MarkdownOptions& options,
                     const QuadratureEkfTables& tables) {
  return "# " + headline(certificate) + "\n\n" + guarantee_section(certificate) +
         summary_section(certificate) + requirement_section(certificate) + design_section(certificate) +
         assumptions_section(tables.assume) + contraction_section(certificate) +
         comparison_section(certificate) + figures_section(certificate, tables.simulate, options) +
         conditions_section(certificate) + proof_section(certificate) + other_results_section(certificate) +
         constants_section(certificate) + other_constants_section(certificate) + audit_section(certificate) +
         coverage_section() + formal_proofs_section(certificate) + reproduction_section(certificate, options);
}

std::string document(const Certificate& certificate, const MarkdownOptions& options,
                     const KklObserverTables& tables) {
  return "# " + headline(certificate) + "\n\n" + requirement_section(certificate) +
         kkl_observer_sections(certificate, tables, options) + formal_proofs_section(certificate) +
         reproduction_section(certificate, options);
}

/// The document of a single-channel tracker.
std::string document(const Certificate& certificate, const MarkdownOptions& options,
                     const SingleChannelEkfTables& tables) {
  return "# " + headline(certificate) + "\n\n" + guarantee_section(certificate) +
         single_channel_summary(certificate) + requirement_section(certificate) +
         single_channel_design_section(certificate) + assumptions_section(tables.assume) +
         contraction_section(certificate) + bias_section(certificate) +
         figures_section(certificate, tables.simulate, options) + transfer_function_section(certificate) +
         proposition_section(certificate) + single_channel_coverage_section() +
         formal_proofs_section(certificate) + reproduction_section(certificate, options);
}

}  // namespace

std::string headline(const Certificate& certificate) {
  if (!certificate.verdict && std::holds_alternative<KklObserverTables>(certificate.design.tables)) {
    return kkl_observer_headline(certificate);
  }
  if (!certificate.verdict) {
    const std::optional<rigor::Interval> bound = proved_frequency_bound(certificate);
    if (!bound && std::holds_alternative<SingleChannelEkfTables>(certificate.design.tables)) {
      return single_channel_headline(certificate);
    }
    if (bound) {
      return fmt::format(
          "Nothing is required of this design; PROVED of it: the frequency error stays at or below {} "
          "rad/sample for ever",
          rigor::to_decimal(bound->upper(), 3, rigor::Direction::up));
    }
    return "Nothing is required of this design, nothing is certified for the assumed start, and " +
           theorem_sentence(certificate);
  }
  std::string text;
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      text += text.empty() ? "" : "; ";
      text += upper_case(rigor::to_string(claim.verdict)) + ": " + claim.statement;
    }
  }
  return (*certificate.verdict == Verdict::proved ? "" : "NOT PROVED. ") + text;
}

std::string to_markdown(const Certificate& certificate, const MarkdownOptions& options) {
  return std::visit([&](const auto& tables) { return document(certificate, options, tables); },
                    certificate.design.tables);
}

}  // namespace veritrack::certificates

// The quadrature tracker as a kind of tracker: its record, and the parts of its document that no other has.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/quadrature/comparison_table.hpp"
#include "certificates/quadrature/coq_theorem_2_9.hpp"
#include "certificates/quadrature/lock.hpp"
#include "certificates/quadrature/lowest_snr.hpp"
#include "certificates/quadrature/markdown_other_results.hpp"
#include "certificates/quadrature/markdown_theorem.hpp"
#include "certificates/quadrature/mean_square.hpp"
#include "certificates/quadrature/quadrature_certificate.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_json.hpp"
#include "certificates/quadrature/quadrature_run.hpp"
#include "certificates/quadrature/quadrature_tuning.hpp"
#include "certificates/quadrature/theorem_claims.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/sets/markdown_assumptions.hpp"
#include "certificates/sets/markdown_contraction.hpp"

namespace veritrack::certificates {

namespace {

using markdown::escaped;
using markdown::math;

std::string design_section(const Certificate& certificate) {
  const Design& design = certificate.design;
  const QuadratureDesignTable& chosen = quadrature_tables(design).design;
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

std::string coverage_section() {
  return "## What this certificate covers, and what it does not\n\n- Covered: every enclosure here was "
         "computed with outward-rounded interval arithmetic from the design values; the true value lies in "
         "it. A verdict PROVED or REFUTED follows from the enclosures; UNDECIDED means that neither could be "
         "shown.\n- The contraction certificate is valid for every signal and every start that satisfy the "
         "assumptions: any noise and any change of frequency within the bounds, with any statistics. It "
         "covers a signal of constant amplitude.\n- The tracker is covered as it runs in double precision: "
         "IEEE 754, rounding to nearest, sine and cosine of the C library within 1 ulp, without -ffast-math. "
         "What rounding adds to a step is bounded and added to noise and slew (docs/rounding.md). The "
         "theorems "
         "of other authors are about exact arithmetic.\n- Theorem 2.9 is evaluated, not endorsed: the "
         "readings *printed* and *errata* follow the thesis literally. Conditions that are PROVED in them "
         "are no guarantee by themselves, and no PROVED requirement depends on them. A REFUTED condition "
         "means that the theorem does not apply to this design, not that the tracker fails.\n- The audit and "
         "the figures are one simulated run in double precision; its numbers are marked ≈ and prove nothing. "
         "A bound that the run violates is not a bound for that run.\n\n";
}

std::string summary(const Certificate& certificate) {
  if (quadrature_tables(certificate.design).assume.gaussian) {
    return guarantee_section(certificate);
  }
  return guarantee_section(certificate) + summary_section(certificate);
}

std::string sections(const Certificate& certificate, const MarkdownOptions& options) {
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  if (tables.assume.gaussian) {
    return design_section(certificate) + assumptions_section(tables.assume) + lock_section(certificate) +
           mean_square_section(certificate) + lowest_snr_section(certificate) +
           simulated_run_section(certificate, tables.simulate, options) + lock_coverage_section();
  }
  return design_section(certificate) + assumptions_section(tables.assume) + contraction_section(certificate) +
         comparison_section(certificate) + simulated_run_section(certificate, tables.simulate, options) +
         conditions_section(certificate) + proof_section(certificate) + other_results_section(certificate) +
         constants_section(certificate) + other_constants_section(certificate) + audit_section(certificate) +
         coverage_section();
}

}  // namespace

const TrackerKind& quadrature_kind() {
  static const TrackerKind kind{.name = "quadrature-ekf",
                                .design_json = quadrature_design_json,
                                .certify = certify_quadrature,
                                .summary = summary,
                                .sections = sections,
                                .evidence_json = quadrature_evidence_json,
                                .report_json = quadrature_report_json,
                                .formal_proofs = coq::theorem_2_9_proofs,
                                .tune = tune_quadrature,
                                .tuning_objectives = quadrature_tuning_objectives(),
                                .track = quadrature_on_samples};
  return kind;
}

}  // namespace veritrack::certificates

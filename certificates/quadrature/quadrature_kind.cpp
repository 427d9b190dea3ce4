// The quadrature tracker as a kind of tracker: its record, and the parts of its document that no other
// tracker has.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/quadrature/comparison_table.hpp"
#include "certificates/quadrature/coq_quadrature.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/linear_filter.hpp"
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
#include "certificates/sets/frequency_promise.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/sets/markdown_assumptions.hpp"
#include "certificates/sets/markdown_contraction.hpp"

namespace veritrack::certificates {

namespace {

using markdown::math;

std::string design_section(const Certificate& certificate) {
  const Design& design = certificate.design;
  const QuadratureDesignTable& chosen = quadrature_tables(design).design;
  std::string text = "## The design\n\n";
  text += fmt::format("{}The tracker is `{}`.\n\n", markdown::quotation(design.name, design.source),
                      design.tracker);
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
  return "## What this certificate covers, and what it does not\n\n- Covered: every signal and every start "
         "that "
         "satisfy the assumptions, any noise and any change of frequency within the bounds, with any "
         "statistics, at constant amplitude.\n- The tracker is covered as it runs in double precision: IEEE "
         "754, rounding to nearest, sine and cosine of the C library within 1 ulp, without -ffast-math. The "
         "rounding error of a step is bounded and added to noise and slew (docs/rounding.md).\n- Every "
         "enclosure was computed with outward-rounded interval arithmetic: the true value lies in it.\n- "
         "Simulated numbers are marked ≈ and prove nothing.\n\n";
}

/// The words of the guarantee, without "and with".
std::string start_covariance_of(const Certificate& certificate) {
  const std::string words = start_covariance_words(certificate);
  return words.substr(words.find("P(0|0)"));
}

FrequencyPromise frequency_promise(const Certificate& certificate) {
  return ekf_frequency_promise(certificate, quadrature_tables(certificate.design).assume, true);
}

/// Theorem 2.9 and the other results of papers are about noise with a bound.
std::string published(const Certificate& certificate) {
  if (quadrature_tables(certificate.design).assume.gaussian) {
    return "";
  }
  return theorem_summary(certificate) + comparison_section(certificate, ComparedResults::all) +
         conditions_section(certificate) + proof_section(certificate) + other_results_section(certificate) +
         constants_section(certificate) + other_constants_section(certificate) + audit_section(certificate);
}

std::string sections(const Certificate& certificate, const MarkdownOptions& options) {
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  if (tables.assume.gaussian) {
    return design_section(certificate) + assumptions_section(tables.assume) + lock_section(certificate) +
           mean_square_section(certificate) + lowest_snr_section(certificate) +
           linear_filter_section(certificate) + simulated_run_section(certificate, tables.simulate, options) +
           lock_coverage_section();
  }
  return design_section(certificate) + assumptions_section(tables.assume, start_covariance_of(certificate)) +
         contraction_section(certificate) + linear_filter_section(certificate) +
         comparison_section(certificate, ComparedResults::of_the_theorem) +
         simulated_run_section(certificate, tables.simulate, options) + coverage_section();
}

}  // namespace

const TrackerKind& quadrature_kind() {
  static const TrackerKind kind{.name = "quadrature-ekf",
                                .design_json = quadrature_design_json,
                                .certify = certify_quadrature,
                                .answers = guarantees,
                                .sections = sections,
                                .published_results = quadrature_published_results,
                                .published = published,
                                .evidence_json = quadrature_evidence_json,
                                .report_json = quadrature_report_json,
                                .formal_proofs = coq::quadrature_proofs,
                                .tune = tune_quadrature,
                                .tuning_objectives = quadrature_tuning_objectives(),
                                .track = quadrature_on_samples,
                                .frequency_promise = frequency_promise};
  return kind;
}

}  // namespace veritrack::certificates

#include "certificates/regulator/markdown_regulator.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/regulator/regulator.hpp"

namespace veritrack::certificates {

namespace {

std::string plant_section(const Certificate& certificate) {
  const Design& design = certificate.design;
  const RegulatorTables& tables = regulator_tables(design);
  std::string text = "## The plant and the regulator\n\n";
  text += fmt::format("{}The tracker is `{}`.\n\n", markdown::quotation(design.name, design.source),
                      design.tracker);
  text += fmt::format(
      "The plant is $`A_1 x_{{k+1}} = B_1 u_k`$, the output $`y_k = x_k + v_k`$ with the disturbance $`v`$, "
      "a tone. In "
      "the delay $`q^{{-1}}`$,\n\n```\nA1 = {}\nB1 = {}\n```\n\nThe regulator knows the plant. It hands "
      "$`v_k`$, the "
      "output less the plant's own answer, to a frequency tracker (`{}`), and sets $`B_1 u_k = -(2 "
      "\\cos\\hat\\omega_k\\, "
      "A_1 v_k - A_1 v_{{k-1}})`$. At a constant frequency, without noise and after the first samples, then "
      "$`A_1 "
      "y_{{k+1}} = 2 (\\cos\\omega - \\cos\\hat\\omega_k) A_1 v_k`$, so that a bound on the frequency error "
      "is "
      "one on the output; what a slew, noise and the first samples add is in `docs/regulator.md` of the "
      "program's sources.\n\n",
      delay_polynomial("1", tables.plant.a), delay_polynomial(tables.plant.b.front().text, tables.plant.b, 1),
      tables.design.frequency_tracker.tracker);
  return text;
}

std::string output_section(const Certificate& certificate) {
  const theorems::Derivation& found = certificate.derivations.back();
  return "## The output: conditions " + markdown::satisfied(found.verdict) + "\n\n" +
         markdown::conditions_table(found) + "\n" + markdown::quantities_table(found) + "\n";
}

std::string tracker_section(const Certificate& certificate) {
  const Certificate& tracker = regulator_particulars(certificate).tracker;
  return "## The frequency tracker\n\nThis section concerns the tracker alone.\n\n" +
         markdown::with_lower_headings(kind_of(tracker.design).sections(tracker, {}));
}

std::string loop_coverage() {
  return "## What this certificate covers, and what it does not\n\n- Covered: every tone and every start of "
         "the "
         "tracker that the tracker's certificate covers, with the frequency in the assumed band at every "
         "sample; noise "
         "in the measured output up to the assumed bound, which the tracker sees and the control law, too. "
         "The output "
         "is the true one, without the noise in its measurement.\n- The tracker is covered as its own "
         "certificate "
         "says. The regulator's own sums are those of exact arithmetic.\n- Not covered: a plant that differs "
         "from the "
         "one given, an input that saturates, a disturbance that is not a tone.\n- Every enclosure was "
         "computed with "
         "outward-rounded interval arithmetic. The simulation proves nothing.\n\n";
}

}  // namespace

std::vector<const Claim*> regulator_answers(const Certificate& certificate) {
  const auto claim = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [](const Claim& one) { return one.id == "regulator/guarantee"; });
  return claim == certificate.claims.end() ? std::vector<const Claim*>{} : std::vector{&*claim};
}

std::string regulator_sections(const Certificate& certificate, const MarkdownOptions& options) {
  std::string figures;
  for (const FigureReference& figure : options.figures) {
    figures += picture(figure);
  }
  return plant_section(certificate) + output_section(certificate) +
         (figures.empty() ? "" : "## In simulation\n\n" + figures) + tracker_section(certificate) +
         loop_coverage();
}

}  // namespace veritrack::certificates

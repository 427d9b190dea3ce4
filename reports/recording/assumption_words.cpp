// The assumptions of a certificate and a recording, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "certificates/document/markdown_text.hpp"
#include "reports/recording/assumption_list.hpp"

namespace veritrack::reports {

namespace {

/// The names of those with an outcome, each once: "noise, slew".
std::string names_with(const std::vector<TestedAssumption>& rows, TestedAssumption::Outcome outcome) {
  std::vector<std::string> names;
  for (const TestedAssumption& each : rows) {
    if (each.outcome == outcome && std::find(names.begin(), names.end(), each.name) == names.end()) {
      names.push_back(each.name);
    }
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

bool has(const std::vector<TestedAssumption>& rows, TestedAssumption::Outcome outcome) {
  return std::any_of(rows.begin(), rows.end(),
                     [outcome](const auto& each) { return each.outcome == outcome; });
}

}  // namespace

std::string assumptions_sentence(const TrackReport& report) {
  const std::vector<TestedAssumption> rows = tested_assumptions(report);
  const std::string open = names_with(rows, TestedAssumption::Outcome::not_testable);
  if (has(rows, TestedAssumption::Outcome::not_kept)) {
    return fmt::format("The recording does not keep to the certificate's assumptions: {}.",
                       names_with(rows, TestedAssumption::Outcome::not_kept));
  }
  if (report.result.assumptions.judged == 0) {
    return "Whether the recording keeps to the certificate's assumptions was not tested: " +
           std::string(why_none_judged(report.result)) + ".";
  }
  return fmt::format("Tested and kept, as far as estimates tell: {}. Not testable here: {}.",
                     names_with(rows, TestedAssumption::Outcome::kept), open);
}

std::string assumptions_section(const TrackReport& report) {
  std::string text = "## What the certificate assumes, and the recording\n\n";
  std::vector<std::vector<std::string>> rows;
  for (const TestedAssumption& each : tested_assumptions(report)) {
    const char* const outcome = each.outcome == TestedAssumption::Outcome::kept       ? "tested and kept"
                                : each.outcome == TestedAssumption::Outcome::not_kept ? "**not kept**"
                                                                                      : "not testable here";
    rows.push_back(
        {each.name, certificates::markdown::escaped(each.assumed), each.seen, outcome, each.where});
  }
  text += certificates::markdown::table({"", "assumed", "seen", "outcome", "where, or why"}, rows);
  const AssumptionFindings& found = report.result.assumptions;
  if (found.judged > 0) {
    text += fmt::format(
        "\nThe values seen are estimates. A {} is fitted to each stretch of {} samples in lock, with an "
        "amplitude and a "
        "frequency that may drift in it; {} of {} samples lie in such stretches, and only these were tested. "
        "Around the "
        "fit, the noise is at most {:.4g}, with a root mean square of {:.4g} in each channel. Slew and "
        "frequency count "
        "as exceeded when they are by more than five deviations of the estimate in white noise.\n",
        Waveform(report.assume.signal, report.result.channels).is_tone() ? "tone"
                                                                         : "signal as in the design file",
        report.result.window, found.judged, report.result.samples, found.largest_residual,
        found.noise_deviation);
  }
  return text + "\n";
}

}  // namespace veritrack::reports

#include "certificates/markdown_contraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "certificates/guarantee.hpp"
#include "certificates/markdown_derivation.hpp"
#include "certificates/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

/// What a quantity is, with its unit.
std::string description(const std::string& name) {
  static constexpr std::array<std::pair<const char*, const char*>, 11> kDescriptions{{
      {"contraction_rate", "factor by which the error shrinks, per sample, at least"},
      {"radius", "radius of the certified set, in its metric"},
      {"frequency_error_radius", "frequency error at the edge of the set, rad/sample"},
      {"phase_error_radius", "phase error at the edge of the set, rad"},
      {"amplitude_error_radius", "amplitude error at the edge of the set, relative"},
      {"ultimate_frequency_error", "frequency error in the long run, at most, rad/sample"},
      {"frequency_error_bound",
       "frequency error at any sample from the assumed start on, at most, rad/sample"},
      {"settling_samples", "samples until within twice the long-run bound"},
      {"largest_noise", "largest certified noise (without slew), relative to the amplitude"},
      {"largest_slew", "largest certified slew (without noise), rad/sample per sample"},
      {"bias_frequency", "steady-state frequency error of the leak, rad/sample"},
  }};
  const auto* found = std::find_if(kDescriptions.begin(), kDescriptions.end(),
                                   [&](const auto& entry) { return name == entry.first; });
  return found == kDescriptions.end() ? "`" + name + "`" : std::string(found->second);
}

std::string value_of(const theorems::Derivation& derivation, const std::string& name) {
  for (const theorems::Quantity& quantity : derivation.quantities) {
    if (quantity.name == name && !quantity.not_applicable) {
      return markdown::enclosure(quantity.value, 3);
    }
  }
  return "unknown";
}

}  // namespace

std::string contraction_summary(const Certificate& certificate) {
  const std::vector<theorems::Derivation> found = derivations_of(certificate, "contraction");
  if (found.empty()) {
    return "";
  }
  const theorems::Derivation& derivation = found.front();
  const auto value = [&](const char* name) { return value_of(derivation, name); };
  if (derivation.verdict == rigor::Verdict::proved) {
    const bool covers_start = proved_frequency_bound(certificate).has_value();
    return fmt::format(
        "- Contraction, **PROVED**: with the assumed noise and slew, every start in the certified set stays "
        "in it for "
        "ever. The set reaches to a frequency error of {} rad/sample; in it the error shrinks by the factor "
        "{} a "
        "sample at least, and in the long run the frequency error is at most the value {} rad/sample. {} "
        "Largest "
        "certified noise {} (relative to the amplitude, without slew); largest certified slew {} rad/sample "
        "per sample "
        "(without noise).\n",
        value("frequency_error_radius"), value("contraction_rate"), value("ultimate_frequency_error"),
        covers_start
            ? fmt::format(
                  "The assumed start lies in the set: from the first sample on the frequency error is "
                  "at most the value {} rad/sample.",
                  value("frequency_error_bound"))
            : "Whether the assumed start lies in the set is not shown.",
        value("largest_noise"), value("largest_slew"));
  }
  for (const theorems::Condition& condition : derivation.conditions) {
    if (condition.verdict == derivation.verdict) {
      return fmt::format("- Contraction, {}: {}: {}\n", markdown::verdict(derivation.verdict), condition.id,
                         condition.reason);
    }
  }
  return fmt::format("- Contraction, {}.\n", markdown::verdict(derivation.verdict));
}

std::string contraction_section(const Certificate& certificate) {
  std::string text;
  for (const theorems::Derivation& derivation : derivations_of(certificate, "contraction")) {
    text +=
        fmt::format("## What is certified of it: contraction, {}\n\n", markdown::verdict(derivation.verdict));
    const bool leaks = certificate.design.quadrature_ekf().design.epsilon.nearest > 0.0;
    text += fmt::format("{}. The proof is in `{}` of the program's sources.\n\n", derivation.title,
                        leaks ? "analysis/contraction/ball.hpp" : "docs/contraction.md");
    text += markdown::conditions_table(derivation) + "\n";
    text += markdown::quantities_table(derivation, description) + "\n";
    text += markdown::notes_list(derivation) + "\n";
  }
  return text;
}

}  // namespace veritrack::certificates

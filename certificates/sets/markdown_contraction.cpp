#include "certificates/sets/markdown_contraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

using markdown::QuantityText;

/// What a quantity is, with its unit, and which of its ends is the bound.
QuantityText describe(const std::string& name) {
  struct Entry {
    const char* name;
    const char* description;
    std::string (*value)(const rigor::Interval& value, int digits);
  };
  using markdown::at_least;
  using markdown::at_most;
  using markdown::enclosure;
  static constexpr std::array<Entry, 19> kEntries{{
      {"contraction_rate", "factor by which the error shrinks, per sample", at_most},
      {"radius", "radius of the certified set, in its metric", enclosure},
      {"frequency_error_radius", "frequency error to which the set reaches, rad/sample", at_least},
      {"phase_error_radius", "phase error to which the set reaches, rad", at_least},
      {"amplitude_error_radius", "amplitude error to which the set reaches, relative", at_least},
      {"ultimate_frequency_error", "frequency error in the long run, rad/sample", at_most},
      {"frequency_error_bound", "frequency error at any sample from the assumed start on, rad/sample",
       at_most},
      {"settling_samples", "samples until within twice the long-run bound", at_most},
      {"largest_noise", "largest certified noise (at constant frequency), relative to the amplitude",
       at_least},
      {"largest_slew", "largest certified slew (without noise), rad/sample per sample", at_least},
      {"frequency_error_radius_sampled_limit",
       "frequency error at which a search finds a step out of the set, rad/sample", enclosure},
      {"frequency_error_radius_share_of_limit", "certified radius over that at which the search succeeds",
       enclosure},
      {"frequency_error_bound_tightness",
       "largest frequency error found from the rim of its set, over the bound", enclosure},
      {"ultimate_frequency_error_tightness", "largest frequency error found from zero error, over the bound",
       enclosure},
      {"bias_frequency", "steady-state frequency error of the leak, rad/sample", enclosure},
      {"capture_samples", "samples until every assumed start is in the certified set", at_most},
      {"wrong_lock_frequency_error", "frequency error that a start ends with, rad/sample", at_least},
      {"cells", "cells of assumed starts", enclosure},
      {"cells_captured", "of them captured", enclosure},
  }};
  const auto* found =
      std::find_if(kEntries.begin(), kEntries.end(), [&](const Entry& entry) { return name == entry.name; });
  return found == kEntries.end() ? QuantityText{"`" + name + "`", enclosure}
                                 : QuantityText{found->description, found->value};
}

std::string derivation_tables(const theorems::Derivation& derivation) {
  return markdown::conditions_table(derivation) + "\n" + markdown::quantities_table(derivation, describe) +
         "\n" + (derivation.notes.empty() ? "" : markdown::notes_list(derivation) + "\n");
}

}  // namespace

std::string contraction_section(const Certificate& certificate) {
  std::string text;
  for (const theorems::Derivation& derivation : derivations_of(certificate, "contraction")) {
    text +=
        fmt::format("## What is certified of it: contraction, {}\n\n", markdown::verdict(derivation.verdict));
    text += fmt::format("{}. The proof is in `{}` of the program's sources.\n\n", derivation.title,
                        derivation.quantities.front().source);
    text += derivation_tables(derivation);
  }
  for (const theorems::Derivation& derivation : derivations_of(certificate, "capture")) {
    const char* disturbed = derivation.id == "capture"              ? "under the assumed noise and slew"
                            : derivation.id == "capture/noise-free" ? "without noise and slew"
                                                                    : "under less noise and slew";
    text += fmt::format("## Starts beyond the certified set: capture {}, {}\n\n", disturbed,
                        markdown::verdict(derivation.verdict));
    text += derivation.title +
            ", by verified propagation: boxes of starts are followed sample by sample, with everything that "
            "noise and slew can do to them, and cut in two where they cannot be followed.\n\n";
    text += derivation_tables(derivation);
  }
  return text;
}

}  // namespace veritrack::certificates

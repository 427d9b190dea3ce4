#include "certificates/sets/markdown_contraction.hpp"

#include <fmt/format.h>

#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

std::string derivation_tables(const theorems::Derivation& derivation) {
  return markdown::conditions_table(derivation) + "\n" + markdown::values_table(derivation) + "\n" +
         (derivation.notes.empty() ? "" : markdown::notes_list(derivation) + "\n");
}

}  // namespace

std::string contraction_section(const Certificate& certificate) {
  std::string text;
  for (const theorems::Derivation& derivation : derivations_of(certificate, "contraction")) {
    text += fmt::format("## What is certified for it: contraction, conditions {}\n\n",
                        markdown::satisfied(derivation.verdict));
    text += fmt::format("{}. The proof is in `{}` of the program's sources.\n\n", derivation.title,
                        derivation.quantities.front().source);
    text += derivation_tables(derivation);
  }
  for (const theorems::Derivation& derivation : derivations_of(certificate, "capture")) {
    const char* disturbed = derivation.id == "capture"              ? "under the assumed noise and slew"
                            : derivation.id == "capture/noise-free" ? "without noise and slew"
                                                                    : "under less noise and slew";
    text += fmt::format("## Starts beyond the certified set: capture {}, conditions {}\n\n", disturbed,
                        markdown::satisfied(derivation.verdict));
    text += derivation.title +
            ", by verified propagation: boxes of starts are followed sample by sample, for all noise and "
            "slew within the bounds, and are bisected where they cannot be followed.\n\n";
    text += derivation_tables(derivation);
  }
  return text;
}

}  // namespace veritrack::certificates

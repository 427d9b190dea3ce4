#include "certificates/dft_block/markdown_dft_block.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

std::string block_filter_section(const Certificate& certificate) {
  const Design& design = certificate.design;
  const BlockTables& tables = block_tables(design);
  std::string text = "## The tracker\n\n";
  text += fmt::format("{} — tracker `{}`", markdown::escaped(design.name), design.tracker);
  text += design.source.empty() ? ".\n\n" : fmt::format(", from: {}.\n\n", markdown::escaped(design.source));
  text += fmt::format(
      "The filter of chapter 4 of La Scala's thesis sees {} bins of the Fourier transform of each block of "
      "$`T`$ "
      "samples, $`M - {}`$ to $`M + {}`$, and follows the square root $`x_1`$ of the tone's amplitude over "
      "$`4\\pi`$, its phase, and its offset $`\\delta`$: the frequency is $`2\\pi(M + \\delta)/T`$ "
      "rad/sample, so "
      "that an error of 0.1 bins is one of $`0.2\\pi/T`$ rad/sample. Errors are measured at the middle of a "
      "block, "
      "where phase and offset are seen apart.\n\n",
      static_cast<int>(2.0 * tables.design.half_width.nearest) + 1, tables.design.half_width.text,
      tables.design.half_width.text);
  return text;
}

std::string block_set_section(const Certificate& certificate) {
  const theorems::Derivation& found = certificate.derivations.back();
  return "## The set about the exact lock: conditions " + markdown::satisfied(found.verdict) + "\n\n" +
         markdown::conditions_table(found) + "\n" + markdown::values_table(found) + "\n" +
         markdown::notes_list(found) + "\n";
}

std::string block_coverage() {
  return "## What this certificate covers, and what it does not\n\n- Covered: every tone whose offset stays "
         "between "
         "the assumed bounds and changes by no more than the assumed slew from one block to the next, and is "
         "constant within each block; any noise in the bins up to the assumed length, whatever its "
         "distribution; "
         "every start within the assumed errors.\n- Of the model (4.9), not of the samples: what a real "
         "tone's "
         "transform is beside it (about the amplitude over $`T`$) has to be counted as noise, and so has "
         "what a "
         "frequency that changes within a block adds.\n- Exact lock is a fixed point for every offset: "
         "without "
         "noise and slew, errors of the set fall to zero.\n- Not covered: starts outside. From some of them "
         "the "
         "filter never finds the tone, but stays about a number of bins off: `docs/block-tracker.md` of the "
         "program's sources says how that is seen from outside.\n- Exact arithmetic; every enclosure was "
         "computed with "
         "outward-rounded interval arithmetic. The simulation proves nothing.\n\n";
}

}  // namespace

std::string dft_block_summary(const Certificate& certificate) {
  const auto claim = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [](const Claim& one) { return one.id == "dft-block/guarantee"; });
  if (claim == certificate.claims.end()) {
    return "";
  }
  const bool is_proved = claim->verdict == rigor::Verdict::proved;
  return fmt::format("{}: {}\n\n{}: {}\n\n", markdown::verdict(claim->verdict), claim->statement,
                     is_proved ? "Why" : "Why not", claim->reason);
}

std::string dft_block_sections(const Certificate& certificate, const MarkdownOptions& options) {
  std::string figures;
  for (const FigureReference& figure : options.figures) {
    figures += picture(figure);
  }
  return block_filter_section(certificate) + block_set_section(certificate) +
         (figures.empty() ? "" : "## In simulation\n\n" + figures) + block_coverage();
}

}  // namespace veritrack::certificates

#include "certificates/dft_block/markdown_dft_block.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/dft_block/initial_landing.hpp"
#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

std::string block_filter_section(const Certificate& certificate) {
  const Design& design = certificate.design;
  const BlockTables& tables = block_tables(design);
  std::string text = "## The tracker\n\n";
  text += fmt::format("{}The tracker is `{}`.\n\n", markdown::quotation(design.name, design.source),
                      design.tracker);
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
  const bool is_gaussian = block_tables(certificate.design).assume.gaussian.has_value();
  const theorems::Derivation& found =
      *find_derivation(certificate, is_gaussian ? "lock-in-noise" : "lock-set");
  return "## The set about the exact lock: conditions " + markdown::satisfied(found.verdict) + "\n\n" +
         markdown::conditions_table(found) + "\n" + markdown::values_table(found) + "\n" +
         markdown::notes_list(found) + "\n";
}

/// The set for the most noise that could be proved.
std::string lowest_snr_section(const Certificate& certificate) {
  const theorems::Derivation* found = find_derivation(certificate, "lowest-snr");
  if (found == nullptr) {
    return "";
  }
  return "## The lowest signal-to-noise ratio: conditions " + markdown::satisfied(found->verdict) + "\n\n" +
         found->title + ".\n\n" + markdown::conditions_table(*found) + "\n" + markdown::values_table(*found) +
         "\n" + markdown::notes_list(*found) + "\n";
}

/// The proofs for starts that never find the tone.
std::string false_lock_section(const Certificate& certificate) {
  const auto* below = find_derivation(certificate, "false-lock-below");
  const auto* above = find_derivation(certificate, "false-lock-above");
  if (below == nullptr || above == nullptr) {
    return "";
  }
  std::string text =
      "## False locks: starts that never find the tone\n\nThe filter has other fixed points, about whole "
      "numbers of bins off, with a small estimated amplitude. Each set below is a ball $`|S(s - s_0)| \\le "
      "\\rho`$ of first predictions and covariances $`s`$; centre $`s_0`$, shape $`S`$ and radius $`\\rho`$ "
      "are in `certificate.json`. The sets are small, since errors and covariance have to be bounded "
      "together; "
      "what is drawn into them is more (`veritrack map`).\n\n";
  for (const theorems::Derivation* found : {below, above}) {
    text += fmt::format("### {}: {}\n\n", found->title, markdown::satisfied(found->verdict));
    text += markdown::conditions_table(*found) + "\n";
    if (!found->evidence.empty()) {
      const theorems::Evidence& evidence = found->evidence.front();
      for (const auto& [name, value] : evidence.decimals) {
        text +=
            fmt::format("- {} of the tone: {} {}\n", name, value, name == "offset" ? "bins" : "signal units");
      }
      const auto& centre = evidence.matrices.front().second;
      text += fmt::format(
          "- Centre, rounded: $`\\hat x_1/x_1 = {:.4g}`$, phase error {:.4g} rad, offset error {:.4g} bins; "
          "covariance of these $`[[{:.4g}, {:.4g}, {:.4g}], [{:.4g}, {:.4g}, {:.4g}], [{:.4g}, {:.4g}, "
          "{:.4g}]]`$\n\n",
          1.0 + centre(0, 0), centre(0, 1), centre(0, 2), centre(0, 3), centre(0, 4), centre(0, 5),
          centre(0, 4), centre(0, 6), centre(0, 7), centre(0, 5), centre(0, 7), centre(0, 8));
      text += markdown::values_table(*found) + "\n";
    }
  }
  return text;
}

/// "1234 (61.2 to 66.1 %)"
std::string share_text(const CountedShare& share) {
  return fmt::format("{} ({:.2f} to {:.2f} %)", share.count, 100.0 * share.low, 100.0 * share.high);
}

std::string landing_section(const Certificate& certificate) {
  const std::vector<InitialLanding> landings = simulate_initial_landing(certificate);
  if (landings.empty()) {
    return "";
  }
  std::vector<std::vector<std::string>> rows;
  rows.reserve(landings.size());
  for (const InitialLanding& one : landings) {
    rows.push_back({fmt::format("{:.4g} dB", one.snr_db), share_text(one.near), share_text(one.in_set)});
  }
  return fmt::format(
             "## Where the initialisation lands\n\n*Sampled*, not proved: {} starts each by (4.35) and "
             "(4.36) of "
             "the thesis from the bins of one block (`trackers/dft_block/block_dft.hpp`), seed {}, tones of "
             "the "
             "lowest assumed amplitude, offsets uniform in the assumed band, any phase; with Clopper and "
             "Pearson's "
             "interval at 99 %. In the set are errors only; the covariance has to be as assumed.\n\n",
             landings.front().starts, block_tables(certificate.design).simulate.seed) +
         markdown::table({"SNR of the samples", "within half a bin of the tone", "in the certified set"},
                         rows) +
         "\n";
}

std::string block_coverage(bool is_gaussian) {
  const std::string noise =
      is_gaussian
          ? "white Gaussian noise in the samples, of which the bins see independent parts of the variance "
            "$`\\sigma^2/(2T)`$, as loud as assumed or less, and independent of how the offset moves; "
          : "any noise in the bins up to the assumed length, whatever its distribution; ";
  return "## What this certificate covers, and what it does not\n\n- Covered: every tone whose offset stays "
         "between "
         "the assumed bounds and changes by no more than the assumed slew from one block to the next, and is "
         "constant "
         "within each block, with its amplitude and phase going on from block to block; " +
         noise + "every start within the assumed errors.\n" +
         (is_gaussian
              ? "- *In lock* is a filter whose errors and covariance have not left the certified set; "
                "in the root mean square the blocks after that count as 0.\n"
              : "") +
         "- The statements concern the model (4.9), not the samples. The difference between a real tone's "
         "transform and the model (about the amplitude over $`T`$) " +
         (is_gaussian ? "is not in the assumed noise, and neither is"
                      : "has to be counted as noise, and so has") +
         " the contribution of a frequency that changes within a block.\n- Exact lock is a fixed point for "
         "every "
         "offset: without "
         "noise and slew, errors of the set fall to zero.\n- Not covered: starts outside. From some of them "
         "the filter "
         "never finds the tone, but stays about a number of bins off: `docs/block-tracker.md` of the "
         "program's sources "
         "says how that is seen from outside, and `veritrack track` looks.\n- Exact arithmetic; every "
         "enclosure was "
         "computed with outward-rounded interval arithmetic. The simulation proves nothing.\n\n";
}

}  // namespace

std::vector<const Claim*> dft_block_answers(const Certificate& certificate) {
  std::vector<const Claim*> found;
  for (const char* id : {"dft-block/guarantee", "dft-block/losing-lock", "dft-block/lowest-snr",
                         "dft-block/every-start-locks"}) {
    const auto claim = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                    [id](const Claim& one) { return one.id == id; });
    if (claim != certificate.claims.end()) {
      found.push_back(&*claim);
    }
  }
  return found;
}

std::string dft_block_sections(const Certificate& certificate, const MarkdownOptions& options) {
  std::string figures;
  for (const FigureReference& figure : options.figures) {
    figures += picture(figure);
  }
  return block_filter_section(certificate) + block_set_section(certificate) +
         lowest_snr_section(certificate) + false_lock_section(certificate) +
         (figures.empty() ? "" : "## In simulation\n\n" + figures) + landing_section(certificate) +
         block_coverage(block_tables(certificate.design).assume.gaussian.has_value());
}

}  // namespace veritrack::certificates

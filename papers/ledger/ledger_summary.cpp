#include "papers/ledger/ledger_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "certificates/document/markdown_text.hpp"

namespace veritrack::reports::ledger {

namespace {

using enum theorems::Paper;
using rigor::Verdict;
using theorems::FindingKind;
using theorems::Paper;
using theorems::PaperRole;

using Choice = std::function<bool(const Row& row)>;

std::size_t count(const std::vector<Row>& rows, const Choice& choice) {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), choice));
}

bool is_open(const Row& row) {
  return !row.is_illegible() && !row.stands() && !row.falls();
}

std::string_view words_of(PaperRole role) {
  switch (role) {
    case PaperRole::sentence:
      return "asserted";
    case PaperRole::hypothesis:
      return "assumed, asked of the publication's own designs";
    case PaperRole::repair:
      return "ours, in place of what is printed";
  }
  return "";
}

/// The rows of one paper in one role, by verdict.
std::vector<std::string> count_row(const std::vector<Row>& rows, Paper paper, PaperRole role) {
  const auto of = [&](const Choice& choice) {
    return std::to_string(count(rows, [&](const Row& row) {
      return row.place.paper == paper && row.place.role == role && choice(row);
    }));
  };
  return {std::string(to_string(paper)),
          std::string(words_of(role)),
          of([](const Row&) { return true; }),
          of([](const Row& row) { return row.stands(); }),
          of([](const Row& row) { return row.falls() && row.is_uniform(); }),
          of([](const Row& row) { return !row.is_illegible() && row.is_everywhere(Verdict::undecided); }),
          of([](const Row& row) { return !row.is_uniform(); }),
          of([](const Row& row) { return row.is_illegible(); })};
}

}  // namespace

std::span<const SummaryLine> summary_lines() {
  static const std::vector<SummaryLine> lines{
      {la_scala_1994,
       "La Scala's thesis, chapters 2 and 3: stability, the quadrature tracker",
       "The signal is observable where it has an amplitude; over-design orders the covariances of a common "
       "start; the signs of Table 3.1, with the errata sheet.",
       "The guarantee with numbers: no design satisfies (2.43) of theorem 2.9. The bounds on the covariance "
       "after Deyst and Price; lemma 3.1.",
       "Certified sets for these designs (docs/contraction.md, docs/leak.md); theorem 2.9 repaired "
       "(docs/repaired-theorem.md); bounds for a window (docs/riccati-bounds.md).",
       {"theorem-3.1/rank", "table-3.1/errata/alpha-q1", "table-3.1/errata/beta-q2",
        "table-3.1/errata/alpha-r"},
       {"theorem-2.9/printed/2.43", "theorem-2.9/errata/2.43", "riccati-bounds/naive-matrix",
        "lemma-3.1/exact-to-second-order"}},
      {la_scala_1994,
       "The thesis, chapter 4: the DFT-block tracker",
       "The narrow-band model (4.9) and its derivatives; that the start decides.",
       "That H vanishes at an integer offset but for two elements, on which (4.26) rests; signs and phases "
       "of "
       "(4.5) and (4.6).",
       "A set about exact lock, and false locks, proved for (4.9) (docs/block-tracker.md).",
       {"chapter-4/narrow-band/4.9", "chapter-4/jacobian", "chapter-4/initial-estimate/set-1"},
       {"chapter-4/integer-offset", "chapter-4/transform/printed", "chapter-4/narrow-band/4.6"}},
      {la_scala_1994,
       "The thesis, chapter 5: the self-tuning regulator",
       "The algebra of theorem 5.2; the lower bound of EFRA as a number.",
       "The control may be undefined; EFRA's upper bound, 10.1, and the formula of its lower one; (5.5) "
       "along "
       "the adaptive loop.",
       "EFRA's bounds for every admissible choice, and an output bound from a tracker's certificate "
       "(docs/regulator.md).",
       {"chapter-5/theorem-5.2/lyapunov-function", "chapter-5/efra-lower-bound/corrected",
        "chapter-5/efra-interval/corrected"},
       {"chapter-5/theorem-5.2/control-exists", "chapter-5/efra-upper-bound",
        "chapter-5/regression/printed"}},
      {la_scala_bitmead_1996,
       "La Scala and Bitmead: design of the quadrature tracker",
       "Lemma 1, for given q2; P(k+1|k) is at least Q; a larger R lowers gain and noise.",
       "That the theorem behind lemma 1 admits starts, or predicts Figure 1. R is no choice beside Q: their "
       "ratio counts. The design of Figure 5 is better by its leak.",
       "No leak (proposition-1/if); certified sets (docs/contraction.md).",
       {"paper-1996/lemma-1/maximum", "paper-1996/least-covariance", "paper-1996/r-lowers-gain",
        "paper-1996/r-and-variation"},
       {"paper-1996/lemma-1/admits", "paper-1996/predicted", "paper-1996/r-less-critical",
        "paper-1996/figure-5/over-design"}},
      {bittanti_savaresi_2000,
       "Bittanti and Savaresi: the single-channel tracker",
       "Without leak there is no bias, with one there is; only q/r counts, if P(0) is scaled, too.",
       "The proof, which takes gains and estimate to be constant; that the bias always grows with the "
       "frequency; "
       "F(t) and I3 as printed.",
       "The invariant curve of the steady state (docs/single-channel.md); F at x(t|t) and Q = q I, with "
       "which "
       "the figures come out.",
       {"proposition-1/if", "proposition-1/only-if", "proposition-2/scaled-start"},
       {"proposition-1/constant-sinusoid", "proposition-1/estimate-is-constant",
        "proposition-1/bias-grows/everywhere", "bittanti-savaresi/linearization-point",
        "bittanti-savaresi/I3"}},
      {praly_marconi_isidori,
       "Praly, Marconi and Isidori: the KKL observer",
       "T is injective on compact sets and not on O; ell is positive, and the observer has an inverse, for "
       "four "
       "filters or more; the errors of section V.",
       "ell = 5 of section V; the constant d, which lacks a factor; two dimensions.",
       "The proved ell (kkl-ell), and bounds on the errors under a disturbance (docs/kkl-observer.md).",
       {"kkl-paper/injectivity", "kkl-paper/not-lipschitz", "kkl-paper/ell-positive",
        "kkl-paper/more-filters", "kkl-paper/section-v-errors/100"},
       {"kkl-paper/section-v-ell", "kkl-paper/injectivity-constant", "kkl-paper/dimensions"}},
      {zarchan_slides,
       "Zarchan's slides: four filters",
       "The derived matrices; that a filter of (x, x', omega) finds the magnitude only.",
       "Two entries of the listings, without effect.",
       "Symmetries as identities; without process noise no filter has a steady state.",
       {"zarchan/matrices/phase-noise", "zarchan/symmetry/oscillator-sign", "zarchan/steady-state/phase"},
       {"zarchan/listings/second", "zarchan/listings/fourth"}},
      {kang_song_lee,
       "Kang, Song and Lee, first page",
       "The class of these filters, for the windows tried.",
       "Nothing.",
       "",
       {"sam/class"},
       {}},
      {guan_chen_ueta,
       "Guan, Chen and Ueta, first page",
       "The pendulum of Figure 1 is chaotic; the control captures it.",
       "Nothing.",
       "",
       {"pendulum/chaos", "pendulum/capture"},
       {}},
      {cited,
       "Theorems by others, for the quadrature tracker",
       "Few of their hypotheses.",
       "Hypotheses over all states, and starts and noise that their constants allow; (2.16) depends on "
       "units.",
       "song-grizzle/local and reif-1999/two-step (docs/published-results.md).",
       {"reif-1999/excitation"},
       {"song-grizzle/gramian", "picard/injective", "reif-1999/noise", "baras-bensoussan-james/units"}}};
  return lines;
}

std::string summary(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const SummaryLine& line : summary_lines()) {
    lines.push_back({std::string(line.publication), std::string(line.stands), std::string(line.falls),
                     line.repair.empty() ? "–" : std::string(line.repair)});
  }
  const auto asserted = [&](bool (Row::*is)() const) {
    return count(rows, [&](const Row& row) { return row.place.role == PaperRole::sentence && (row.*is)(); });
  };
  return fmt::format(
      "**Of the sentences that the publications assert, {} are PROVED and {} REFUTED; {} claims are open.** "
      "What "
      "engineers take from these publications survives. What does not is mostly a constant, a sign or a "
      "missing "
      "assumption, and one thing that matters: a guarantee with numbers, in place of which stand the "
      "certificates of this program.\n\n{}\n",
      asserted(&Row::stands), asserted(&Row::falls), count(rows, is_open),
      certificates::markdown::table({"Publication", "What stands", "What falls", "In its place"}, lines));
}

std::string count_sentences(const std::vector<Row>& rows) {
  const auto in_role = [&](PaperRole role, const Choice& choice) {
    return count(rows, [&](const Row& row) { return row.place.role == role && choice(row); });
  };
  const auto of_kind = [&](FindingKind kind) {
    return count(rows, [&](const Row& row) { return row.finding != nullptr && row.finding->kind == kind; });
  };
  const auto all = [](const Row&) { return true; };
  const auto stands = [](const Row& row) { return row.stands(); };
  const auto falls = [](const Row& row) { return row.falls(); };
  return fmt::format(
      "{} claims of the publications are decided here, {} more are open, and {} cannot be read in the scan. "
      "The "
      "publications assert {} of them: {} are PROVED for every design, {} are REFUTED for at least one. The "
      "other {} are hypotheses of theorems, asked of the designs that the publications print: {} are PROVED "
      "for "
      "every design, {} are REFUTED for at least one. Of the sentences that are REFUTED {} are false as "
      "stated, "
      "{} need an assumption that is not stated, {} are slips without consequence; the others fail for "
      "numbers "
      "that are printed. {} sentences of ours stand beside those that they repair. REFUTED is about a "
      "sentence "
      "as it is printed, and mostly about its constants.\n\n",
      count(rows,
            [](const Row& row) {
              return row.place.role != PaperRole::repair && (row.stands() || row.falls());
            }),
      count(rows, is_open), of_kind(FindingKind::illegible), in_role(PaperRole::sentence, all),
      in_role(PaperRole::sentence, stands), in_role(PaperRole::sentence, falls),
      in_role(PaperRole::hypothesis, all), in_role(PaperRole::hypothesis, stands),
      in_role(PaperRole::hypothesis, falls), of_kind(FindingKind::false_as_stated),
      of_kind(FindingKind::needs_unstated_assumption), of_kind(FindingKind::slip_without_consequence),
      in_role(PaperRole::repair, all));
}

std::string counts_table(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const Paper paper : theorems::kAllPapers) {
    for (const PaperRole role : {PaperRole::sentence, PaperRole::hypothesis, PaperRole::repair}) {
      std::vector<std::string> line = count_row(rows, paper, role);
      if (line[2] != "0") {
        lines.push_back(std::move(line));
      }
    }
  }
  return certificates::markdown::table({"Publication", "What is", "Claims", "PROVED", "REFUTED", "UNDECIDED",
                                        "depends on the design", "illegible"},
                                       lines);
}

}  // namespace veritrack::reports::ledger

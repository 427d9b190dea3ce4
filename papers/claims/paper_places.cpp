#include "papers/claims/paper_places.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

#include "analysis/statements/paper_findings.hpp"

namespace veritrack::theorems {

namespace {

using enum Paper;
using enum PaperRole;

/// All claims whose ids begin so.
struct Family {
  std::string_view begin;
  Paper paper;
  PaperRole role;
  std::string_view place;
  std::string_view repair = {};
};

constexpr std::string_view kContraction = "the contraction certificate (docs/contraction.md, docs/leak.md)";
constexpr std::string_view kRiccati = "sound bounds for a window (docs/riccati-bounds.md)";

constexpr std::string_view kCurve = "the invariant curve of the steady state (docs/single-channel.md)";

/// The first that fits counts, so that the longer of two stands first.
constexpr std::array kFamilies{
    Family{"theorem-2.9/printed/", la_scala_1994, hypothesis, "thesis, theorem 2.9", kContraction},
    Family{"theorem-2.9/errata/", la_scala_1994, hypothesis, "thesis, theorem 2.9 with the errata sheet",
           kContraction},
    Family{"theorem-2.9/lemma-3.1", la_scala_1994, sentence, "thesis, lemma 3.1"},
    Family{"theorem-2.9/s/", la_scala_1994, sentence, "thesis, section 2.4.3, s", kRiccati},
    Family{"theorem-2.9/", la_scala_1994, sentence, "thesis, section 3.5",
           "theorem-2.9/repaired (docs/repaired-theorem.md)"},
    Family{"riccati-bounds/", la_scala_1994, sentence, "thesis, section 2.4.3, p and q", kRiccati},
    Family{"total-stability/corollary/", la_scala_1994, hypothesis, "thesis, corollary 2.6.1", kContraction},
    Family{"total-stability/", la_scala_1994, hypothesis, "thesis, theorem 2.6", kContraction},
    Family{"theorem-2.7/printed/", la_scala_1994, hypothesis, "thesis, theorem 2.7", "theorem-2.7/corrected"},
    Family{"theorem-3.1/to-the-letter/", la_scala_1994, sentence, "thesis, section 3.2.1", "theorem-3.1"},
    Family{"theorem-3.1/printed-gram", la_scala_1994, sentence, "thesis, section 3.2.1, J'J"},
    Family{"theorem-3.1/", la_scala_1994, sentence, "thesis, theorem 3.1"},
    Family{"theorem-3.2/any-start/", la_scala_1994, sentence, "thesis, theorem 3.2", "theorem-3.2"},
    Family{"theorem-3.2/", la_scala_1994, sentence, "thesis, theorem 3.2, at |z| = 1"},
    Family{"lemma-3.1/", la_scala_1994, sentence, "thesis, lemma 3.1"},
    Family{"table-3.1/printed/", la_scala_1994, sentence, "thesis, Table 3.1", "table-3.1/errata"},
    Family{"table-3.1/errata/", la_scala_1994, sentence, "thesis, errata sheet to Table 3.1"},
    Family{"chapter-2/section-2.2.4/", la_scala_1994, sentence, "thesis, section 2.2.4"},
    Family{"chapter-2/theorem-2.4/", la_scala_1994, sentence, "thesis, theorem 2.4"},
    Family{"chapter-2/theorem-2.6/", la_scala_1994, sentence, "thesis, theorem 2.6"},
    Family{"chapter-2/corollary-2.6.1", la_scala_1994, sentence, "thesis, corollary 2.6.1"},
    Family{"chapter-2/theorem-2.8/", la_scala_1994, sentence, "thesis, theorem 2.8",
           "theorem-2.9/repaired (docs/repaired-theorem.md)"},
    Family{"chapter-2/lemma-2.1", la_scala_1994, sentence, "thesis, lemma 2.1"},
    Family{"chapter-2/lemma-2.2", la_scala_1994, sentence, "thesis, lemma 2.2"},
    Family{"chapter-2/lemma-2.3/", la_scala_1994, sentence, "thesis, lemma 2.3"},
    Family{"chapter-2/lemma-2.4/", la_scala_1994, sentence, "thesis, lemma 2.4"},
    Family{"chapter-2/lemma-2.5/", la_scala_1994, sentence, "thesis, lemma 2.5"},
    Family{"chapter-3/table-3.1-footnote/", la_scala_1994, sentence, "thesis, Table 3.1, its footnote"},
    Family{"chapter-3/same-slew", la_scala_1994, sentence, "thesis, section 3.7"},
    Family{"chapter-3/a-tenth", la_scala_1994, sentence, "thesis, Table 3.2"},
    Family{"chapter-3/variance-by-parameters", la_scala_1994, sentence, "thesis, (3.12)"},
    Family{"chapter-3/frequency-variance", la_scala_1994, sentence, "thesis, (3.11) and (3.12)"},
    Family{"chapter-4/transform/", la_scala_1994, sentence, "thesis, (4.5)"},
    Family{"chapter-4/narrow-band/4.9", la_scala_1994, sentence, "thesis, (4.9)"},
    Family{"chapter-4/narrow-band/", la_scala_1994, sentence, "thesis, (4.6)"},
    Family{"chapter-4/jacobian", la_scala_1994, sentence, "thesis, (4.19) to (4.24)"},
    Family{"chapter-4/filter-bank/", la_scala_1994, sentence, "thesis, section 4.2, the filter bank"},
    Family{"chapter-4/second-term", la_scala_1994, sentence, "thesis, section 4.2, (4.5) to (4.6)"},
    Family{"chapter-4/spectral-density/", la_scala_1994, sentence, "thesis, (4.10)"},
    Family{"chapter-4/noise-in-a-bin", la_scala_1994, sentence, "thesis, (4.32)"},
    Family{"chapter-4/zero-rows/", la_scala_1994, sentence, "thesis, sections 4.2.2 and 4.3"},
    Family{"chapter-4/square-root/", la_scala_1994, sentence, "thesis, section 4.2.1, (4.12)"},
    Family{"chapter-4/gramian/rank", la_scala_1994, sentence, "thesis, section 4.3.1, after (4.26)"},
    Family{"chapter-4/gramian/", la_scala_1994, sentence, "thesis, (4.26)", "chapter-4/gramian/corrected"},
    Family{"chapter-4/observability/", la_scala_1994, sentence, "thesis, section 4.3.1"},
    Family{"chapter-4/ambiguity/", la_scala_1994, sentence, "thesis, section 4.3.1"},
    Family{"chapter-4/controllability/", la_scala_1994, sentence, "thesis, section 4.4.2"},
    Family{"chapter-4/table-4.1/", la_scala_1994, sentence, "thesis, section 4.5.1, Table 4.1"},
    Family{"chapter-4/table-4.2/", la_scala_1994, sentence, "thesis, section 4.5.3, Table 4.2"},
    Family{"chapter-4/block-length", la_scala_1994, sentence, "thesis, section 4.4.4"},
    Family{"chapter-4/estimator/unbiased-middle", la_scala_1994, repair, "thesis, section 4.5.2, (4.35)"},
    Family{"chapter-4/estimator/unbiased-inside", la_scala_1994, repair, "thesis, section 4.5.2, (4.35)"},
    Family{"chapter-4/estimator/unbiased", la_scala_1994, sentence, "thesis, section 4.5.2, (4.35)",
           "chapter-4/estimator/unbiased-inside"},
    Family{"chapter-4/estimator/efficient-samples", la_scala_1994, sentence, "thesis, section 4.5.2, (4.35)",
           "chapter-4/estimator/efficient-samples-corrected"},
    Family{"chapter-4/estimator/variance", la_scala_1994, sentence, "thesis, section 4.5.3"},
    Family{"chapter-4/estimator/", la_scala_1994, sentence, "thesis, section 4.5.2, (4.35) and (4.36)"},
    Family{"chapter-4/initial-estimate/", la_scala_1994, sentence, "thesis, section 4.5.2"},
    Family{"chapter-4/", la_scala_1994, sentence, "thesis, section 4.3"},
    Family{"chapter-5/disturbance/", la_scala_1994, sentence, "thesis, section 5.2.2"},
    Family{"chapter-5/initial-conditions", la_scala_1994, sentence, "thesis, section 5.2.4"},
    Family{"chapter-5/expansion/", la_scala_1994, sentence, "thesis, section 5.2.4, A and B"},
    Family{"chapter-5/ideal-controller/loop/stable", la_scala_1994, sentence, "thesis, section 5.4"},
    Family{"chapter-5/ideal-controller/loop/", la_scala_1994, repair, "thesis, section 5.4"},
    Family{"chapter-5/ideal-controller/example", la_scala_1994, sentence, "thesis, section 5.4, K"},
    Family{"chapter-5/ideal-controller/", la_scala_1994, sentence, "thesis, section 5.2.4, K"},
    Family{"chapter-5/control-law/", la_scala_1994, sentence, "thesis, section 5.2.5, property 3"},
    Family{"chapter-5/lemma-5.3/", la_scala_1994, sentence, "thesis, lemma 5.3"},
    Family{"chapter-5/theorem-5.2/5.25", la_scala_1994, sentence, "thesis, (5.25)"},
    Family{"chapter-5/theorem-5.2/5.26", la_scala_1994, sentence, "thesis, (5.26)"},
    Family{"chapter-5/corollary-5.2.1/5.27", la_scala_1994, sentence, "thesis, (5.27)"},
    Family{"chapter-5/corollary-5.2.1/limit", la_scala_1994, sentence, "thesis, section 5.3.2, Consistency"},
    Family{"chapter-5/convergence-rate", la_scala_1994, sentence, "thesis, section 5.3.2, Convergence Rate"},
    Family{"chapter-5/internal-model/", la_scala_1994, sentence, "thesis, section 5.3.2, Consistency"},
    Family{"chapter-5/limits/table-5.1/gain-margin", la_scala_1994, repair, "thesis, Table 5.1"},
    Family{"chapter-5/limits/table-5.1/peak-sensitivity", la_scala_1994, repair, "thesis, Table 5.1"},
    Family{"chapter-5/limits/table-5.2/gain-margin", la_scala_1994, repair, "thesis, Table 5.2"},
    Family{"chapter-5/limits/table-5.2/peak-sensitivity", la_scala_1994, repair, "thesis, Table 5.2"},
    Family{"chapter-5/limits/table-5.1/", la_scala_1994, sentence, "thesis, section 5.4.1, Table 5.1"},
    Family{"chapter-5/limits/table-5.2/", la_scala_1994, sentence, "thesis, section 5.4.2, Table 5.2"},
    Family{"chapter-5/limits/match/table-5.1", la_scala_1994, sentence,
           "thesis, section 5.4.1, Figures 5.6 and 5.7", "chapter-5/internal-model/corrected"},
    Family{"chapter-5/limits/match/table-5.2", la_scala_1994, sentence,
           "thesis, section 5.4.2, Figures 5.10 and 5.11", "chapter-5/internal-model/corrected"},
    Family{"chapter-5/limits/", la_scala_1994, sentence, "thesis, section 5.3.2, Consistency"},
    Family{"chapter-5/example", la_scala_1994, sentence, "thesis, section 5.4, the examples"},
    Family{"chapter-5/theorem-5.2/5.23", la_scala_1994, sentence, "thesis, (5.23)"},
    Family{"chapter-5/theorem-5.2/5.24", la_scala_1994, sentence, "thesis, (5.24)"},
    Family{"chapter-5/theorem-5.2/", la_scala_1994, sentence, "thesis, theorem 5.2, its proof"},
    Family{"chapter-5/corollary-5.2.1/", la_scala_1994, sentence, "thesis, corollary 5.2.1, its proof"},
    Family{"chapter-5/lemma-5.2", la_scala_1994, sentence, "thesis, lemma 5.2"},
    Family{"chapter-5/regression/", la_scala_1994, sentence, "thesis, (5.5)"},
    Family{"chapter-5/monitoring/", la_scala_1994, sentence, "thesis, section 5.2.5",
           "rbar lambda_max(P) <= Lambda"},
    Family{"chapter-5/", la_scala_1994, sentence, "thesis, section 5.4, EFRA"},
    Family{"chapter-6/", la_scala_1994, sentence, "thesis, section 6.2"},
    Family{"paper-1996/aliasing", la_scala_bitmead_1996, sentence, "1996 paper, section II"},
    Family{"paper-1996/locally-observable/", la_scala_bitmead_1996, sentence, "1996 paper, section II"},
    Family{"paper-1996/lemma-1/admits", la_scala_bitmead_1996, sentence, "1996 paper, lemma 1", kContraction},
    Family{"paper-1996/lemma-1/", la_scala_bitmead_1996, sentence, "1996 paper, lemma 1"},
    Family{"paper-1996/predicted", la_scala_bitmead_1996, sentence, "1996 paper, section V", kContraction},
    Family{"paper-1996/over-design/", la_scala_bitmead_1996, sentence, "1996 paper, section IV"},
    Family{"paper-1996/under-", la_scala_bitmead_1996, sentence, "1996 paper, section IV"},
    Family{"paper-1996/least-covariance", la_scala_bitmead_1996, sentence, "1996 paper, section IV.A"},
    Family{"paper-1996/gramian/", la_scala_bitmead_1996, sentence, "1996 paper, section IV.A"},
    Family{"paper-1996/small-q", la_scala_bitmead_1996, sentence, "1996 paper, section IV.A"},
    Family{"paper-1996/figure-", la_scala_bitmead_1996, sentence, "1996 paper, section V",
           "no leak (proposition-1/if; docs/leak.md)"},
    Family{"paper-1996/snr", la_scala_bitmead_1996, sentence, "1996 paper, section V"},
    Family{"paper-1996/slew-of-model", la_scala_bitmead_1996, sentence, "1996 paper, section V"},
    Family{"paper-1996/r-", la_scala_bitmead_1996, sentence, "1996 paper, section IV.C"},
    Family{"paper-1996/", la_scala_bitmead_1996, sentence, "1996 paper, section IV.B"},
    Family{"zarchan/symmetry/oscillator-sign", zarchan_slides, sentence, "slides, alternate filter"},
    Family{"zarchan/symmetry/oscillator", zarchan_slides, repair, "slides, alternate filter"},
    Family{"zarchan/symmetry/square", zarchan_slides, repair, "slides, another filter (z = ω²)"},
    Family{"zarchan/symmetry/phase", zarchan_slides, repair, "slides, initial formulation"},
    Family{"zarchan/symmetry/known-amplitude", zarchan_slides, repair, "slides, two-state filter"},
    Family{"zarchan/horizon/", zarchan_slides, sentence, "slides, two-state filter"},
    Family{"zarchan/matrices/", zarchan_slides, sentence, "slides, the derivations"},
    Family{"zarchan/listings/", zarchan_slides, sentence, "slides, the listings"},
    Family{"zarchan/steady-state/", zarchan_slides, repair, "slides, all four filters"},
    Family{"sam/", kang_song_lee, sentence, "page, abstract"},
    Family{"pendulum/chaos", guan_chen_ueta, sentence, "page, Figure 1"},
    Family{"pendulum/", guan_chen_ueta, sentence, "page, section II"},
    Family{"baras-bensoussan-james/units", cited, sentence, "thesis, theorem 2.2",
           "a condition without units (docs/published-results.md, section 4)"},
    Family{"baras-bensoussan-james/", cited, hypothesis, "Baras, Bensoussan, James 1988; thesis, theorem 2.2",
           kContraction},
    Family{"picard/", cited, hypothesis, "Picard 1991; thesis, theorem 2.3", kContraction},
    Family{"song-grizzle/", cited, hypothesis, "Song, Grizzle 1993; thesis, theorem 2.5",
           "song-grizzle/local"},
    Family{"reif-1999/", cited, hypothesis, "Reif, Guenther, Yaz, Unbehauen 1999", "reif-1999/two-step"},
    Family{"proposition-1/denominator", bittanti_savaresi_2000, sentence, "paper, (4) and (6)",
           "proposition-1/denominator-corrected"},
    Family{"proposition-1/numerator", bittanti_savaresi_2000, sentence, "paper, (4)"},
    Family{"proposition-1/response", bittanti_savaresi_2000, sentence, "paper, (6)",
           "proposition-1/response-corrected"},
    Family{"proposition-1/zeros/", bittanti_savaresi_2000, sentence, "paper, after (7)"},
    Family{"proposition-1/constant-sinusoid", bittanti_savaresi_2000, sentence, "paper, (7)", kCurve},
    Family{"proposition-1/varying-gain", bittanti_savaresi_2000, sentence, "paper, (4) to (7)", kCurve},
    Family{"proposition-1/estimate-is-constant", bittanti_savaresi_2000, sentence, "paper, proposition 1",
           kCurve},
    Family{"proposition-1/bias-grows/", bittanti_savaresi_2000, sentence, "paper, section II", kCurve},
    Family{"proposition-1/indistinguishable", bittanti_savaresi_2000, sentence, "paper, section II"},
    Family{"bittanti-savaresi/linearization-point", bittanti_savaresi_2000, sentence, "paper, below (2b)",
           "F at x(t|t), from which the state is predicted"},
    Family{"bittanti-savaresi/I3", bittanti_savaresi_2000, sentence, "paper, below (2b)",
           "Q = q I, with which the figures come out"},
    Family{"example-2/", bittanti_savaresi_2000, sentence, "paper, Example 2"},
    Family{"proposition-1/", bittanti_savaresi_2000, sentence, "paper, proposition 1"},
    Family{"proposition-2/", bittanti_savaresi_2000, sentence, "paper, proposition 2",
           "proposition-2/scaled-start"},
    Family{"kkl-paper/invariance", praly_marconi_isidori, sentence, "paper, (3) and (6)"},
    Family{"kkl-paper/determinant", praly_marconi_isidori, sentence, "paper, section IV, det(L'L)"},
    Family{"kkl-paper/null-space", praly_marconi_isidori, sentence, "paper, section IV, M"},
    Family{"kkl-paper/injectivity-constant", praly_marconi_isidori, sentence, "paper, section IV, d",
           "kkl-paper/injectivity, with d times sqrt(2 (1 + x3)^2 + 2)/(1 + x3)"},
    Family{"kkl-paper/injectivity", praly_marconi_isidori, sentence,
           "paper, section IV; with a d that has the factor missing in print"},
    Family{"kkl-paper/not-lipschitz", praly_marconi_isidori, sentence, "paper, section IV"},
    Family{"kkl-paper/factor-two", praly_marconi_isidori, sentence, "paper, (9), (10) and (14)"},
    Family{"kkl-paper/mu-vanishes", praly_marconi_isidori, sentence, "paper, (9) and (10)", "kkl-ell"},
    Family{"kkl-paper/left-inverse", praly_marconi_isidori, sentence, "paper, (15)", "kkl-ell"},
    Family{"kkl-paper/vandermonde-step", praly_marconi_isidori, sentence, "paper, (16) and (17)"},
    Family{"kkl-paper/ell-positive", praly_marconi_isidori, sentence, "paper, (10) and (17)"},
    Family{"kkl-paper/more-filters", praly_marconi_isidori, sentence, "paper, section VI and (15)"},
    Family{"kkl-paper/bandwidth", praly_marconi_isidori, sentence, "paper, section V"},
    Family{"kkl-paper/section-v-errors/", praly_marconi_isidori, sentence, "paper, section V"},
    Family{"kkl-paper/section-v-ell", praly_marconi_isidori, sentence, "paper, section V", "kkl-ell"},
    Family{"kkl-paper/", praly_marconi_isidori, sentence, "paper, section IV"}};

/// Theorems of ours, under ids that begin as those of the publication's do.
constexpr std::array<std::string_view, 4> kOurRepairs{"theorem-2.9/repaired/", "song-grizzle/local/",
                                                      "theorem-2.7/corrected/", "reif-1999/two-step/"};

const Family* family_of(std::string_view claim) {
  const auto begins = [&](std::string_view begin) { return claim.starts_with(begin); };
  // "<derivation>/conditions" is all conditions together.
  if (claim.ends_with("/conditions") || std::any_of(kOurRepairs.begin(), kOurRepairs.end(), begins)) {
    return nullptr;
  }
  const auto* const found = std::find_if(kFamilies.begin(), kFamilies.end(),
                                         [&](const Family& family) { return begins(family.begin); });
  return found == kFamilies.end() ? nullptr : found;
}

/// ", as printed" or ", with the errata sheet" for one of two readings of a sentence.
std::string_view reading(std::string_view claim) {
  return claim.ends_with("/printed")  ? ", as printed"
         : claim.ends_with("/errata") ? ", with the errata sheet"
                                      : "";
}

/// Does the id name what a sentence should say?
bool is_repair(std::string_view claim) {
  return claim.ends_with("repaired") || claim.ends_with("corrected");
}

/// ", (2.43)" for a condition that is named by its equation number; empty for one with a name of ours.
std::string equation(std::string_view claim) {
  const std::string_view last = claim.substr(claim.rfind('/') + 1);
  const bool is_number = std::all_of(last.begin(), last.end(), [](unsigned char letter) {
    return std::isdigit(letter) != 0 || letter == '.';
  });
  return is_number ? ", (" + std::string(last) + ")" : "";
}

}  // namespace

std::string_view to_string(Paper paper) {
  switch (paper) {
    case la_scala_1994:
      return "B. F. La Scala, PhD thesis, 1994, with its errata sheet";
    case la_scala_bitmead_1996:
      return "B. F. La Scala and R. R. Bitmead, 1996";
    case bittanti_savaresi_2000:
      return "S. Bittanti and S. M. Savaresi, 2000";
    case praly_marconi_isidori:
      return "L. Praly, L. Marconi and A. Isidori";
    case zarchan_slides:
      return "P. Zarchan, slides on tracking a sine wave";
    case kang_song_lee:
      return "D. H. Kang, J. Song and Y. H. Lee, 1996, first page";
    case guan_chen_ueta:
      return "Z.-H. Guan, G. Chen and T. Ueta, 2000, first page";
    case cited:
      return "Theorems by others, applied to the quadrature tracker";
  }
  return "";
}

bool is_published(std::string_view claim) {
  return family_of(claim) != nullptr;
}

PaperPlace paper_place(std::string_view claim) {
  const Family* family = family_of(claim);
  if (family == nullptr) {
    throw std::out_of_range(std::string(claim) + " is not a claim about a publication");
  }
  const PaperFinding* finding = find_paper_finding(claim);
  std::string place = finding != nullptr ? std::string(finding->place) : std::string(family->place);
  if (family->role == hypothesis) {
    place += equation(claim);
  }
  place += reading(claim);
  return {family->paper, is_repair(claim) ? repair : family->role, std::move(place), family->repair};
}

}  // namespace veritrack::theorems

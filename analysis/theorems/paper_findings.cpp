#include "analysis/theorems/paper_findings.hpp"

#include <algorithm>
#include <cctype>

namespace veritrack::theorems {

namespace {

using rigor::Verdict;
using enum FindingKind;

/// "False as stated (thesis, (2.33)): " before the reason, when the claim is in the ledger and REFUTED. What
/// the scan does not show is neither proved nor refuted: the verdict was one on our reading of it.
void cite(std::string_view claim, Verdict& verdict, std::string& reason) {
  const PaperFinding* finding = find_paper_finding(claim);
  if (finding != nullptr && finding->kind == illegible) {
    const std::string reading = verdict == Verdict::refuted  ? "as we read it, it would be false: "
                                : verdict == Verdict::proved ? "as we read it, it would be true: "
                                                             : "";
    reason = "Illegible in the scan (" + std::string(finding->place) + "): " + reading + reason;
    verdict = Verdict::undecided;
    return;
  }
  if (finding == nullptr || verdict != Verdict::refuted) {
    return;
  }
  std::string words(to_string(finding->kind));
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  reason = words + " (" + std::string(finding->place) + "): " + reason;
}

}  // namespace

std::string_view to_string(FindingKind kind) {
  switch (kind) {
    case false_as_stated:
      return "false as stated";
    case slip_without_consequence:
      return "slip without consequence";
    case needs_unstated_assumption:
      return "needs an assumption that is not stated";
    case illegible:
      return "illegible";
  }
  return "";
}

const std::vector<PaperFinding>& paper_findings() {
  static const std::vector<PaperFinding> ledger{
      // La Scala 1994.
      {"baras-bensoussan-james/units", false_as_stated, "thesis, theorem 2.2, (2.16)"},
      {"chapter-2/theorem-2.4/inverse-derivative", needs_unstated_assumption,
       "thesis, the note before theorem 2.4; true on a compact set of states"},
      {"chapter-2/theorem-2.6/chain", slip_without_consequence, "thesis, theorem 2.6"},
      {"chapter-2/theorem-2.8/start", needs_unstated_assumption, "thesis, theorem 2.8, P(0|0)"},
      {"chapter-2/lemma-2.3/transition-matrix", slip_without_consequence, "thesis, lemma 2.3"},
      {"chapter-2/lemma-2.4/size", false_as_stated, "thesis, lemma 2.4, the first entry of (2.40)"},
      {"chapter-2/lemma-2.5/covariance", slip_without_consequence, "thesis, proof of lemma 2.5, a sign"},
      {"theorem-2.9/final-bound-sum", slip_without_consequence, "thesis, theorem 2.7, the bound at k = 0"},
      {"theorem-2.9/zeta", false_as_stated, "thesis, theorem 2.7 and lemma 2.5, zeta"},
      {"theorem-2.9/past-errors", false_as_stated,
       "thesis, (2.34), as used in theorem 2.7, lemmas 2.3 and 2.5"},
      {"theorem-2.9/remainder-constant", false_as_stated, "thesis, section 2.4.3, rho_4 in (2.33)"},
      {"theorem-2.9/remainder-sign", slip_without_consequence, "thesis, theorem 2.9, the sign of kappa_f"},
      {"theorem-2.9/decomposition", false_as_stated, "thesis, proof of theorem 2.8, B(k)"},
      {"theorem-2.9/bounds-from-the-start", needs_unstated_assumption,
       "thesis, theorem 2.8, the bounds on P(k|k) at k = 0"},
      {"theorem-2.9/decrease-factor", slip_without_consequence,
       "thesis, proof of theorem 2.8; (2.36) has the right factor"},
      {"theorem-2.9/s", false_as_stated, "thesis, section 2.4.3, s"},
      {"theorem-2.9/linearised-rate", false_as_stated,
       "thesis, lemma 2.3, as used in the proof of theorem 2.9"},
      {"theorem-2.9/eta-slope", slip_without_consequence,
       "thesis, lemma 2.4, (2.40); the proof of theorem 2.7 needs eta only"},
      {"theorem-2.9/eta-size", false_as_stated, "thesis, lemma 2.4, (2.40), as used in theorem 2.7"},
      {"theorem-2.9/final-bound", slip_without_consequence, "thesis, theorem 2.9, R_x in place of r_x"},
      {"theorem-2.9/radius-order", needs_unstated_assumption, "thesis, proof of theorem 2.9"},
      {"theorem-2.9/2.44-follows", needs_unstated_assumption,
       "thesis, the note that ends the proof of theorem 2.9"},
      {"theorem-2.9/lemma-3.1", false_as_stated, "thesis, lemma 3.1"},
      {"theorem-2.9/gramian-eigenvalue", false_as_stated, "thesis, section 3.5, w_3 without (1 - epsilon)^2"},
      {"theorem-2.9/gramian-time-index", slip_without_consequence, "thesis, section 3.5, w_3 at (k|k)"},
      {"theorem-2.9/w_3-range", false_as_stated, "thesis, section 3.5; errata sheet to page 67"},
      {"theorem-2.9/b_1", false_as_stated, "thesis, section 3.5; errata sheet to page 68"},
      {"theorem-2.9/b_2", false_as_stated, "thesis, section 3.5; errata sheet to page 68"},
      {"theorem-2.9/rho_1", false_as_stated, "thesis, section 3.5"},
      {"theorem-2.9/rho_2", false_as_stated, "thesis, section 3.5"},
      {"theorem-2.9/rho_3", false_as_stated, "thesis, section 3.5"},
      {"riccati-bounds/naive-matrix", false_as_stated, "thesis, section 2.4.3, after Deyst and Price"},
      {"riccati-bounds/naive-number", false_as_stated, "thesis, section 2.4.3, after Deyst and Price"},
      {"riccati-bounds/p-printed", false_as_stated, "thesis, section 2.4.3, p"},
      {"theorem-3.1/to-the-letter/rank-everywhere", needs_unstated_assumption,
       "thesis, section 3.2.1; it takes (x1, x2) other than 0"},
      {"theorem-3.1/to-the-letter/gram-entry", illegible,
       "thesis, section 3.2.1; the parentheses of (1 - epsilon) are missing in print, or lost in the scan"},
      {"theorem-3.1/to-the-letter/definition-3.1", slip_without_consequence,
       "thesis, definition 3.1; some k is meant"},
      {"theorem-3.2/any-start/any-start", needs_unstated_assumption, "thesis, theorem 3.2"},
      {"lemma-3.1/exact-to-second-order", false_as_stated, "thesis, lemma 3.1"},
      {"lemma-3.1/under-estimate", false_as_stated, "thesis, section 3.4.2"},
      {"table-3.1/printed/alpha-r", slip_without_consequence,
       "thesis, Table 3.1; corrected by the errata sheet to page 69"},
      {"chapter-4/transform", slip_without_consequence,
       "thesis, (4.5), the phase of the second term, which is O(1/T)"},
      {"chapter-4/narrow-band/4.6", slip_without_consequence, "thesis, (4.6); (4.9) has the right sign"},
      {"chapter-4/integer-offset", false_as_stated, "thesis, section 4.3, on which (4.26) rests"},
      {"chapter-4/larger-L", needs_unstated_assumption,
       "thesis, section 4.4.3; it is so of the mean over the bins"},
      {"chapter-4/filter-bank", slip_without_consequence,
       "thesis, section 4.2, the taps of the filter bank, which are those of the conjugate"},
      {"chapter-4/spectral-density", slip_without_consequence,
       "thesis, (4.10); the usual definition is meant and used"},
      {"chapter-4/zero-rows", slip_without_consequence,
       "thesis, sections 4.2.2 and 4.3, numbers of bins for numbers of rows"},
      {"chapter-4/square-root/root", slip_without_consequence,
       "thesis, section 4.2.1, when read of x1; of the amplitude it is right"},
      {"chapter-4/gramian/as-printed", slip_without_consequence, "thesis, (4.26); its rank is as said"},
      {"chapter-4/gramian/from-zeros", slip_without_consequence,
       "thesis, (4.26), two powers of pi; its rank is as said"},
      {"chapter-4/observability/zero-state", needs_unstated_assumption,
       "thesis, section 4.3.1; the criterion is that of linear systems"},
      {"chapter-4/ambiguity", slip_without_consequence,
       "thesis, section 4.3.1; true of the samples, not of the approximation (4.9)"},
      {"chapter-4/controllability", slip_without_consequence,
       "thesis, section 4.4.2; (4.34) is right, and not needed for that"},
      {"chapter-4/table-4.1/snr", needs_unstated_assumption,
       "thesis, Table 4.1; the amplitude squared is meant, not the mean power"},
      {"chapter-4/estimator/unbiased", needs_unstated_assumption,
       "thesis, section 4.5.2; offsets inside the range, to first order in the noise"},
      {"chapter-4/estimator/efficient-samples", needs_unstated_assumption,
       "thesis, section 4.5.2; of the bins, or L large"},
      {"chapter-5/efra-upper-bound", slip_without_consequence, "thesis, section 5.4, the bound on P"},
      {"chapter-5/efra-lower-bound", slip_without_consequence,
       "thesis, section 5.4, the formula; the printed number is right"},
      {"chapter-5/efra-lower-bound-holds", slip_without_consequence,
       "thesis, section 5.4, the formula; the printed number is right"},
      {"chapter-5/corollary-5.2.1/step", slip_without_consequence,
       "thesis, corollary 5.2.1; the factor Lambda is missing"},
      {"chapter-5/regression", slip_without_consequence, "thesis, (5.5) and (5.7)"},
      {"chapter-5/monitoring/trace", needs_unstated_assumption, "thesis, section 5.2.5, the bound on rbar"},
      {"chapter-5/monitoring/condition-number", slip_without_consequence,
       "thesis, section 5.2.5; the proofs do not use it"},
      {"chapter-5/theorem-5.2/control-exists", needs_unstated_assumption, "thesis, theorem 5.2, theta_{n+1}"},
      {"chapter-5/theorem-5.2/regressor-step", slip_without_consequence,
       "thesis, proof of theorem 5.2, its last inequality"},
      {"chapter-5/disturbance", slip_without_consequence,
       "thesis, section 5.2.2, alpha_k and beta_k, two samples late"},
      {"chapter-5/initial-conditions", slip_without_consequence,
       "thesis, section 5.2.4; that the plant is at rest is enough"},
      {"chapter-5/expansion/B", slip_without_consequence,
       "thesis, section 5.2.4, a sign in the third coefficient of B"},
      {"chapter-5/lemma-5.3", slip_without_consequence, "thesis, lemma 5.3, with theta0 of (5.7)"},
      {"chapter-5/monitoring/beta", needs_unstated_assumption, "thesis, section 5.2.5, the factor beta"},
      {"chapter-5/internal-model", needs_unstated_assumption,
       "thesis, section 5.3.2; the plant itself must not resonate at the vibration's frequency"},
      {"chapter-5/limits/table-5.2/poles", slip_without_consequence,
       "thesis, section 5.4.2; the zeros in the delay operator are printed"},
      {"chapter-5/limits/match", slip_without_consequence,
       "thesis, section 5.4, Figures 5.6 to 5.11; only the pole has to match, and does"},
      // La Scala and Bitmead 1996.
      {"paper-1996/locally-observable", needs_unstated_assumption,
       "1996 paper, section II; (x1, x2) other than 0"},
      {"paper-1996/lemma-1/admits", false_as_stated, "1996 paper, lemma 1, with the theorem behind it"},
      {"paper-1996/predicted", false_as_stated, "1996 paper, section V, Figure 1"},
      {"paper-1996/over-design", needs_unstated_assumption,
       "1996 paper, section IV; a start that is over-designed, too"},
      {"paper-1996/under-estimate", false_as_stated, "1996 paper, section IV, after Jazwinski"},
      {"paper-1996/gramian/bounded", needs_unstated_assumption,
       "1996 paper, section IV.A; bounded estimates"},
      {"paper-1996/r-less-critical", needs_unstated_assumption,
       "1996 paper, section IV.C; true near the best ratio of Q and R"},
      {"paper-1996/slew-by-variance", needs_unstated_assumption, "1996 paper, section IV.B; R fixed"},
      {"paper-1996/figure-5/over-design", needs_unstated_assumption,
       "1996 paper, section V, Figure 5; it takes the smaller leak"},
      // Bittanti and Savaresi 2000.
      {"proposition-1/denominator-printed", slip_without_consequence, "paper, (4) and (6)"},
      {"proposition-1/response-printed", slip_without_consequence, "paper, (6)"},
      {"proposition-1/zeros", slip_without_consequence, "paper, after (7)"},
      {"proposition-1/every-start", needs_unstated_assumption, "paper, proposition 1, the start"},
      {"proposition-1/constant-sinusoid", false_as_stated, "paper, (7)"},
      {"proposition-1/varying-gain", false_as_stated, "paper, (4) to (7), the gains K(t)"},
      {"proposition-1/estimate-is-constant", false_as_stated, "paper, proof of proposition 1"},
      {"proposition-1/bias-grows/everywhere", false_as_stated, "paper, section II, after proposition 1"},
      {"proposition-1/indistinguishable", needs_unstated_assumption,
       "paper, section II; a signal has to be there"},
      {"proposition-2/same-start", needs_unstated_assumption,
       "paper, the conclusion of the proof of proposition 2; P(0) is not named there"},
      {"bittanti-savaresi/linearization-point", false_as_stated, "paper, below (2b) and below (14), F(t)"},
      {"bittanti-savaresi/I3", false_as_stated, "paper, below (2b), I3 = diag(0, 0, 1)"},
      // Praly, Marconi and Isidori.
      {"kkl-paper/phase-formula", illegible,
       "paper, section III; with (4), which the scan lost, one could tell whether the sign of the formula or "
       "that "
       "of (6) is the slip"},
      {"kkl-paper/dimensions", slip_without_consequence, "paper, (8)"},
      {"kkl-paper/scaling", slip_without_consequence, "paper, section IV, a = 0"},
      {"kkl-paper/injectivity-constant", slip_without_consequence,
       "paper, section IV, d; nothing else rests on its value"},
      {"kkl-paper/section-v-ell", false_as_stated, "paper, section V"},
      // Zarchan.
      {"zarchan/listings/second", slip_without_consequence,
       "slides, second listing, Q(1,2); PHIS is 0 there"},
      {"zarchan/listings/fourth", slip_without_consequence,
       "slides, fourth listing, Q(2,2); PHIS is 0 there"}};
  return ledger;
}

const PaperFinding* find_paper_finding(std::string_view claim) {
  const auto find = [](std::string_view wanted) -> const PaperFinding* {
    const auto& ledger = paper_findings();
    const auto found = std::find_if(ledger.begin(), ledger.end(),
                                    [&](const PaperFinding& finding) { return finding.claim == wanted; });
    return found == ledger.end() ? nullptr : &*found;
  };
  const PaperFinding* exact = find(claim);
  const std::size_t slash = claim.rfind('/');
  return exact != nullptr || slash == std::string_view::npos ? exact : find(claim.substr(0, slash));
}

void cite_findings(std::vector<Statement>& statements) {
  for (Statement& statement : statements) {
    cite(statement.id, statement.verdict, statement.witness);
  }
}

void cite_findings(Derivation& derivation) {
  for (Condition& condition : derivation.conditions) {
    cite(derivation.id + "/" + condition.id, condition.verdict, condition.reason);
  }
}

}  // namespace veritrack::theorems

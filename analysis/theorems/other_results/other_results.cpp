#include "analysis/theorems/other_results/other_results.hpp"

#include "analysis/statements/paper_findings.hpp"
#include "analysis/theorems/other_results/continuous_time.hpp"
#include "analysis/theorems/other_results/design_comparison.hpp"
#include "analysis/theorems/other_results/linearisation_noise.hpp"
#include "analysis/theorems/other_results/naive_riccati.hpp"
#include "analysis/theorems/other_results/observability_rank.hpp"
#include "analysis/theorems/other_results/reif.hpp"
#include "analysis/theorems/other_results/song_grizzle.hpp"
#include "analysis/theorems/other_results/table_3_1.hpp"
#include "analysis/theorems/other_results/total_stability.hpp"

namespace veritrack::theorems {

std::vector<Derivation> evaluate_other_results(const TrackerInput& input) {
  std::vector<Derivation> results{evaluate_riccati_bounds(input),
                                  evaluate_baras_bensoussan_james(input),
                                  evaluate_song_grizzle(input),
                                  evaluate_song_grizzle_local(input),
                                  evaluate_total_stability(input),
                                  evaluate_total_stability_corollary(input),
                                  evaluate_theorem_2_7_printed(input),
                                  evaluate_theorem_2_7_corrected(input),
                                  evaluate_observability_rank(input),
                                  evaluate_observability_to_the_letter(input),
                                  evaluate_theorem_3_2(input),
                                  evaluate_theorem_3_2_any_start(),
                                  evaluate_lemma_3_1(input),
                                  evaluate_table_3_1(Theorem29Variant::printed, input),
                                  evaluate_table_3_1(Theorem29Variant::errata, input),
                                  evaluate_reif(input),
                                  evaluate_reif_two_step(input)};
  for (Derivation& result : results) {
    cite_findings(result);
  }
  return results;
}

}  // namespace veritrack::theorems

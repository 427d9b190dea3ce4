#include "analysis/theorems/other_results.hpp"

#include "analysis/theorems/naive_riccati.hpp"
#include "analysis/theorems/reif.hpp"
#include "analysis/theorems/song_grizzle.hpp"
#include "analysis/theorems/total_stability.hpp"

namespace veritrack::theorems {

std::vector<Derivation> evaluate_other_results(const TrackerInput& input) {
  return {evaluate_riccati_bounds(input),
          evaluate_song_grizzle(input),
          evaluate_song_grizzle_local(input),
          evaluate_total_stability(input),
          evaluate_total_stability_corollary(input),
          evaluate_theorem_2_7_printed(input),
          evaluate_theorem_2_7_corrected(input),
          evaluate_reif(input),
          evaluate_reif_two_step(input)};
}

}  // namespace veritrack::theorems

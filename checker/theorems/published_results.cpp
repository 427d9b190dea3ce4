#include "checker/theorems/published_results.hpp"

#include <map>

#include "checker/theorems/published_results_parts.hpp"

namespace veritrack::checker {

namespace {

using Evaluate = Derivation (*)(const Design& design, const Tree& claimed);

const std::map<std::string, Evaluate>& results() {
  static const std::map<std::string, Evaluate> known{{"riccati-bounds", riccati_bounds},
                                                     {"baras-bensoussan-james", baras_bensoussan_james},
                                                     {"song-grizzle", song_grizzle},
                                                     {"song-grizzle/local", song_grizzle_local},
                                                     {"theorem-2.7/printed", theorem_2_7_printed},
                                                     {"theorem-2.7/corrected", theorem_2_7_corrected},
                                                     {"theorem-3.1", theorem_3_1},
                                                     {"theorem-3.1/to-the-letter", theorem_3_1_to_the_letter},
                                                     {"theorem-3.2", theorem_3_2},
                                                     {"theorem-3.2/any-start", theorem_3_2_any_start},
                                                     {"lemma-3.1", lemma_3_1},
                                                     {"total-stability", total_stability},
                                                     {"total-stability/corollary", total_stability_corollary},
                                                     {"reif-1999", reif},
                                                     {"reif-1999/two-step", reif_two_step}};
  return known;
}

}  // namespace

bool is_published_result(const std::string& id) {
  return results().count(id) != 0;
}

std::string check_published_result(const std::string& id, const Tree& derivation, const Design& design,
                                   Objections& objections) {
  return check_derivation(derivation, results().at(id)(design, derivation), objections);
}

}  // namespace veritrack::checker

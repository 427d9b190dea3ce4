// A tracker that is started in one known state, whatever the phase and the frequency of the signal are: is it
// in a certified set after a given number of samples? (docs/model-proof.md, section 16.)
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "analysis/model/capture/followed_start.hpp"
#include "analysis/model/step/cell_cover.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::model {

struct StartCapture {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< PROVED or UNDECIDED
  std::string reason;                                  ///< why not PROVED
  std::size_t samples = 0;                             ///< PROVED: the state is then in the set
  /// PROVED: of h - omega until then, rad/sample; empty when it is not known.
  rigor::Interval frequency_error;
  std::size_t cells = 0;  ///< that were needed
};

/// Whether the start is captured at every phase and at every frequency of each of the tubes: cells where it
/// is not are halved, up to the budget, which is for each tube. The result does not depend on the number of
/// threads. The caller must have proved that states at the levels stay there. `progress`: of the tubes.
[[nodiscard]] StartCapture prove_start_captured(const TrackerModel& model,
                                                const std::vector<TubeOfLevel>& tubes,
                                                const StartQuestion& question,
                                                const VerificationBudget& budget,
                                                const std::function<void(double)>& progress = {});

/// The number of samples after which the start is in the tubes, by simulations without noise at some phases
/// and frequencies; the largest of them. `most` when one of them is not there until then. Not evidence.
[[nodiscard]] std::size_t simulated_capture(const TrackerModel& model, const std::vector<TubeOfLevel>& tubes,
                                            const std::vector<rigor::Interval>& state, std::size_t most);

}  // namespace veritrack::model

// Sets for Gaussian noise as the search proposes them, and the first verified one: for the assumed noise, and
// for the most that can be proved.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "analysis/dft_block/lock_loss.hpp"
#include "analysis/dft_block/lock_search.hpp"

namespace veritrack::dft_block {

/// Shares of the slew that are tried (loss_bound).
inline constexpr std::array kSlewShares{0.02, 0.05, 0.1, 0.2, 0.4};

/// A set with its drift; neither depends on the size of the noise. Not evidence of anything.
struct ProposedDrift {
  LockBounds set;
  LockDrift drift;
};

/// By radius, each larger than the one before by the factor `step`, and tilt. Opens its own rounding scopes.
[[nodiscard]] std::vector<ProposedDrift> propose_drifts(const LockProblem& problem, const LockSearch& search,
                                                        double step);

/// A set with the resulting bound for some noise.
struct InNoise {
  LockBounds set;
  LockDrift drift;
  double slew_share = 1.0;
  LossBound bound;
};

/// The first of them whose drift is verified; a few are tried, after a failure smaller sets. Needs the upward
/// mode.
[[nodiscard]] std::optional<InNoise> first_verified(const LossQuestion& question,
                                                    const std::vector<InNoise>& proposed);

/// Conditions, evidence and quantities of the findings for the noise of the question. Needs the upward mode.
void conclude_loss(theorems::Derivation& derivation, const LossQuestion& question,
                   const std::optional<InNoise>& found);

}  // namespace veritrack::dft_block

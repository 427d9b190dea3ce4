#include "analysis/dft_block/loss_proposals.hpp"

namespace veritrack::dft_block {

std::vector<ProposedDrift> propose_drifts(const LockProblem& problem, const LockSearch& search, double step) {
  std::vector<ProposedDrift> result;
  constexpr double kLargest = 4.0;
  for (double radius = 0.1; radius < kLargest; radius *= step) {
    const auto set = search.set_for(radius);
    if (!set || !LockFrame::make(problem, *set)) {
      break;
    }
    for (double tilt = 0.2; tilt < 0.95; tilt += 0.1) {
      const auto drift = search.drift_for(*set, radius, tilt);
      if (!drift) {
        break;
      }
      result.push_back({*set, *drift});
    }
  }
  return result;
}

std::optional<InNoise> first_verified(const LossQuestion& question, const std::vector<InNoise>& proposed) {
  constexpr int kMostTries = 4;
  int tries = 0;
  double last_radius = 10.0;
  for (const InNoise& one : proposed) {
    // After a failure a smaller set.
    if (!(one.drift.radius < 0.97 * last_radius)) {
      continue;
    }
    const auto frame = LockFrame::make(question.problem, one.set);
    if (frame && frame->verify(one.drift, question.most_cells)) {
      return one;
    }
    last_radius = one.drift.radius;
    if (++tries >= kMostTries) {
      break;
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::dft_block

// Steady states of loops in the frame of their signal (docs/gain-proof.md, section 2): proposals, not
// evidence.
#pragma once

#include <optional>
#include <vector>

#include "analysis/model/gain/loop_network.hpp"

namespace veritrack::model {

/// Two states that may be the parts of a vector, with the turns of its angle. Its direction alone matters, or
/// its length does.
struct ProposedVector {
  std::size_t real = 0, imaginary = 0;
  int turns = 1;
  bool has_length = false;
};

/// With two channels, every pair of states that are no angles; else none.
[[nodiscard]] std::vector<ProposedVector> possible_vectors(const TrackerModel& tracker);

/// That of a steady state, if there is one.
[[nodiscard]] std::optional<ProposedVector> vector_of(const std::vector<SteadyValue>& steady);

/// By Newton's method from `start`, at two frequencies; empty where there is none. Throws NoFrame. Needs the
/// upward rounding mode.
[[nodiscard]] std::optional<std::vector<SteadyValue>> proposed_steady_state(
    const TrackerModel& tracker, const StartState& start, double low, double high,
    const std::optional<ProposedVector>& vector = std::nullopt);

/// The steady state at this phase and frequency, rad and rad/sample. A vector has the length to which a step
/// brings it. Needs the rounding mode to the nearest.
[[nodiscard]] Eigen::VectorXd state_at(const TrackedTone& tone, const std::vector<SteadyValue>& steady,
                                       double phase, double omega);

/// Its derivative by the frequency.
[[nodiscard]] Eigen::VectorXd state_per_frequency(const TrackedTone& tone,
                                                  const std::vector<SteadyValue>& steady, double phase,
                                                  double omega);

}  // namespace veritrack::model

// A turn of an angle and of two other states together that a tracker does not notice, such as that of the
// phase and of the weights of its cosine and sine. In floating point, for messages.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/steady_state/step_derivatives.hpp"

namespace veritrack::model {

/// When the angle turns by t, (cosine, sine) turns by t. The states x = cosine cos(angle) + sine sin(angle)
/// and z = sine cos(angle) - cosine sin(angle) do not change then.
struct NeutralTurn {
  std::size_t angle = 0;
  std::size_t cosine = 0, sine = 0;
};

/// Whether such a turn before the step is the same turn after it, at every state that is tried near this one,
/// and leaves the frequency as it is. Errors of this kind never decay. `near`, `size`: a state, and sizes of
/// its entries, which say how far to try. A guess, from four states.
[[nodiscard]] std::optional<NeutralTurn> find_neutral_turn(const StepMap& step, const Eigen::VectorXd& near,
                                                           const Eigen::VectorXd& size);

/// What to write in place of the three states. `names`: of all states.
[[nodiscard]] std::string words_of(const NeutralTurn& turn, const std::vector<std::string>& names);

}  // namespace veritrack::model

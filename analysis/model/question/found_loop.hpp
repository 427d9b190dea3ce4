// The steady state of a loop in the frame of its signal, and the network about it: what gains begin with.
#pragma once

#include <optional>
#include <vector>

#include "analysis/model/gain/loop_network.hpp"
#include "analysis/model/question/set_question.hpp"

namespace veritrack::model {

struct FoundLoop {
  std::vector<SteadyValue> steady;
  LoopNetwork network;
};

/// The first steady state about which errors decay, or else the first of all: near `start`, half a turn
/// further, or where a simulation comes to; with each state by itself, or else with two of them as a vector
/// whose direction alone matters. A start that is assumed off the steady state says nothing of directions.
/// None is as far from the true frequency as a false lock may be. Empty where there is none. Throws NoFrame
/// where the rules do not cover the loop. Needs the upward rounding mode.
[[nodiscard]] std::optional<FoundLoop> find_loop(const SetQuestion& question);

}  // namespace veritrack::model

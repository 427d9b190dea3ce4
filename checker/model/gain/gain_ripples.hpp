// Ripples of a loop of one channel by averaging (docs/gain-proof.md, section 9): inputs that turn with the
// signal. Each is written as a response that is known up to how fast its own angle changes, and that change.
#pragma once

#include "checker/model/gain/gain_network.hpp"

namespace veritrack::checker {

/// Adds to a network with ripples in it the forms of their angles and of the changes of these, the responses,
/// and the drifts. All other inputs and forms are there. Throws NotCovered where a response is not certain.
void add_ripples(const std::vector<FrameInput>& inputs, const Ball& lowest, const Ball& highest,
                 GainNetwork& network);

}  // namespace veritrack::checker

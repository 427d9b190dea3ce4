// The order of factors in products: real numbers do not mind, bounds of remainders do.
#pragma once

#include <vector>

#include "trackers/model/straight_line_program.hpp"

namespace veritrack::model {

/// The same function of real numbers, where of a product or quotient of three factors or more the one that
/// vanishes in the steady state (a difference that is below 2^-10 of its terms) comes last. The effect of
/// errors of the others on each other is then multiplied by nearly 0. `values`: those of the registers of
/// `program` at some states of the steady state, which decide the order and nothing else.
[[nodiscard]] trackers::StraightLineProgram with_vanishing_factors_last(
    const trackers::StraightLineProgram& program, const std::vector<std::vector<double>>& values);

}  // namespace veritrack::model

// The claims that a design's [require] asks for, and the guarantee in one sentence.
#pragma once

#include "checker/contraction.hpp"

namespace veritrack::checker {

bool is_guarantee(const std::string& id);

/// The ids of the claims that a design's [require] asks for, in their order.
std::vector<std::string> requirements(const Tree& design);

/// Objects to a claim of these that the promises do not prove.
void check_guarantee(const Tree& claim, const Tree& certificate, const Design& design,
                     const Promises& promises, Objections& objections);

}  // namespace veritrack::checker

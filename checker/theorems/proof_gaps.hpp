// The places of the proof of Theorem 2.9 where it may break: each claim with the checker's own verdict. A
// refutation is a witness evaluated again.
#pragma once

#include <map>
#include <string>

#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

/// By id, for this design.
std::map<std::string, Claim> proof_gaps(const Design& design);

}  // namespace veritrack::checker

// The single-channel tracker (Bittanti and Savaresi): the claims about the formulas of its propositions.
#pragma once

#include <map>
#include <string>

#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// By id. They are true, or false, for every design.
std::map<std::string, Claim> proposition_claims();

}  // namespace veritrack::checker

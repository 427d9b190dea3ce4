// Theorem 2.9, repaired (docs/repaired-theorem.md): the error in the norm of the filter's own covariance,
// W(k+1) <= alpha W + c W^2 + g_w |w| + g_v |v| in a tube around the signal, from the matrices in the
// evidence.
#pragma once

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Objects to every statement of the derivation "theorem-2.9/repaired" that its evidence does not prove.
std::string check_repaired_theorem(const Tree& derivation, const Design& design, Objections& objections);

}  // namespace veritrack::checker

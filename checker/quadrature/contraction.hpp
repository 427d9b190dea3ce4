// The contraction certificate of the tracker without a leak (docs/contraction.md), re-established from the
// certified sets alone.
#pragma once

#include <vector>

#include "checker/quadrature/certified_set.hpp"
#include "checker/sets/guarantee.hpp"

namespace veritrack::checker {

/// Objects to every statement of the derivation "contraction" that the verified sets do not prove.
Promises check_contraction(const Tree& derivation, const Design& design,
                           const std::vector<CertifiedSet>& sets, Objections& objections);

}  // namespace veritrack::checker

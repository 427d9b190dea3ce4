// The contraction certificate of the tracker with a leak (docs/leak.md), re-established from the sets in its
// evidence.
#pragma once

#include <cstdint>

#include "checker/quadrature/steady_set.hpp"
#include "checker/sets/guarantee.hpp"

namespace veritrack::checker {

/// Objects to every statement of the derivation "contraction" that its sets do not prove over the band of
/// frequencies.
Promises check_steady_contraction(const Tree& derivation, const Design& design, std::int64_t& cells,
                                  Objections& objections);

}  // namespace veritrack::checker

// Table 3.1 of the thesis: how alpha and beta of Theorem 2.9 move with q1, q2 and r.
#pragma once

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Objects to every statement of the derivation that could not be re-established, as printed or with the
/// errata sheet. The signs of the derivatives are those of s p^2 q (alpha) and p q (beta), for q1, q2 and r
/// from half to twice the design's. Nothing is established unless sigma is in its range and q1 <= q2: the
/// thesis's footnote gives the opposite signs for q1 > q2.
std::string check_table_3_1(const Tree& derivation, const Design& design, bool printed,
                            Objections& objections);

}  // namespace veritrack::checker

// The places of the proof of Theorem 2.9 by subject, for proof_gaps.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

using Claims = std::map<std::string, Claim>;

inline void add(Claims& claims, const std::string& place, const std::string& statement, Verdict verdict,
                const std::vector<Quantity>& evidence) {
  claims["theorem-2.9/" + place] = {statement, verdict, evidence};
}

/// Sections 2.4.1 and 3.5: the Gramian of two measurements.
void add_gramian(Claims& claims, const Design& design, const Constants29& constants,
                 const std::string& reading);
void add_gramian_formula(Claims& claims, const Design& design);
/// Section 2.4.3: derivatives of f, remainders.
void add_derivatives(Claims& claims, const Design& design, const Constants29& constants,
                     const std::string& reading);
void add_remainders(Claims& claims, const Design& design, const Constants29& printed);

}  // namespace veritrack::checker

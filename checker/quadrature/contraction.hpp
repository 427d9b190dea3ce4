// The contraction certificate of the tracker without a leak (docs/contraction.md), re-established from the
// certified sets alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/document/design.hpp"
#include "checker/document/guarantee.hpp"
#include "checker/quadrature/step.hpp"

namespace veritrack::checker {

/// A certified set as the certificate gives it.
struct CertifiedSet {
  std::string purpose;
  Setting setting;
  bool verified = false;
};

/// Reads a set and proves of it, from nothing but the design: P_lo > 0, P_hi > P_lo, T invertible, and the
/// hypotheses (a), (b), (c) of the theorem. What fails is an objection, and the set is not verified.
CertifiedSet check_set(const Tree& set, const Design& design, std::int64_t& cells, Objections& objections);

/// Objects to what of the derivation "contraction" the verified sets do not prove.
Promises check_contraction(const Tree& derivation, const Design& design,
                           const std::vector<CertifiedSet>& sets, Objections& objections);

}  // namespace veritrack::checker

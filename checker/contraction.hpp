// The contraction certificate of the tracker without a leak (docs/contraction.md), re-established from the
// certified sets alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/design.hpp"
#include "checker/step.hpp"

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

/// What the verified sets that bear the assumed noise and slew prove of the assumed starts.
struct Promises {
  bool starts_inside = false;
  std::optional<Ball> ultimate;  ///< limsup of |frequency error|, rad/sample: an upper bound
  std::optional<Ball> bound;     ///< of |frequency error| at every sample, rad/sample
  std::optional<Ball> settling;  ///< samples until it is within twice the ultimate bound that is claimed
  // Of sets that are never left, whatever the start: noise without slew, slew without noise, and how far the
  // set for the assumed noise and slew reaches in frequency, rad/sample. Lower bounds.
  std::optional<Ball> noise, slew, reach;
};

/// Objects to what of the derivation "contraction" the verified sets do not prove.
Promises check_contraction(const Tree& derivation, const Design& design,
                           const std::vector<CertifiedSet>& sets, Objections& objections);

}  // namespace veritrack::checker

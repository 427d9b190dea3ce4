// A set around the steady state of the tracker with a leak (docs/leak.md, section 2), re-established from its
// numbers alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/quadrature/steady_state.hpp"
#include "checker/quadrature/steady_step.hpp"

namespace veritrack::checker {

/// Omega_s(omega) = {|T (e - e*)| <= s} x {-s below <= P - P* <= s above}, 0 < s <= 1. When verified: while
/// the frequency stays in the band, a state of Omega_s, s one of `levels`, is followed by one of Omega_(next
/// level), and a state of the last level by one of the same level, under noise up to `noise` and slew up to
/// `slew`.
struct SteadySet {
  std::string name;
  SteadySetting setting;
  Ball noise, slew;
  std::vector<Ball> levels;  ///< falling from 1
  bool verified = false;
};

/// Reads a set from the evidence of a derivation and proves its promise over the branch, from nothing but the
/// design. Each failure is an objection, and the set is then not verified.
SteadySet check_steady_set(const Tree& evidence, const Design& design, const std::vector<SteadyCell>& branch,
                           std::int64_t& cells, Objections& objections);

}  // namespace veritrack::checker

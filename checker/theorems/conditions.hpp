// Conditions that several of the published results share.
#pragma once

#include <string>

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// left < right, with its two sides.
inline Condition less(const std::string& id, const std::string& statement, const Range& left,
                      const Ball& right) {
  const Verdict verdict = certainly_less(left.high, right)     ? Verdict::proved
                          : certainly_at_most(right, left.low) ? Verdict::refuted
                                                               : Verdict::undecided;
  return {id, statement, verdict, left, right};
}
inline Condition at_most(const std::string& id, const std::string& statement, const Ball& left,
                         const Ball& right) {
  return {id, statement, decide_at_most(left, right), left, right};
}
inline Ball leaked(const Design& d) {
  return d.epsilon * d.largest_frequency;
}
/// The largest |w| + |v| that is assumed: |w| may be anything from the leak's part to that part plus the
/// slew.
inline Condition noise_free(const std::string& statement, const Design& d) {
  const Ball least = leaked(d) + d.noise;
  const Ball most = least + d.slew;
  const Verdict verdict = certainly_at_most(most, zero) ? Verdict::proved
                          : certainly_less(zero, least) ? Verdict::refuted
                                                        : Verdict::undecided;
  return {"noise-free", statement, verdict, Range(least, most), zero};
}

}  // namespace veritrack::checker

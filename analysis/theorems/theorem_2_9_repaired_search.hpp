// The error recursions that Theorem 2.9 repaired rests on: the best for each of its bounds.
#pragma once

#include <optional>
#include <vector>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/error_recursion.hpp"
#include "analysis/theorems/theorem_2_9.hpp"

namespace veritrack::theorems {

inline constexpr const char* kRepairedProof = "docs/repaired-theorem.md";
inline constexpr const char* kNoRepairedRecursion =
    "No tube around the signal was found in which the covariance bounds make the error decrease.";

/// The parts of the derivation. A recursion is empty if none was found.
struct Repaired {
  IntervalDesign design;
  std::optional<ErrorRecursion> start, noise, process, assumed;
  rigor::Interval start_radius;  ///< of `start`, without noise
  rigor::Interval disturbance;   ///< assumed: g_w |w| + g_v |v|
  rigor::Interval assumed_radius;
};

/// W(0) <= R is certain for |e(0)| <= R / sqrt(q). Needs the upward mode, as all that follows.
[[nodiscard]] rigor::Interval start_error(const ErrorRecursion& recursion, const rigor::Interval& radius);

/// The same for an error of the frequency alone.
[[nodiscard]] rigor::Interval start_frequency_error(const ErrorRecursion& recursion,
                                                    const rigor::Interval& radius);

/// The best recursions and radii that were verified.
[[nodiscard]] Repaired search_repaired(const Theorem29Input& input);

/// The ends of the constants used by the bounds, and the matrices they are computed from.
[[nodiscard]] std::vector<Evidence> repaired_evidence(const Repaired& found);

/// A point with positive noise bounds and a positive start error, or the reason why there is none.
[[nodiscard]] Feasibility repaired_feasibility(const Repaired& found);

}  // namespace veritrack::theorems

// The intermediate results of the KKL observer's static map, by name.
#pragma once

namespace veritrack::trackers {

/// Intermediate results of the static map, for an analysis that knows more of them than their operands show.
enum class KklResult {
  squared_norm,  ///< |xi|^2
  excess,        ///< ell |xi|^2 - 2 |M xi|^2
  entry_13,      ///< of L'L
  entry_23,      ///< of L'L
  entry_33,      ///< of L'L
  right_1,       ///< of L' F^2 xi
  right_2,       ///< of L' F^2 xi
  right_3,       ///< of L' F^2 xi
  reduced_23,    ///< the entry that is left when x1 is eliminated
  reduced_33,    ///< the entry that is left when x1 and x2 are eliminated
  reduced_2,     ///< the right-hand side when x1 is eliminated
  reduced_3,     ///< the right-hand side when x1 and x2 are eliminated
  x3,            ///< the estimate of w^2
  squared_amplitude,
  count
};

/// A tracker knows nothing beside its numbers: each is left unchanged.
struct KklNothingKnown {
  template <typename Scalar>
  [[nodiscard]] const Scalar& operator()(KklResult /*which*/, const Scalar& x) const {
    return x;
  }
};

}  // namespace veritrack::trackers

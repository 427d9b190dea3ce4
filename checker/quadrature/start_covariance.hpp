// The covariances P(0|0) with which the filter may be started, in the frame of the estimated phase.
#pragma once

#include <optional>
#include <string>

#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/step.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// All symmetric P between two matrices in the Loewner order.
struct StartCovariance {
  Matrix3 lowest, highest;  ///< for a signal of amplitude 1
  std::string words;        ///< for sentences, in signal units: "and with P(0|0) ..."

  /// All of them lie strictly between two bounds.
  [[nodiscard]] bool between(const Covariance<Ball>& lower, const Covariance<Ball>& upper) const;
  /// A ball, entry by entry, that contains all of them: with D the highest minus the lowest, P_ij is within
  /// sqrt(D_ii D_jj) of that of the lowest.
  [[nodiscard]] Matrix3 enclosure() const;
};

/// The matrix or the range that the design gives, or, where it says "steady-state" or gives multiples of it,
/// the matrix and the multiples in the evidence "start-covariance" of the derivation: these multiples are
/// those of the design, or contain that matrix itself. Empty when there is neither. Objects to a matrix that
/// is not positive definite.
std::optional<StartCovariance> read_start_covariance(const Tree& derivation, const Design& design,
                                                     Objections& objections);

}  // namespace veritrack::checker

// The covariances P(0|0) with which the filter may be started, in the frame of the estimated phase.
#pragma once

#include <optional>
#include <string>

#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/step.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// All symmetric P with from M <= P <= to M in the Loewner order.
struct StartCovariance {
  Matrix3 matrix;  ///< M, for a signal of amplitude 1
  Ball from, to;
  std::string words;  ///< for sentences, in signal units: "and with P(0|0) ..."

  /// All of them lie strictly between two bounds.
  [[nodiscard]] bool between(const Covariance<Ball>& lower, const Covariance<Ball>& upper) const;
  /// A ball, entry by entry, that contains all of them: |P_ij - from M_ij| <= (to - from) sqrt(M_ii M_jj).
  [[nodiscard]] Matrix3 enclosure() const;
};

/// The one that the design gives, or, where it says "steady-state", the matrix and the multiples in the
/// evidence "start-covariance" of the derivation, which must contain that matrix itself; nothing when there
/// is neither. Objects to a matrix that is not positive definite.
std::optional<StartCovariance> read_start_covariance(const Tree& derivation, const Design& design,
                                                     Objections& objections);

}  // namespace veritrack::checker

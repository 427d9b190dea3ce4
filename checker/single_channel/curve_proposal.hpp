// Proposals simulated in doubles: where the steady state of the single-channel tracker may be, and in which
// norms the tracker contracts about it. invariant_curve.cpp proves what it needs of them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "checker/numbers/matrix.hpp"
#include "checker/sets/tone_step.hpp"

namespace veritrack::checker {

/// C(phi; t) = sum_k terms[k] b(phi) t^k at the frequency center + half_width t, |t| <= 1, with the column
/// b(phi) of 1, cos 2j phi, sin 2j phi, j = 1, ..., harmonics. Each term has a row for each component of the
/// state; its doubles are meant exactly.
struct CurveFamily {
  double center = 0.0, half_width = 0.0;  ///< rad/sample
  slong harmonics = 1;
  std::vector<Matrix> terms;
};

/// The t at which a family is the simulated steady state: one for a single frequency.
const std::vector<double>& curve_nodes(double half_width);

/// Empty when the simulation does not settle.
std::optional<CurveFamily> propose_curves(const TrackerValues<double>& values, double center,
                                          double half_width);

using Weights = std::array<double, kToneStates>;

/// |x| = |root x| in the Euclidean norm; `inverse` is near the inverse of `root`.
struct Norm {
  Matrix root, inverse;
};
struct Norms {
  Weights weights;          ///< W, so that root'root is about W^2 + ...
  std::vector<Norm> cells;  ///< at the middles of equal parts of [0, pi]
};

/// Norms in which the map over the phase contracts at a rate between that along a long orbit and 1:
/// root'root = M, M(phi) = W^2 + J'M(phi + omega)J/rate^2, with the Jacobian J along the curve of t = 0.
Norms propose_norms(const TrackerValues<double>& values, const CurveFamily& family, std::size_t cells);

}  // namespace veritrack::checker

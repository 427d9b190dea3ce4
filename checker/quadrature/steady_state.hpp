// The steady states of the tracker with a leak: a branch X*(omega) = (e*, P*) of fixed points of its step,
// over a band of frequencies (docs/leak.md, section 1).
#pragma once

#include <optional>
#include <vector>

#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/polar_frame.hpp"

namespace veritrack::checker {

/// (a, psi, nu) and the entries of P in the order of Entry.
constexpr std::size_t kStates = 9;
using StateVector = std::array<Ball, kStates>;

/// At every frequency of a cell, `middle + slope (omega - centre) + unique` contains exactly one fixed point,
/// and `tight` in the place of `unique` contains it as well. `middle` and `slope` are exact.
struct SteadyCell {
  double from, to;         ///< rad/sample
  Ball frequency, centre;  ///< all of them, and one
  StateVector middle, slope, unique, tight;
  StateVector derivative;  ///< contains dX*/domega

  /// Contains X* at all of these frequencies of the cell.
  [[nodiscard]] StateVector at(const Ball& omega) const;
};

Matrix3 matrix_of(const Symmetric<Ball>& p);
/// The entries of P.
Symmetric<Ball> covariance_part(const StateVector& state);

/// The branch over the design's frequencies in cells that join, none wider than `widest`, each within
/// `accuracy` of nu* about a line (rad/sample): followed from the exact estimate at frequency 0, so that it
/// is the same for all of them (where fixed points are regular branches do not meet). Empty when it could not
/// be followed.
std::optional<std::vector<SteadyCell>> steady_branch(const Design& design, double widest, double accuracy);

}  // namespace veritrack::checker

// How far one step of the tracker in double precision can be from the same step in real arithmetic.
//
// Both start from what the program holds: an estimate whose covariance is the matrix that its factors stand
// for, and a measurement. The step commutes with turns of the plane, but its rounding does not: the bound
// covers every orientation.
#pragma once

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/sets/state_difference.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

using sets::difference_of;
using sets::is_finite;
using sets::larger;
using sets::Program;
using sets::StateDifference;
using sets::upper_or_infinite;

/// What of the signal matters to rounding, besides its frequency error.
struct TrackedSignal {
  rigor::Interval amplitude = rigor::Interval(1.0);  ///< signal units
  double largest_frequency = 0x1.921fb54442d19p+1;   ///< of |omega|, rad/sample; pi from above
};

/// Into how many pieces step_rounding cuts the ranges of what it looks at: many for a tight bound.
struct Pieces {
  int amplitude = 2;           ///< z1
  int frequency_variance = 8;  ///< P_33
  int regression = 4;          ///< of each component of P_z3 / P_33
  int angles = 32;             ///< orientations
};

/// Filtered states, in some orientation of the plane, relative to the true amplitude: z in a box, and every
/// symmetric P with lower <= P <= upper in the Loewner order, for some positive definite bounds in these
/// interval matrices.
struct HeldStates {
  rigor::Interval z1, z2;
  rigor::IntervalMatrix<3> lower, upper;
};

/// |program's step - exact step| for every state in the box, turned by any angle, and every measurement;
/// infinite when it cannot be bounded. Needs the upward mode.
[[nodiscard]] StateDifference step_rounding(const Program& program, const HeldStates& box,
                                            const Pieces& pieces = {});

}  // namespace veritrack::quadrature

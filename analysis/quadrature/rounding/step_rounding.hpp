// How far one step of the tracker in double precision can be from the same step in real arithmetic.
//
// Both start from the program's numbers: an estimate, the matrix represented by its covariance factors, and a
// measurement. The step commutes with turns of the plane, but its rounding does not: the bound covers every
// orientation.
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

/// The properties of the signal that matter to rounding, besides its frequency error.
struct TrackedSignal {
  rigor::Interval amplitude = rigor::Interval(1.0);  ///< signal units
  double largest_frequency = 0x1.921fb54442d19p+1;   ///< of |omega|, rad/sample; pi from above
};

/// The number of pieces into which step_rounding cuts its ranges: many give a tight bound.
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

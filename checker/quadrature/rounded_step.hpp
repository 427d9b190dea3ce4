// Bounds on the distance of a step of the tracker in double precision from the exact step: the checker's own
// transcription of the operations of trackers/quadrature/quadrature_ekf.hpp, `step`, with a bound on the size
// of each result (docs/rounding.md, section 5).
//
// Assumed of the program: + - * / round to nearest in IEEE 754 double precision, sine and cosine are within
// one unit in the last place. Lengths are relative to the true amplitude, which must be between 2^-60 and
// 2^60.
#pragma once

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

/// The filter at a signal of amplitude 1, and the true amplitude, signal units.
struct Filter {
  Ball q1, q2, r, epsilon;
  Ball amplitude;
};

/// Bounds on the program's values before the step, in any orientation of the plane: the upper ends of these
/// balls are used, and the lower ends of `least_...`.
struct Held {
  Ball z;            ///< |z|
  Ball frequency;    ///< |x3|, rad/sample
  Ball measurement;  ///< |y|
  // P = [[M + d u u', d u], [d u', d]].
  Ball least_m, most_m;  ///< eigenvalues of M; least_m >= 0
  Ball u;                ///< |u|
  Ball least_d, most_d;  ///< d
};

/// Sets in `held` the bounds on the factors of a P with lower <= P <= upper in the Loewner order.
void add_covariance(const Matrix3& lower, const Matrix3& upper, Held& held);

/// Bounds on |program's step - exact step|: the length for z, the norms of the blocks for P.
struct Rounding {
  Ball z, frequency, p_zz, p_z3, p_33;
  [[nodiscard]] bool finite() const {
    return z.finite() && frequency.finite() && p_zz.finite() && p_z3.finite() && p_33.finite();
  }
};

/// Balls of everything when there is no bound.
Rounding rounded_step(const Filter& filter, const Held& held);

/// The same for amplitude and phase (rad) and for the covariance in the frame of the estimated phase, when
/// the exact step ends with |z| >= least_z, |P_zz| <= most_zz and P_33 <= most_33.
struct PolarRounding {
  Ball amplitude, phase, frequency;
  Ball p_zz, p_z3, p_33;
};
PolarRounding polar_rounding(const Rounding& rounding, const Ball& least_z, const Ball& most_zz,
                             const Ball& most_33);

/// A number m, at most twice the least, such that -m P <= D <= m P for every symmetric D with such blocks; a
/// ball of everything when there is none.
Ball rounding_share(const Matrix3& p, const PolarRounding& rounding);

}  // namespace veritrack::checker

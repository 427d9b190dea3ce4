// One step of the quadrature tracker in the frame of the true phase, for an estimate whose
// covariance is known up to a level: the checker's own formulas for docs/gaussian.md, sections 1, 3 and 5.
//
// A covariance of level s or less lies between lo(s) and hi(s), so its image lies between their images, which
// lie below and above their tangents at any level s_0 (docs/gaussian.md, section 6). Here these tangents are
// functions of the errors in a box: numbers with the slopes of their chords from the middle of the box.
#pragma once

#include <array>

#include "checker/numbers/chord.hpp"
#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/step.hpp"

namespace veritrack::checker {

/// A symmetric matrix; 12 and 13 are zero without a leak.
struct LockCovariance {
  Ball p11, p22, p23, p33;
  Ball p12 = {}, p13 = {};
};

/// The data behind a certificate of the probability of losing lock, docs/gaussian.md, section 4, at a signal
/// of amplitude 1. The level of (e, P) is (|T e|^2 + gamma s^2)/2, s the level of P.
struct LockSet {
  Metric metric;                        ///< T
  LockCovariance centre, above, below;  ///< P_0, D_h, D_l
  Ball weight, level, decay, drift;     ///< gamma, L, kappa, c_0
  Ball deviation, walk;                 ///< sigma of each channel; w, rad/sample
  /// With a leak: e_0, from which the errors e are measured, and the frequencies of the signal, rad/sample.
  std::array<Ball, 3> bias = {};
  Ball lowest_frequency = {}, highest_frequency = {};
};

/// The filter at a signal of amplitude 1, 0 <= epsilon < 1.
struct LockFilter {
  Ball q1, q2, r;
  Ball epsilon = {};
};

/// Room for the rounding of a step: the changes that it may make in |T e|, and in the level of the
/// covariance. Part of the format.
const Ball& lock_room();

/// A symmetric matrix, by its lower triangle.
template <typename S>
using Lower3 = std::array<std::array<S, 3>, 3>;

LockCovariance operator+(const LockCovariance& x, const LockCovariance& y);
LockCovariance operator*(const Ball& factor, const LockCovariance& x);
LockCovariance inverse(const LockCovariance& p);
Matrix3 whole(const LockCovariance& p);
/// Only its lower triangle is used.
LockCovariance lock_covariance(const Matrix3& p);
/// hi(s) = P_0 + s D_h, and lo(s) = (P_0^-1 + s D_l)^-1.
LockCovariance upper_covariance(const LockSet& set, const Ball& s);
LockCovariance lower_covariance(const LockSet& set, const Ball& s);

/// T X T'.
template <typename S>
Lower3<S> transformed(const Metric& t, const Lower3<S>& x) {
  const S row2 = t.phase * x[1][1] + t.coupling * x[2][1];
  const S row3 = t.phase * x[2][1] + t.coupling * x[2][2];
  Lower3<S> y;
  y[0][0] = (t.amplitude * t.amplitude) * x[0][0];
  y[1][0] = t.amplitude * (t.phase * x[1][0] + t.coupling * x[2][0]);
  y[1][1] = t.phase * row2 + t.coupling * row3;
  y[2][0] = (t.amplitude * t.frequency) * x[2][0];
  y[2][1] = t.frequency * row3;
  y[2][2] = (t.frequency * t.frequency) * x[2][2];
  return y;
}

/// The images of lo(s_0) and hi(s_0), how they change with s there, and the error that the prediction leaves.
struct LockStep {
  Lower3<Chord> lower, upper;              ///< Psi
  Lower3<Chord> lower_slope, upper_slope;  ///< d Psi / d s
  /// m - e_0 for the image halfway between, at s_0 and the middle of the frequencies: its last entry is at
  /// most `reach` away at others, along a straight line.
  std::array<Chord, 3> mean;
  Ball reach;
  std::array<Chord, 2> prediction;  ///< p_z
};

/// For u = T e in a box.
LockStep lock_step(const LockFilter& filter, const LockSet& set, const std::array<Chord, 3>& u,
                   const Ball& level);

}  // namespace veritrack::checker

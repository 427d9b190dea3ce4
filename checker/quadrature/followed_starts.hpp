// Starts of the quadrature tracker, followed sample by sample: an enclosure of every state that a box of
// starts can reach, for all noise and slew within their bounds. With and without a leak.
//
// The frame is that of the true phase, the signal of amplitude 1 is (1, 0) in it. The state consists of z =
// (z1, z2), nu = x3 - omega, and P of the filtered estimate. With omega the frequency, w = omega+ - omega, v
// the noise, J z = (-z2, z1), Rot the turn by nu (the prediction turns by x3, the signal by omega), and
// everything before the last line in the frame of the prediction:
//     F = [[I, J z], [0, 1 - epsilon]],  P^ = F P F' + diag(q1, q1, q2),  S = H P^ H' + r I,  K = P^ H' S^-1,
//     j = Rot^-1 ((1, 0) + v) - z,
//     z+ = Rot (z + K_z j),  nu+ = (1 - epsilon) nu - epsilon omega - w + K_3 j,  P+ = Rot (P^ - K S K')
//     Rot^-1.
//
// The enclosure. {p(s) + e}: p polynomials in the start errors, e in a zonotope, which contains everything
// else. A step G maps it into {G(p(s), 0) + G_x e + G_v v + what rounding adds}, with derivatives over
// everything in between (mean value theorem).
#pragma once

#include <array>
#include <vector>

#include "checker/numbers/matrix3.hpp"
#include "checker/numbers/polynomial.hpp"

namespace veritrack::checker {

/// The tracker and what drives it.
struct Loop {
  Ball q1, q2, r, epsilon;
  Ball frequency;    ///< contains every omega, rad/sample; without effect when epsilon = 0
  Ball noise, slew;  ///< |v| <= noise, |w| <= slew, rad/sample per sample
  // For the effect of rounding: the true amplitude, signal units, and a bound on |omega|, rad/sample.
  Ball amplitude, largest_frequency;
};

/// All errors of the filtered estimate in these balls.
struct Starts {
  Ball amplitude, phase, frequency;  ///< |z| - 1; rad; rad/sample
};

/// Coordinates of the state.
enum Coordinate : std::size_t { kZ1, kZ2, kNu, kP11, kP12, kP13, kP22, kP23, kP33, kStateSize };
template <typename S>
using State = std::array<S, kStateSize>;

/// Turns the covariance by the angle that has this cosine and sine.
template <typename S>
void turn(State<S>& x, const S& cosine, const S& sine) {
  const S square_part = square(cosine) * (x[kP11] - x[kP22]);
  const S cross = cosine * sine;
  const S moved = square_part - two * (cross * x[kP12]);
  const S p12 = cross * (x[kP11] - x[kP22]) + (square(cosine) - square(sine)) * x[kP12];
  const S p11 = x[kP22] + moved;
  const S p13 = cosine * x[kP13] - sine * x[kP23];
  x[kP22] = x[kP11] - moved;
  x[kP23] = sine * x[kP13] + cosine * x[kP23];
  x[kP11] = p11;
  x[kP12] = p12;
  x[kP13] = p13;
}

/// One step; a template, as it runs on balls, on polynomials and on numbers with derivatives.
template <typename S>
State<S> step(const Loop& loop, const State<S>& x, const std::array<S, 2>& noise) {
  const Ball kept = one - loop.epsilon;
  const S& z1 = x[kZ1];
  const S& z2 = x[kZ2];
  // P^, whose third column without (1 - epsilon) is c, and S^-1.
  const S c1 = x[kP13] - z2 * x[kP33];
  const S c2 = x[kP23] + z1 * x[kP33];
  const S noise_variance = S(loop.q1 + loop.r);
  const S s11 = x[kP11] + noise_variance - z2 * (x[kP13] + c1);
  const S s12 = x[kP12] + z1 * c1 - z2 * x[kP23];
  const S s22 = x[kP22] + noise_variance + z1 * (x[kP23] + c2);
  const S over = reciprocal(s11 * s22 - square(s12));
  const S i11 = s22 * over;
  const S i12 = -(s12 * over);
  const S i22 = s11 * over;
  const S k31 = kept * (c1 * i11 + c2 * i12);
  const S k32 = kept * (c1 * i12 + c2 * i22);
  const S cosine = cos(x[kNu]);
  const S sine = sin(x[kNu]);
  const S y1 = S(one) + noise[0];
  const S j1 = cosine * y1 + sine * noise[1] - z1;
  const S j2 = cosine * noise[1] - sine * y1 - z2;
  // z + K_z j = Rot^-1 ((1, 0) + v) - r S^-1 j.
  const S w1 = loop.r * (i11 * j1 + i12 * j2);
  const S w2 = loop.r * (i12 * j1 + i22 * j2);
  State<S> next;
  next[kZ1] = y1 - (cosine * w1 - sine * w2);
  next[kZ2] = noise[1] - (sine * w1 + cosine * w2);
  next[kNu] = kept * x[kNu] - S(Ball(loop.epsilon * loop.frequency)) + k31 * j1 + k32 * j2;
  next[kP11] = S(loop.r) - square(loop.r) * i11;
  next[kP12] = -(square(loop.r) * i12);
  next[kP22] = S(loop.r) - square(loop.r) * i22;
  next[kP13] = loop.r * k31;
  next[kP23] = loop.r * k32;
  next[kP33] = square(kept) * x[kP33] + S(loop.q2) - kept * (k31 * c1 + k32 * c2);
  turn(next, cosine, sine);
  return next;
}

/// All states of an enclosure, relative to a point.
struct PolarEnclosure {
  std::array<Ball, 3> error;  ///< metric (e - origin), the phase error a value near that of the middle
  Matrix3 covariance;         ///< in the frame of the estimated phase
};

class FollowedStarts {
 public:
  /// Every start with P(0) in `covariance`, symmetric, in the frame of the estimated phase.
  FollowedStarts(const Loop& loop, const Starts& starts, const Matrix3& covariance);

  /// One sample on.
  void step();
  /// Contains x3 - omega of every state, rad/sample.
  [[nodiscard]] Ball frequency_error() const;
  /// The phase error is that in (-pi, pi], or near it. Balls of everything when the estimate may be zero.
  [[nodiscard]] PolarEnclosure polar(const Matrix3& metric, const std::array<Ball, 3>& origin) const;

 private:
  [[nodiscard]] State<Ball> radii() const;
  /// Moves everything that is not a polynomial with exact coefficients into the zonotope.
  void round();
  void add_box(const State<Ball>& radii);
  /// The deviation of the program from the exact step from here, by rounding.
  [[nodiscard]] State<Ball> rounding() const;
  void merge_smallest();

  Loop loop_;
  State<Polynomial> middle_;
  std::vector<State<Ball>> generators_;  ///< exact: {sum_j g_j t_j : |t_j| <= 1}
};

}  // namespace veritrack::checker

#include "checker/quadrature/lock_start.hpp"

#include <cmath>

#include "checker/quadrature/certified_set.hpp"

namespace veritrack::checker {

namespace {

constexpr int kCells = 256;

/// U X U', U = diag(Rot, 1).
Matrix3 turned(const Matrix3& x, const Ball& sine, const Ball& cosine) {
  Matrix3 u = diagonal(cosine, cosine, one);
  u[1][0] = sine;
  u[0][1] = -sine;
  return congruent(u, x);
}

/// A number s with x <= s d, near the least one that is not negative; a ball of everything when none is
/// found.
Ball level_above(const Matrix3& x, const Matrix3& d) {
  constexpr int kDoublings = 60;
  constexpr int kHalvings = 24;
  const auto is_above = [&](const Ball& s) { return definite(scaled(s, d) - x); };
  double high = 0x1p-20;
  for (int k = 0; !is_above(Ball(high)); ++k) {
    if (k == kDoublings) {
      return Ball::everything();
    }
    high *= 2.0;
  }
  double low = high == 0x1p-20 ? 0.0 : 0.5 * high;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (is_above(Ball(middle)) ? high : low) = middle;
  }
  return Ball(high);
}

/// An upper bound on |T e|^2 for these phase errors.
Ball largest_square(const LockSet& set, const LockStart& start, const Ball& sine, const Ball& cosine) {
  const Metric& t = set.metric;
  const std::array<Ball, 3>& bias = set.bias;
  Ball most;
  // Convex in the errors of amplitude and frequency: their ends decide.
  for (const double sign : {-1.0, 1.0}) {
    const Ball length = one + Ball(sign) * start.amplitude;
    const Ball e1 = length * cosine - one - bias[0];
    const Ball e2 = length * sine - bias[1];
    for (const double side : {-1.0, 1.0}) {
      const Ball e3 = Ball(side) * start.frequency - bias[2];
      const Ball squared =
          square(t.amplitude * e1) + square(t.phase * e2 + t.coupling * e3) + square(t.frequency * e3);
      most = max(most, squared).upper();
    }
  }
  return most;
}

}  // namespace

Ball start_level(const LockSet& set, const LockStart& start, const StartCovariance& covariance) {
  if (!certainly_not_negative(start.amplitude) || !certainly_not_negative(start.phase) ||
      !certainly_not_negative(start.frequency) || !definite(covariance.lowest)) {
    return Ball::everything();
  }
  const Matrix3 lowest_inverse = inverse(covariance.lowest);
  const Matrix3 centre = whole(set.centre);
  const Matrix3 centre_inverse = whole(inverse(set.centre));
  Ball most;
  for (int k = 0; k < kCells; ++k) {
    const auto node = [&](int i) { return Ball(2.0 * i / kCells - 1.0) * start.phase; };
    const Ball phase = Ball::hull(node(k), node(k + 1));
    const Ball sine = sin(phase);
    const Ball cosine = cos(phase);
    const Ball above = level_above(turned(covariance.highest, sine, cosine) - centre, whole(set.above));
    const Ball below = level_above(turned(lowest_inverse, sine, cosine) - centre_inverse, whole(set.below));
    const Ball level =
        half * (largest_square(set, start, sine, cosine) + set.weight * square(max(above, below)));
    // cannot bind (above, below): the maximum is not finite where they are not.
    if (!level.finite()) {
      return Ball::everything();
    }
    most = max(most, level).upper();
  }
  return most;
}

}  // namespace veritrack::checker

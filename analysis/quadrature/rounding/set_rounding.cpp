#include "analysis/quadrature/rounding/set_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

PolarDifference polar_difference(const StateDifference& difference, const Interval& least_z,
                                 const Interval& largest_zz, const Interval& largest_z3) {
  const Interval one(1.0);
  PolarDifference found;
  found.error.setConstant(Interval::empty());
  found.p_zz = found.p_z3 = found.p_33 = kInfinity;
  if (!is_finite(difference) || !certainly_positive(least_z)) {
    return found;
  }
  // Within the distance d of a z the phase changes by at most arcsin(d/|z|) <= t/sqrt(1 - t^2), t = d/|z|.
  const Interval z(difference.z);
  const Interval sine = z / least_z;
  const Interval turn = sine / rigor::sqrt(one - rigor::square(sine));
  // |U D U' - D| <= 2 |U - I| |D| for the block of z, |U - I| |D| for that beside it, |U - I| <= turn.
  const Interval zz = largest_zz + Interval(difference.p_zz);
  const Interval z3 = largest_z3 + Interval(difference.p_z3);
  found.error << rigor::symmetric(difference.z), rigor::symmetric(upper_or_infinite(turn)),
      rigor::symmetric(difference.frequency);
  found.p_zz = upper_or_infinite(Interval(difference.p_zz) + Interval(2.0) * turn * zz);
  found.p_z3 = upper_or_infinite(Interval(difference.p_z3) + turn * z3);
  found.p_33 = difference.p_33;
  return found;
}

double share_of(const IntervalMatrix<3>& p, const PolarDifference& difference) {
  // 2 |x_z||x_3| <= s |x_z|^2 + |x_3|^2/s, for any s.
  const Interval s(
      std::sqrt(std::max(rigor::midpoint(p(0, 0)), rigor::midpoint(p(1, 1))) / rigor::midpoint(p(2, 2))));
  const Interval beside(difference.p_z3);
  const Interval of_z = Interval(difference.p_zz) + s * beside;
  const Interval of_frequency = Interval(difference.p_33) + beside / s;
  if (!rigor::is_finite(of_z) || !rigor::is_finite(of_frequency)) {
    return kInfinity;
  }
  constexpr double kLeast = 0x1p-52;
  constexpr double kMost = 0x1p-8;
  for (double share = kLeast; share <= kMost; share *= 2.0) {
    IntervalMatrix<3> rest = Interval(share) * p;
    rest(0, 0) -= of_z;
    rest(1, 1) -= of_z;
    rest(2, 2) -= of_frequency;
    if (rigor::is_positive_definite(rest) == rigor::Verdict::proved) {
      return share;
    }
  }
  return kInfinity;
}

SetRounding set_rounding(const trackers::ToneModel<Interval>& design, const TrackedSignal& signal,
                         const CertifiedSet& set) {
  rigor::require_upward_rounding();
  const Interval one(1.0);
  const rigor::IntervalVector<3> reach = error_bounds(set, Interval(set.radius));
  const IntervalMatrix<3> lower = rigor::to_interval(set.covariance_lower);
  const IntervalMatrix<3> above = rigor::to_interval(set.covariance_upper);
  const double amplitude = upper_or_infinite(reach[0]);
  const Interval largest_frequency =
      Interval(signal.largest_frequency) + Interval(2 * kMostTurns) * rigor::pi() + reach[2];
  const StateDifference difference =
      step_rounding({design, signal.amplitude, upper_or_infinite(one + Interval(set.noise)),
                     upper_or_infinite(largest_frequency)},
                    {one + rigor::symmetric(amplitude), Interval(0.0), lower, above});
  const Interval largest_zz = rigor::max(above(0, 0), above(1, 1));
  const PolarDifference polar = polar_difference(difference, one - Interval(amplitude), largest_zz,
                                                 rigor::sqrt(largest_zz * above(2, 2)));
  return {upper_or_infinite(metric_norm(set, polar.error)), share_of(lower, polar)};
}

}  // namespace veritrack::quadrature

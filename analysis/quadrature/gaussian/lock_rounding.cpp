#include "analysis/quadrature/gaussian/lock_rounding.hpp"

#include "analysis/quadrature/rounding/set_rounding.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;

bool certainly_definite(const IntervalMatrix<3>& p) {
  return rigor::is_positive_definite(p) == rigor::Verdict::proved;
}

}  // namespace

LockRounding lock_rounding(const trackers::ToneModel<Interval>& design, const TrackedSignal& signal,
                           const LockSet& set, const Interval& samples) {
  rigor::require_upward_rounding();
  const Interval one(1.0);
  const Interval two(2.0);
  const BlockMetric<double>& t = set.metric;
  const Interval twice(two * Interval(set.level));
  const Interval radius = rigor::sqrt(twice);
  // Errors with |T e| <= radius: the second row of T^-1 is (0, 1/phase, -coupling/(phase frequency)).
  const Interval amplitude = radius / Interval(t.amplitude);
  const Interval phase = radius / Interval(t.phase) *
                         rigor::sqrt(one + rigor::square(Interval(t.coupling) / Interval(t.frequency)));
  const Interval frequency = radius / Interval(t.frequency);
  const Interval most(kMostDeviations);
  const Interval held_frequency = Interval(signal.largest_frequency) + abs(Interval(set.bias[2])) +
                                  frequency + most * Interval(set.frequency_walk) * rigor::sqrt(samples);
  const Interval measurement = one + most * rigor::sqrt(two) * Interval(set.noise_deviation);
  const Interval weight(set.weight);
  const Interval largest = rigor::sqrt(twice / weight);
  const StateDifference difference = step_rounding(
      {design, signal.amplitude, upper_or_infinite(measurement), upper_or_infinite(held_frequency)},
      {one + Interval(set.bias[0]) + rigor::symmetric(upper_or_infinite(amplitude)),
       Interval(set.bias[1]) + rigor::symmetric(upper_or_infinite(phase)),
       lower_covariance(set, Interval(largest.upper())), upper_covariance(set, Interval(largest.upper()))});
  LockRounding found;
  const Interval z(difference.z);
  const Interval nu(difference.frequency);
  const Interval along = max(Interval(t.amplitude), Interval(t.phase)) * z + abs(Interval(t.coupling)) * nu;
  found.error =
      upper_or_infinite(rigor::sqrt(rigor::square(along) + rigor::square(Interval(t.frequency) * nu)));
  // An image whose level t is larger leaves nothing of the inequality: gamma t^2 < 2 L + 2 log(1 + c_0).
  const Interval most_level(
      rigor::sqrt((twice + two * rigor::log(one + Interval(set.drift))) / weight).upper());
  const IntervalMatrix<3> least = lower_covariance(set, most_level);
  PolarDifference blocks;
  blocks.p_zz = difference.p_zz;
  blocks.p_z3 = difference.p_z3;
  blocks.p_33 = difference.p_33;
  found.covariance = share_of(least, blocks);
  const Interval room(kRoundingRoom);
  const Interval share(found.covariance);
  // mu hi(t) <= eta D_h, and mu/(1 - mu) lo(t)^-1 <= eta D_l: multiplied by lo(t) on both sides, mu/(1 - mu)
  // lo(t) <= eta lo(t) D_l lo(t).
  found.has_room =
      is_finite(difference) && certainly_less_equal(Interval(found.error), room) &&
      certainly_less(share, one) &&
      certainly_definite(room * enclosed(set.spread_above) - share * upper_covariance(set, most_level)) &&
      certainly_definite(room * IntervalMatrix<3>(least * enclosed(set.spread_below) * least) -
                         share / (one - share) * least);
  return found;
}

Interval probability_beyond(const Interval& samples) {
  const Interval exponent = rigor::square(Interval(kMostDeviations)) / Interval(2.0);
  return (Interval(4.0) * samples + Interval(2.0)) * rigor::exp(-exponent);
}

}  // namespace veritrack::quadrature

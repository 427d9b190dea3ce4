#include "analysis/quadrature/rounding/steady_rounding.hpp"

#include <algorithm>

#include "analysis/quadrature/rounding/set_rounding.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;

SteadyRounding steady_rounding(const trackers::ToneModel<Interval>& design, const TrackedSignal& signal,
                               const std::vector<sets::BranchCell>& branch, const SteadySet& set) {
  // There are many cells, and little hangs on a tight bound.
  constexpr Pieces kPieces{1, 4, 2, 16};
  rigor::require_upward_rounding();
  const Interval one(1.0);
  const rigor::IntervalVector<3> reach = error_bounds(set, one);
  const IntervalMatrix<3> below = rigor::to_interval(set.below);
  const IntervalMatrix<3> above = rigor::to_interval(set.above);
  StateDifference worst;
  Interval least_z(1e300);
  Interval largest_zz(0.0);
  Interval largest_33(0.0);
  for (const sets::BranchCell& tube : branch) {
    const auto x = tube.box();
    IntervalMatrix<3> steady;
    steady << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
    const IntervalMatrix<3> lower = steady - below;
    const IntervalMatrix<3> upper = steady + above;
    const Interval z = one + x[0] + rigor::symmetric(upper_or_infinite(reach[0]));
    const Interval frequency = Interval(signal.largest_frequency) + rigor::abs(x[2]) + reach[2];
    const Interval measurement = one + Interval(set.noise);
    worst = larger(worst, step_rounding({design, signal.amplitude, upper_or_infinite(measurement),
                                         upper_or_infinite(frequency)},
                                        {z, Interval(0.0), lower, upper}, kPieces));
    least_z = rigor::min(least_z, z);
    largest_zz = rigor::max(largest_zz, upper(0, 0) + upper(1, 1));
    largest_33 = rigor::max(largest_33, upper(2, 2));
  }
  const PolarDifference polar =
      polar_difference(worst, Interval(least_z.lower()), largest_zz, rigor::sqrt(largest_zz * largest_33));
  return {Interval(upper_or_infinite(metric_norm(set, polar.error))),
          Interval(std::max(share_of(below, polar), share_of(above, polar)))};
}

}  // namespace veritrack::quadrature

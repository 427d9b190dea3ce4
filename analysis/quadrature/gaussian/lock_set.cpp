#include "analysis/quadrature/gaussian/lock_set.hpp"

#include "analysis/quadrature/gaussian/level_step.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;

namespace {

IntervalMatrix<3> whole_matrix(const LevelCovariance<Interval>& p) {
  IntervalMatrix<3> matrix;
  matrix << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return matrix;
}

}  // namespace

IntervalMatrix<3> enclosed(const LevelCovariance<double>& p) {
  return whole_matrix(level_covariance<Interval>(p));
}

IntervalMatrix<3> upper_covariance(const LockSet& set, const Interval& s) {
  return whole_matrix(
      moved(level_covariance<Interval>(set.centre), s, level_covariance<Interval>(set.spread_above)));
}

IntervalMatrix<3> lower_covariance(const LockSet& set, const Interval& s) {
  return whole_matrix(inverse(moved(inverse(level_covariance<Interval>(set.centre)), s,
                                    level_covariance<Interval>(set.spread_below))));
}

Interval largest_frequency_error(const LockSet& set) {
  return abs(Interval(set.bias[2])) +
         rigor::sqrt(Interval(2.0) * Interval(set.level)) / Interval(set.metric.frequency);
}

}  // namespace veritrack::quadrature

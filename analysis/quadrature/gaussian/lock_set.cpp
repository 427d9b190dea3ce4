#include "analysis/quadrature/gaussian/lock_set.hpp"

#include "analysis/quadrature/gaussian/level_step.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;

namespace {

BlockCovariance<Interval> enclosed_block(const BlockCovariance<double>& p) {
  return {Interval(p.p11), Interval(p.p22), Interval(p.p23), Interval(p.p33)};
}

IntervalMatrix<3> whole_matrix(const BlockCovariance<Interval>& p) {
  IntervalMatrix<3> matrix;
  const Interval none(0.0);
  matrix << p.p11, none, none, none, p.p22, p.p23, none, p.p23, p.p33;
  return matrix;
}

}  // namespace

IntervalMatrix<3> enclosed(const BlockCovariance<double>& p) {
  return whole_matrix(enclosed_block(p));
}

IntervalMatrix<3> upper_covariance(const LockSet& set, const Interval& s) {
  return whole_matrix(moved(enclosed_block(set.centre), s, enclosed_block(set.spread_above)));
}

IntervalMatrix<3> lower_covariance(const LockSet& set, const Interval& s) {
  return whole_matrix(
      inverse(moved(inverse(enclosed_block(set.centre)), s, enclosed_block(set.spread_below))));
}

Interval largest_frequency_error(const LockSet& set) {
  return abs(Interval(set.bias[2])) +
         rigor::sqrt(Interval(2.0) * Interval(set.level)) / Interval(set.metric.frequency);
}

}  // namespace veritrack::quadrature

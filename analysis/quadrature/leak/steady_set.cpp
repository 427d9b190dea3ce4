#include "analysis/quadrature/leak/steady_set.hpp"

#include "analysis/rigor/linear_solve.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalVector;

Interval metric_norm(const SteadySet& set, const IntervalVector<3>& error) {
  const IntervalVector<3> image = rigor::to_interval(set.metric) * error;
  return sqrt(square(image[0]) + square(image[1]) + square(image[2]));
}

IntervalVector<3> error_bounds(const SteadySet& set, const Interval& level) {
  const auto inverse = rigor::inverse(rigor::to_interval(set.metric));
  IntervalVector<3> bounds;
  for (int i = 0; i < 3 && inverse; ++i) {
    bounds[i] = level * sqrt(square((*inverse)(i, 0)) + square((*inverse)(i, 1)) + square((*inverse)(i, 2)));
  }
  return bounds;
}

Symmetric<Interval> to_symmetric(const rigor::Matrix<3>& p) {
  return {Interval(p(0, 0)), Interval(p(0, 1)), Interval(p(0, 2)),
          Interval(p(1, 1)), Interval(p(1, 2)), Interval(p(2, 2))};
}

}  // namespace veritrack::quadrature

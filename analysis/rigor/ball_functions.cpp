// Functions of ball models: a Taylor polynomial at the constant term and Lagrange's remainder.
#include <limits>

#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/taylor_coefficients.hpp"

namespace veritrack::rigor {

namespace {

BallModel nothing_known() {
  return BallModel(std::numeric_limits<double>::quiet_NaN());
}

/// f(x) = sum_{k <= 4} f^(k)(c)/k! (x - c)^k + f^(5)(t)/5! (x - c)^5, t between c and x.
BallModel composed(TaylorCoefficients (*coefficients)(const Interval&), const BallModel& x) {
  const Interval range = x.range();
  if (is_empty(range)) {
    return nothing_known();
  }
  const TaylorCoefficients at_constant = coefficients(Interval(x.constant()));
  const Interval last = coefficients(range).back();
  for (const Interval& coefficient : at_constant) {
    if (!is_finite(coefficient)) {
      return nothing_known();
    }
  }
  if (!is_finite(last)) {
    return nothing_known();
  }
  const Interval deviation(x.deviation());
  const BallModel rest = x.without_constant();
  BallModel result(at_constant[4]);
  for (std::size_t k = 4; k-- > 0;) {
    result = result * rest + BallModel(at_constant[k]);
  }
  return result.widened((abs(last) * pow(deviation, 5)).upper());
}

}  // namespace

BallModel operator/(const BallModel& a, const BallModel& b) {
  return a * composed(taylor_of_reciprocal, b);
}
BallModel sqrt(const BallModel& x) {
  return composed(taylor_of_sqrt, x);
}
BallModel exp(const BallModel& x) {
  return composed(taylor_of_exp, x);
}
BallModel log(const BallModel& x) {
  return composed(taylor_of_log, x);
}
BallModel sin(const BallModel& x) {
  return composed(taylor_of_sin, x);
}
BallModel cos(const BallModel& x) {
  return composed(taylor_of_cos, x);
}
BallModel tan(const BallModel& x) {
  return composed(taylor_of_tan, x);
}
BallModel asin(const BallModel& x) {
  return composed(taylor_of_asin, x);
}
BallModel acos(const BallModel& x) {
  return composed(taylor_of_acos, x);
}
BallModel atan(const BallModel& x) {
  return composed(taylor_of_atan, x);
}

/// The angle of the constants, and from there the angle to the rest, which is below a right one: with (a, b)
/// = (x, y) turned back by it, a > 0.
BallModel atan2(const BallModel& y, const BallModel& x) {
  const BallModel x0(x.constant());
  const BallModel y0(y.constant());
  const BallModel along = x * x0 + y * y0;
  const BallModel across = y * x0 - x * y0;
  const Interval angle = atan2(Interval(y.constant()), Interval(x.constant()));
  const Interval ranges = atan2(y.range(), x.range());
  if (!certainly_positive(along.range()) || is_empty(angle) || is_empty(ranges)) {
    return nothing_known();
  }
  return BallModel(angle) + atan(across / along);
}

BallModel stays_within(const BallModel& x, const BallModel& low, const BallModel& high) {
  const bool is_shown = certainly_positive((x - low).range()) && certainly_positive((high - x).range());
  return is_shown ? x : nothing_known();
}

}  // namespace veritrack::rigor

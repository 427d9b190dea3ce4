#include "analysis/sets/state_difference.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::sets {

using rigor::Interval;
using rigor::Rounded;

namespace {

Interval largest_exact(const Rounded& x) {
  return Interval(rigor::magnitude(x.exact()));
}

Interval error_of(const Rounded& x) {
  return Interval(x.error());
}

}  // namespace

StateDifference larger(const StateDifference& a, const StateDifference& b) {
  return {std::max(a.z, b.z), std::max(a.frequency, b.frequency), std::max(a.p_zz, b.p_zz),
          std::max(a.p_z3, b.p_z3), std::max(a.p_33, b.p_33)};
}

bool is_finite(const StateDifference& difference) {
  return std::isfinite(difference.z) && std::isfinite(difference.frequency) &&
         std::isfinite(difference.p_zz) && std::isfinite(difference.p_z3) && std::isfinite(difference.p_33);
}

StateDifference difference_of(const trackers::ToneEstimate<Rounded>& after) {
  const auto& p = after.covariance;
  const Interval d_error = error_of(p.frequency_variance);
  const Interval d = largest_exact(p.frequency_variance);
  const Interval u = rigor::sqrt(rigor::square(largest_exact(p.regression_1)) +
                                 rigor::square(largest_exact(p.regression_2)));
  const Interval u_error =
      rigor::sqrt(rigor::square(error_of(p.regression_1)) + rigor::square(error_of(p.regression_2)));
  // A symmetric 2x2 matrix has at most the norm of its entries' root of squares.
  const Interval m_error =
      rigor::sqrt(rigor::square(error_of(p.conditional_11)) + rigor::square(error_of(p.conditional_22)) +
                  Interval(2.0) * rigor::square(error_of(p.conditional_12)));
  const Interval computed_u = u + u_error;
  return {upper_or_infinite(rigor::sqrt(rigor::square(error_of(after.in_phase)) +
                                        rigor::square(error_of(after.quadrature)))),
          upper_or_infinite(error_of(after.frequency)),
          upper_or_infinite(m_error + d_error * rigor::square(computed_u) + d * u_error * (u + computed_u)),
          upper_or_infinite(d_error * computed_u + d * u_error), upper_or_infinite(d_error)};
}

}  // namespace veritrack::sets

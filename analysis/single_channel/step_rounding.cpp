#include "analysis/single_channel/step_rounding.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounded.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::single_channel {

using rigor::Interval;
using rigor::Rounded;
using sets::StateDifference;

namespace {

using RoundedEstimate = trackers::SingleChannelEstimate<Rounded>;

/// Every component of a vector of at most that length.
Interval component(const Interval& length) {
  return rigor::symmetric(sets::upper_or_infinite(length));
}

/// x, whose exact value is known to lie in that interval, too.
Rounded known(const Rounded& x, const Interval& range) {
  return {intersection(x.exact(), range), x.error()};
}

/// Number `index` of `count` parts of x, which cover it; of equal ratios where x is positive.
Interval part(const Interval& x, int index, int count) {
  const auto cut = [&](int i) {
    const double share = static_cast<double>(i) / count;
    const double between = x.lower() > 0.0 ? x.lower() * std::pow(x.upper() / x.lower(), share)
                                           : x.lower() + share * (x.upper() - x.lower());
    return i == 0 ? x.lower() : i == count ? x.upper() : std::clamp(between, x.lower(), x.upper());
  };
  return Interval::from_bounds(cut(index), cut(index + 1));
}

/// The known bounds of the exact prediction, in any orientation.
struct Prediction {
  Interval eigenvalues, u, d;
};
Prediction prediction_of(const trackers::ToneModel<Interval>& design, const HeldStates& states,
                         const Interval& d) {
  // The prediction's M is the turned M, q1 I and q2 d/(d + q2) h h', its u is d/(d + q2) h; h = u + Jz.
  const Interval h = states.u + states.z;
  const Interval most(d.upper());
  const Interval share = most / (most + design.q2);
  const Interval highest = Interval(states.eigenvalues.upper()) + design.q1 + design.q2 * share * square(h);
  const Interval lowest = Interval(states.eigenvalues.lower()) + design.q1;
  return {Interval::from_bounds(lowest.lower(), sets::upper_or_infinite(highest)), share * h, d + design.q2};
}

/// The prediction from all states, with its rounding.
RoundedEstimate predicted(const trackers::SingleChannelEkfDesign<Rounded>& design,
                          const sets::Program& program, const HeldStates& states, const Interval& d) {
  const Rounded z(component(states.z));
  const Rounded u(component(states.u));
  const Rounded diagonal(states.eigenvalues);
  // In any orientation an entry beside the diagonal is at most half the difference of the eigenvalues.
  const Rounded beside(component(Interval(0.5) * Interval(rigor::width(states.eigenvalues))));
  return trackers::time_update(RoundedEstimate{z,
                                               z,
                                               Rounded(component(Interval(program.largest_frequency))),
                                               {diagonal, beside, diagonal, u, u, Rounded(d)}},
                               design);
}

}  // namespace

StateDifference step_difference(const sets::Program& program, const HeldStates& states) {
  constexpr int kVariances = 3;     // parts of d
  constexpr int kDiagonals = 16;    // of M_11 of the prediction
  constexpr int kRegressions = 12;  // of u_1 of the prediction
  rigor::require_upward_rounding();
  const auto& model = program.design;
  const bool in_range = certainly_less_equal(Interval(Rounded::kSmallestUnit), program.amplitude) &&
                        certainly_less_equal(program.amplitude, Interval(Rounded::kLargestUnit)) &&
                        certainly_positive(states.d) &&
                        certainly_less_equal(Interval(0.0), states.eigenvalues) &&
                        certainly_less_equal(Interval(0.0), model.q1) && certainly_positive(model.q2) &&
                        certainly_positive(model.r);
  if (!in_range) {
    constexpr double kUnknown = kUnboundedRounding.error;
    return {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  }
  const trackers::SingleChannelEkfDesign<Rounded> design{
      trackers::diagonal_process_noise(Rounded(model.q1), Rounded(model.q2)), Rounded(model.r),
      Rounded(model.epsilon)};
  const Rounded measurement(component(Interval(program.largest_measurement)));
  StateDifference all;
  for (int i = 0; i < kVariances; ++i) {
    const Interval d = part(states.d, i, kVariances);
    RoundedEstimate before = predicted(design, program, states, d);
    const auto p = before.covariance;
    const Prediction limits = prediction_of(model, states, d);
    const Interval half_width = Interval(0.5) * Interval(rigor::width(limits.eigenvalues));
    before.in_phase = known(before.in_phase, component(states.z));
    before.quadrature = known(before.quadrature, component(states.z));
    before.covariance.frequency_variance = known(p.frequency_variance, limits.d);
    before.covariance.conditional_22 = known(p.conditional_22, limits.eigenvalues);
    before.covariance.regression_2 = known(p.regression_2, component(limits.u));
    for (int j = 0; j < kDiagonals * kRegressions; ++j) {
      const Interval m11 = part(limits.eigenvalues, j % kDiagonals, kDiagonals);
      // |M_12|^2 <= M_11 M_22.
      const Interval beside = rigor::min(half_width, sqrt(m11 * Interval(limits.eigenvalues.upper())));
      before.covariance.conditional_11 = known(p.conditional_11, m11);
      before.covariance.conditional_12 = known(p.conditional_12, component(beside));
      before.covariance.regression_1 =
          known(p.regression_1, part(component(limits.u), j / kDiagonals, kRegressions));
      all = sets::larger(all, sets::difference_of(trackers::measurement_update(before, measurement, design)));
    }
  }
  return all;
}

Interval filtered_floor(const trackers::ToneModel<Interval>& design) {
  return design.q1 * design.r / (design.q1 + design.r);
}

StepRounding in_metric(const trackers::ToneModel<Interval>& design, const StateDifference& difference) {
  rigor::require_upward_rounding();
  const Interval floor = filtered_floor(design);
  // cannot bind (floor, design.q2): a quotient by zero is no number, and designs are not negative.
  if (!sets::is_finite(difference) || !certainly_positive(floor) || !certainly_positive(design.q2)) {
    return kUnboundedRounding;
  }
  // 2 |x_z| |x_3| <= s |x_z|^2 + |x_3|^2 / s.
  const Interval s = sqrt(floor / design.q2);
  const Interval beside(difference.p_z3);
  const Interval share = rigor::max((Interval(difference.p_zz) + s * beside) / floor,
                                    (Interval(difference.p_33) + beside / s) / design.q2);
  const Interval level =
      sqrt((square(Interval(difference.z)) / floor + square(Interval(difference.frequency)) / design.q2) /
           (Interval(1.0) - share));
  return {sets::upper_or_infinite(level), sets::upper_or_infinite(share)};
}

}  // namespace veritrack::single_channel

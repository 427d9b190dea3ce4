#include "analysis/single_channel/covariance_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace veritrack::single_channel {

using rigor::Interval;

Interval disturbance(const WindowAssumption& assumption, const PhaseCovariance<Interval>& bound) {
  const Interval zero(0.0);
  // What is assumed of every covariance holds too, and where the bound is not finite it is all there is.
  const auto at_most = [&](const Interval& value, double assumed) {
    const Interval limit(assumed);
    return is_finite(value) ? min(max(value, zero), limit) : limit;
  };
  const Interval half(0.5);
  const Interval largest =
      half * (bound.p11 + bound.p22) + sqrt(square(half * (bound.p11 - bound.p22)) + square(bound.p12));
  const Interval radius(assumption.radius);
  const Interval frequency = sqrt(Interval(assumption.frequency_variance));
  const Interval signal = sqrt(Interval(assumption.signal_variance));
  return square(radius * (frequency * sqrt(at_most(largest, assumption.signal_variance)) +
                          (signal + frequency) * sqrt(at_most(bound.p33, assumption.frequency_variance))));
}

namespace detail {

double phase_drift(int samples, double slew) {
  const int n = std::abs(samples);
  return (Interval(slew) * Interval(0.5 * n * (n + 1))).upper();
}

PhaseCovariance<OverPhaseAndFrequency> without_remainder(const PhaseCovariance<OverPhaseAndFrequency>& p,
                                                         double sign, double /*drift*/) {
  using Model = OverPhaseAndFrequency;
  const auto cleared = [&](const Model& entry, const Model& a, const Model& b, const Model& c) {
    const Interval row = Interval(a.remainder()) + Interval(b.remainder()) + Interval(c.remainder());
    return entry.polynomial() + Model(Interval(sign) * Interval(row.upper()));
  };
  return {cleared(p.p11, p.p11, p.p12, p.p13), p.p12.polynomial(), p.p13.polynomial(),
          cleared(p.p22, p.p12, p.p22, p.p23), p.p23.polynomial(), cleared(p.p33, p.p13, p.p23, p.p33)};
}

PhaseCovariance<double> without_remainder(const PhaseCovariance<double>& p, double sign, double drift) {
  constexpr double kTruncation = 4e-4;
  constexpr double kPerRadian = 4.0;
  const double share = sign * (kTruncation + kPerRadian * drift);
  const double a12 = std::fabs(p.p12);
  const double a13 = std::fabs(p.p13);
  const double a23 = std::fabs(p.p23);
  return {p.p11 + share * (p.p11 + a12 + a13), p.p12, p.p13,
          p.p22 + share * (p.p22 + a12 + a23), p.p23, p.p33 + share * (p.p33 + a13 + a23)};
}

OverPhaseAndFrequency advanced(const OverPhaseAndFrequency& phase, const OverPhaseAndFrequency& frequency,
                               int samples, double drift) {
  return phase + OverPhaseAndFrequency(static_cast<double>(samples)) * frequency +
         OverPhaseAndFrequency(rigor::symmetric(drift));
}

}  // namespace detail

}  // namespace veritrack::single_channel

#include "analysis/single_channel/window_rounding.hpp"

#include "analysis/rigor/elementary.hpp"

namespace veritrack::single_channel {

using rigor::Interval;

namespace {

/// Everything from `low` to `high`; empty when they are not in order.
Interval from_to(const Interval& low, const Interval& high) {
  return Interval::from_bounds(low.lower(), high.upper());
}

/// The covariances above (1 - kMostCovariance) diag(floor, floor, q2) of the assumption.
HeldStates after_a_step(const trackers::ToneModel<Interval>& design, const WindowAssumption& assumption,
                        const Interval& z) {
  const Interval kept = Interval(1.0) - Interval(StepRounding::kMostCovariance);
  const Interval signal(assumption.signal_variance);
  const Interval lowest = kept * design.q2;
  // |d u|^2 = |P_z3|^2 <= |P_zz| d.
  return {z, from_to(kept * filtered_floor(design), signal), sqrt(signal / lowest),
          from_to(lowest, Interval(assumption.frequency_variance))};
}

/// M is monotone in P, and |(P - lowest)_z3|^2 <= |(P - lowest)_zz| (P - lowest)_33.
HeldStates at_the_start(const StartRange& start, const Interval& z) {
  const Interval none(0.0);
  const Interval room = rigor::max(start.highest.signal - start.lowest.signal, none) *
                        rigor::max(start.highest.frequency - start.lowest.frequency, none);
  return {z, from_to(start.lowest.signal, start.highest.signal), sqrt(room) / start.lowest.frequency,
          from_to(start.lowest.frequency, start.highest.frequency)};
}

}  // namespace

StepRounding window_rounding(const trackers::ToneModel<Interval>& design, const TrackedSignal& signal,
                             const WindowAssumption& assumption, const std::optional<StartRange>& start) {
  rigor::require_upward_rounding();
  const Interval one(1.0);
  const Interval radius(assumption.radius);
  const Interval z = one + radius * sqrt(Interval(assumption.signal_variance));
  const Interval frequency =
      Interval(rigor::magnitude(signal.band)) + radius * sqrt(Interval(assumption.frequency_variance));
  const Interval measurement = one + signal.noise;
  if (!rigor::is_finite(z) || !rigor::is_finite(frequency) || !rigor::is_finite(measurement)) {
    return kUnboundedRounding;
  }
  const sets::Program program{design, signal.amplitude, measurement.upper(), frequency.upper()};
  sets::StateDifference difference = step_difference(program, after_a_step(design, assumption, z));
  if (start) {
    difference = sets::larger(difference, step_difference(program, at_the_start(*start, z)));
  }
  return in_metric(design, difference);
}

}  // namespace veritrack::single_channel

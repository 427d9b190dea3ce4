#include "analysis/single_channel/set_rounding.hpp"

namespace veritrack::single_channel {

using rigor::Interval;

namespace {

TrackedSignal signal_of(const PhaseQuestion& question, const Interval& noise) {
  return {question.tracker.amplitude, question.band, noise};
}

StepRounding with_room(const StepRounding& rounding) {
  constexpr double kRoom = 16.0;
  return {(Interval(kRoom) * Interval(rounding.error)).upper(),
          (Interval(kRoom) * Interval(rounding.covariance)).upper()};
}

}  // namespace

StepRounding allowed_rounding(const PhaseQuestion& question, const WindowClaim& claim,
                              const Interval& noise) {
  return with_room(window_rounding(question.tracker.design, signal_of(question, noise), claim.assumption));
}

bool covers_start(const PhaseQuestion& question, const PhaseSet& set) {
  const DiagonalStart& start = set.start.value();
  const Interval& amplitude = question.tracker.amplitude;
  const StepRounding rounding = with_room(
      window_rounding(question.tracker.design, signal_of(question, set.noise), set.claim.assumption,
                      StartRange{start.times(start.from, amplitude), start.times(start.to, amplitude)}));
  const StepRounding& allowed = set.claim.assumption.rounding;
  return rounding.is_bounded() && rounding.error <= allowed.error &&
         rounding.covariance <= allowed.covariance;
}

}  // namespace veritrack::single_channel

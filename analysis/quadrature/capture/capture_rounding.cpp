#include "analysis/quadrature/capture/capture_rounding.hpp"

#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "trackers/rotating_frame.hpp"

namespace veritrack::quadrature {

using rigor::Interval;

StateVector followed_rounding(const CaptureProblem& problem, const StateBox& states) {
  constexpr Pieces kPieces{1, 2, 1, 16};
  rigor::IntervalMatrix<3> p;
  p << states[trackers::kP11], states[trackers::kP12], states[trackers::kP13],  //
      states[trackers::kP12], states[trackers::kP22], states[trackers::kP23],   //
      states[trackers::kP13], states[trackers::kP23], states[trackers::kP33];
  const Interval measurement = Interval(1.0) + Interval(problem.noise);
  const Interval frequency =
      Interval(problem.signal.largest_frequency) + rigor::abs(states[trackers::kFrequencyError]);
  const StateDifference added = step_rounding(
      {problem.design, problem.signal.amplitude, upper_or_infinite(measurement),
       upper_or_infinite(frequency)},
      {Interval(1.0) + states[trackers::kDeltaInPhase], states[trackers::kDeltaQuadrature], p, p}, kPieces);
  StateVector radii;
  radii << added.z, added.z, added.frequency, added.p_zz, added.p_zz, added.p_z3, added.p_zz, added.p_z3,
      added.p_33;
  return radii;
}

}  // namespace veritrack::quadrature

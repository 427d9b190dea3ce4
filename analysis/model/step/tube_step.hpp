// One step of a tracker in the coordinates of a tube, over a cell of phases and frequencies.
//
// With the tube C(phi, omega) + U(phi, omega) xi, the step from phi to phi + omega is
//   F(xi, v) = U(phi + omega, omega)^-1 [G(C(phi, omega) + U(phi, omega) xi, Y(phi + omega) + v) - C(phi +
//   omega, omega)],
// an identity of the recursion G. If |F| <= R for all |xi| <= R and |v| <= V, for all phases and frequencies,
// the tube of radius R is never left (docs/model-proof.md). When the frequency moves by W zeta, |zeta| <= 1,
// the next place is (phi + omega, omega + W zeta) in place of (phi + omega, omega).
#pragma once

#include <string>
#include <vector>

#include "analysis/model/step/program_rounding.hpp"
#include "analysis/model/step/tube.hpp"
#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/piecewise.hpp"
#include "trackers/model/filter_parts.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::model {

/// The tracker and its signal, in numbers that can be trusted.
struct TrackerModel {
  const trackers::Recursion* recursion = nullptr;
  const trackers::StraightLineProgram* signal = nullptr;  ///< inputs: constants, amplitude, phase
  std::vector<rigor::Interval> constants;
  rigor::Interval amplitude;      ///< of each sample
  bool amplitude_varies = false;  ///< from sample to sample, in that range; otherwise it is constant
  /// The parts of an extended Kalman filter, if it can be decomposed: for tubes that bound the covariance.
  const trackers::FilterParts* filter = nullptr;
  /// Of the program that runs, for gains over the phase; none: exact arithmetic.
  const ProgramRounding* rounding = nullptr;
};

class PlaceStore;

/// A part of a tube: phases 2 pi (turn - half_turn) to 2 pi (turn + half_turn), and z - half_z to z + half_z
/// of the frequencies of the tube. Dyadic numbers, so that parts fit together exactly.
struct TubeCell {
  double turn = 0.5;
  double half_turn = 0.5;
  double z = 0.0;
  double half_z = 1.0;
};

/// Bounds over a cell.
struct StepBounds {
  /// Bounds of |F| for |xi| <= scale radius, one for each requested scale; not finite when nothing is known.
  std::vector<double> steps;
  /// Contains h(C + U xi) - omega, |xi| <= radius, rad/sample; empty when nothing is known.
  rigor::Interval frequency_error;
  /// The shares of the first bound from the width of the cell in phase, and in frequency: they show which to
  /// halve. Not evidence.
  double by_phase = 0.0;
  double by_frequency = 0.0;
};

/// Whether samples may differ from a signal of one amplitude: there is noise, or the amplitude varies.
[[nodiscard]] inline bool is_disturbed(const TrackerModel& model, double noise) {
  return noise > 0.0 || model.amplitude_varies;
}

/// F over a cell, as ball models in xi/radius and the disturbances: v/noise, and then zeta. Where the
/// amplitude varies, v is the noise together with its effect on the samples.
struct StepOver {
  std::vector<rigor::BallModel> deviation;  ///< F
  rigor::Interval frequency_error;          ///< of h(C + U xi) - omega; empty when nothing is known
  bool is_known = false;                    ///< the shape is valid, here and there
};

/// For |xi| <= radius, |v| <= noise stretch and a slew up to slew stretch. Needs the upward rounding mode,
/// and a scope of ball models with as many components as there are states, and disturbances as there are
/// samples (where they are disturbed) and one more (slew > 0). `store`: of this model and tube, or none.
/// Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] StepOver step_over(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                                 double radius, double noise, double slew = 0.0, double stretch = 1.0,
                                 PlaceStore* store = nullptr);

/// The bounds for |xi| <= scale radius, for each of the scales, in (0, 1], |v| <= noise (the length of
/// the error of all samples, signal units), and a frequency that moves by at most `slew` (rad/sample per
/// sample) from this sample to the next. Sets its own rounding mode. Throws std::invalid_argument when sizes
/// do not fit.
[[nodiscard]] StepBounds bound_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                                    double radius, double noise, const std::vector<double>& scales,
                                    double slew = 0.0, PlaceStore* store = nullptr);

}  // namespace veritrack::model

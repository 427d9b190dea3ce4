// Capture: verified propagation of a set of starts until all of it lies in an invariant set.
//
// Beyond the certified set the step need not contract, but a computer can follow starts. A box of starts is
// described by polynomials (Taylor models) in the start errors, so that the exact dependence of the state on
// the start is followed to high order, and by a zonotope that contains the rest: rounding, higher-order
// terms, intervals of the design, noise. One step of the closed loop X+ = G(X, d) takes the set {p(s) + e}
// into
//     {G(p(s), 0) + G_X e + G_d d + what rounding does},
// the first evaluated with Taylor models, the derivatives enclosed over a box that holds all states concerned
// (mean value theorem: the segment from (p(s), 0) to (p(s) + e, d) lies in it).
#pragma once

#include <string_view>
#include <vector>

#include "analysis/quadrature/capture/capture_target.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The starts: filtered estimates (k|k) whose errors lie in these intervals.
struct StartBox {
  rigor::Interval amplitude_error;  ///< |z| - 1, relative to the true amplitude; above -1
  rigor::Interval phase_error;      ///< rad
  rigor::Interval frequency_error;  ///< rad/sample
};

/// The closed loop, at amplitude 1 (trackers/tone_model.hpp: at_unit_amplitude).
struct CaptureProblem {
  trackers::ToneModel<rigor::Interval> design;
  /// P(0|0) in the frame of the estimated phase (amplitude, phase, frequency): the same for every start.
  /// Symmetric; the upper triangle is read.
  rigor::IntervalMatrix<3> initial_covariance;
  rigor::Interval frequency = rigor::Interval(0.0);  ///< holds every omega(k); without effect for epsilon = 0
  double noise = 0.0;                                ///< |v(k)| <= noise, relative to the amplitude
  double slew = 0.0;                                 ///< |omega(k+1) - omega(k)| <= slew, rad/sample
  int most_samples = 400;                            ///< give up after so many
  TrackedSignal signal = {};                         ///< for the rounding of the program
};

/// How the propagation of a box of starts ended.
enum class CaptureOutcome {
  enclosure_lost,   ///< the set could not be enclosed any longer: nothing is known of its starts
  out_of_samples,   ///< still outside after most_samples: nothing is known
  locked,           ///< every start of the box reaches the target
  locked_elsewhere  ///< every start of the box reaches the target shifted in frequency by 2 pi `turns`, not 0
};

/// One line for people.
[[nodiscard]] std::string_view to_string(CaptureOutcome outcome) noexcept;

struct CaptureResult {
  CaptureOutcome outcome = CaptureOutcome::enclosure_lost;
  int samples = 0;           ///< after which the propagation ended
  int turns = 0;             ///< see locked_elsewhere
  double level = 0.0;        ///< when locked: see Settled
  int widest_direction = 2;  ///< 0, 1, 2 = amplitude, phase, frequency: where halving the box helps most
  /// Upper bounds on |frequency error|, rad/sample, of every start after 0, 1, ..., `samples` samples.
  std::vector<double> frequency_errors;
};

/// Follows all starts of the box at once. The target must be invariant for the problem's noise and slew: this
/// is not checked here. Anything that is not finite, and amplitudes that reach zero, are enclosure_lost.
/// Holds its own rounding mode; deterministic.
[[nodiscard]] CaptureResult follow_starts(const CaptureProblem& problem, const CaptureTarget& target,
                                          const StartBox& starts);

}  // namespace veritrack::quadrature

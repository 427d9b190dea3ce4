// Claims about the covariance and the steps of the single-channel tracker in a window of samples, at every
// phase and every frequency of a band; and its verification.
#pragma once

#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/single_channel/window_cells.hpp"
#include "trackers/instruction_set.hpp"

namespace veritrack::single_channel {

/// A proposal: exact doubles, which are evidence of nothing. `window` is shares.size().
struct WindowClaim {
  WindowAssumption assumption;
  int settling = 0;   ///< samples of the window before the lower bound starts
  double slew = 0.0;  ///< |omega(k+1) - omega(k)|, rad/sample
  /// shares[m - 1]: of any covariance P at least this part is due to the last m samples alone.
  std::vector<double> shares;
  /// |nu| |delta + i nu / 2| <= curvature e' P^-1 e; the weight is a free parameter of the proof.
  double curvature = 0.0;
  double curvature_weight = 1.0;
  /// A lower bound on the predicted covariance of (delta_1, delta_2) for given nu.
  double signal_uncertainty = 0.0;
};

/// Further results of a verified claim: lower bounds on P11, P22 and P33 over phases and band.
struct WindowFloor {
  double p11 = 0.0;
  double p22 = 0.0;
  double p33 = 0.0;
};

/// An error of the start, as a box: |delta| <= signal, |nu| <= frequency.
struct StartBox {
  double signal = 0.0;
  double frequency = 0.0;  ///< rad/sample
};

/// diag(signal, signal, frequency), the same in every frame of the phase; for a signal of amplitude 1.
struct StartVariances {
  rigor::Interval signal;
  rigor::Interval frequency;  ///< (rad/sample)^2
};

/// The floor when the claim is true for every design in `design` (amplitude 1, epsilon = 0), every phase and
/// every frequency of `band` (rad/sample), nothing otherwise:
///   (a) every covariance that satisfies the assumption for a window stays below its two variances
///   afterwards; (b) shares, curvature and signal_uncertainty are as they say.
/// Cells of phase and frequency, in parallel; the result does not depend on the number of threads. Opens its
/// own rounding modes.
[[nodiscard]] std::optional<WindowFloor> verify_window(const trackers::ToneModel<rigor::Interval>& design,
                                                       const rigor::Interval& band, const WindowClaim& claim);

/// A claim that is true, and which of the starts are certainly below every lower bound on P that the window
/// gives, at every phase and frequency.
struct VerifiedWindow {
  WindowFloor floor;
  std::vector<bool> is_below;
};

/// The same, and more in one go: of up to three starts.
[[nodiscard]] std::optional<VerifiedWindow> verify_window(const trackers::ToneModel<rigor::Interval>& design,
                                                          const rigor::Interval& band,
                                                          const WindowClaim& claim,
                                                          const std::vector<StartVariances>& starts);

namespace detail {
/// The check of cells for a set of instructions, and for single cells; all give the same bits.
[[nodiscard]] CheckWindow* check_window_of(trackers::InstructionSet set);
[[nodiscard]] CheckWindow* check_window_one_by_one();
/// The set that verify_window uses.
[[nodiscard]] trackers::InstructionSet instructions_for_window();
}  // namespace detail

/// True only when the claim is verified and the matrix is below every lower bound on P that the window gives,
/// at every phase and frequency.
[[nodiscard]] bool certainly_below_covariances(const trackers::ToneModel<rigor::Interval>& design,
                                               const rigor::Interval& band, const WindowClaim& claim,
                                               const StartVariances& start VERITRACK_CALL_SITE);

}  // namespace veritrack::single_channel

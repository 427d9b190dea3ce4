// The contraction ball of the quadrature tracker over a band of frequencies, with or without a leak.
//
// In the polar frame, around the lock branch X*(omega) (fixed_point_bias.hpp). Signals have amplitude 1:
// scale the design with trackers::at_unit_amplitude first, and the noise with the amplitude.
#pragma once

#include <string>
#include <vector>

#include "analysis/contraction/ball.hpp"
#include "analysis/contraction/ball_metric.hpp"
#include "analysis/contraction/fixed_point_bias.hpp"
#include "analysis/theorems/derivation.hpp"

namespace veritrack::contraction {

/// What is known of the tracker and its signal.
struct BallQuestion {
  trackers::QuadratureEkfDesign<rigor::Interval> design;
  rigor::Interval band;  ///< true frequencies, rad/sample
  double noise = 0.0;    ///< |v(k)| <= noise, relative to the amplitude
  double slew = 0.0;     ///< |omega(k+1) - omega(k)| <= slew within the band, rad/sample per sample
};

/// A ball, and smaller ones inside it in the same metric, each within reach of the one before: a state of one
/// ball comes below 1.01 times its ultimate level, which is the next one's radius, after `samples` steps at
/// most.
struct BallChain {
  std::vector<FixedPointTube<QuadraturePolarLoop::kStates>> cells;   ///< the part of the branch covered
  std::vector<BallCertificate<QuadraturePolarLoop::kStates>> balls;  ///< all PROVED, the largest first
};

/// Certificates over the branch: one for all of it; several, each for a part of the band, only when the
/// frequency is constant (slew = 0).
struct QuadratureBall {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< PROVED when the whole branch is covered
  std::string reason;
  std::vector<BallChain> parts;
};

/// Balls with the largest frequency error (|nu - nu*|, rad/sample) that was found and verified for the noise
/// and the slew of the question, on its lock branch. Never throws for numbers. Holds its own rounding mode.
[[nodiscard]] QuadratureBall certify_quadrature_ball(const BallQuestion& question, const LockBranch& branch);

/// Balls that stay invariant under as much noise as was found and verified, with no slew: proposal.noise of
/// each part says how much; the least of them holds for the band.
[[nodiscard]] QuadratureBall certify_largest_noise(const BallQuestion& question, const LockBranch& branch);

/// The same for the slew, with no noise: proposal.slew of the one part.
[[nodiscard]] QuadratureBall certify_largest_slew(const BallQuestion& question, const LockBranch& branch);

/// Everything as quantities and conditions, id "contraction": contraction_rate, radius,
/// frequency_error_radius, phase_error_radius, amplitude_error_radius (about the steady state),
/// ultimate_frequency_error (about the truth), largest_noise, largest_slew, settling_samples, bias_frequency.
/// Holds its own rounding mode.
[[nodiscard]] theorems::Derivation derive_quadrature_ball(const BallQuestion& question);

}  // namespace veritrack::contraction

// The experiment of section 3.7 of B. F. La Scala's thesis (trackers/quadrature/quadrature_ekf.hpp) and of
// section V of the 1996 paper: a tone of amplitude 1 whose frequency never falls, in white Gaussian noise,
// and the sum over the run of the squared errors of the frequency that a tracker estimates.
//
// Signal and run length are unpublished. Known: the slew is within [0, 0.04] rad/sample per sample and
// reaches 0.04. The family here, that of the signal "la-scala-1994" (trackers/signals/test_signals.hpp), is
// ours.
#pragma once

#include <cstdint>
#include <vector>

#include "trackers/notch/adaptive_notch.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::experiments {

/// A slow rise with a fast stretch, both with a slew that is a raised cosine.
struct SweptTone {
  double start;         ///< rad/sample
  double slow_rise;     ///< rad/sample, over the run
  double fast_samples;  ///< length of the fast stretch, in which the slew reaches 0.04
  double fast_place;    ///< where it begins, as a part of the run
  int samples;          ///< of the run
};

/// The signal "la-scala-1994", fitted to Table 3.2 alone.
inline constexpr SweptTone kStandIn{0.5, 0.1, 7.0, 0.5, 330};
/// The signal, and the P(1|0) = kFittedStartVariance I, that a search (Sbplx, started at four places) found
/// to come closest to Table 3.2 and to the column "EKF, actual" of Table I together, with the fast stretch
/// then shortened from 8.28 samples for the sake of the former.
inline constexpr SweptTone kFitted{0.4841, 0.1112, 8.1, 0.5084, 317};
inline constexpr double kFittedStartVariance = 0.35;

/// The frequency at every sample, rad/sample.
[[nodiscard]] std::vector<double> frequencies_of(const SweptTone& tone);

/// Where the trackers start: amplitude and phase exact, the frequency off by
enum class FrequencyStart : std::uint8_t {
  close,   ///< -0.01 rad/sample, as in Table 3.2
  uniform  ///< uniformly up to 20 % to either side, as in Table I
};

struct SweptToneExperiment {
  SweptTone tone = kStandIn;
  FrequencyStart start = FrequencyStart::close;
  double noise_variance = 0.01;  ///< of each channel, signal units squared
  double start_variance = 0.0;   ///< P(1|0) = start_variance I; 0: P(1|0) = Q
};

/// The input of the trackers of a run, and the frequency that they are to find.
struct ToneRun {
  double start = 0.0;                        ///< the frequency at which they start, rad/sample
  std::vector<double> frequency;             ///< rad/sample
  std::vector<double> in_phase, quadrature;  ///< noisy, signal units
};

/// The run of this seed: the start's error is drawn first, then the noise.
[[nodiscard]] ToneRun tone_run(const SweptToneExperiment& experiment, std::uint64_t seed);
/// Those of the seeds 1, ..., runs.
[[nodiscard]] std::vector<ToneRun> tone_runs(const SweptToneExperiment& experiment, int runs);

/// x3(k|k) along the run, rad/sample; `start_variance` as in the experiment.
[[nodiscard]] std::vector<double> tracked(const ToneRun& run, const trackers::ToneModel<double>& design,
                                          double start_variance);

/// For each run the sum of the squared errors of x3(k|k), (rad/sample)^2.
[[nodiscard]] std::vector<double> squared_errors(const std::vector<ToneRun>& runs,
                                                 const trackers::ToneModel<double>& design,
                                                 double start_variance);

/// The same for an adaptive notch filter, of both channels or of the first alone; infinite when it diverges.
enum class NotchInput : std::uint8_t { quadrature, real };
[[nodiscard]] std::vector<double> squared_errors(const std::vector<ToneRun>& runs, NotchInput input,
                                                 const trackers::NotchDesign<double>& design);

/// The design with the smallest mean sum of squared errors over the runs that local searches find (Q = q I;
/// q, r and the leak free), started in two places. A proposal, as everything found by a search.
/// `noise_variance`: that of the runs, to start r at.
[[nodiscard]] trackers::ToneModel<double> best_tracker(const std::vector<ToneRun>& runs,
                                                       double noise_variance, double start_variance);
/// The same for p, rho and mu of a notch filter.
[[nodiscard]] trackers::NotchDesign<double> best_notch(const std::vector<ToneRun>& runs, NotchInput input);

}  // namespace veritrack::experiments

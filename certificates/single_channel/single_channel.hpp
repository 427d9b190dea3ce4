// The certificate of a design of the single-channel tracker.
#pragma once

#include <Eigen/Core>

#include "analysis/rigor/interval.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/tracker_run.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::certificates {

/// Q = diag(q1, q1, q2), r and epsilon of [design], whatever keys they came from: the intervals that the
/// decimals represent, in the units of the design file.
[[nodiscard]] trackers::ToneModel<rigor::Interval> enclosed_values(const SingleChannelDesignTable& design);

/// The same as the nearest doubles.
[[nodiscard]] trackers::ToneModel<double> nearest_values(const SingleChannelDesignTable& design);

/// A frequency of the band, rad/sample, with its decimal.
struct BiasFrequency {
  std::string text;
  rigor::Interval value;
};

/// The frequencies at which the bias is enclosed: both ends of the band and points between them. Opens its
/// own rounding scope.
[[nodiscard]] std::vector<BiasFrequency> bias_frequencies(const Assumptions& assume);

/// Evaluates everything: the simulated run, the bias at frequencies of the band, the transfer function, the
/// propositions, and the claims of [require]. Needs the upward mode.
void certify_single_channel(Certificate& certificate, const CertifyProgress& progress);

/// Evaluates the propositions alone. Needs the upward mode.
void single_channel_published_results(Certificate& certificate);

/// The simulated run, from the edge of the assumed start errors along the signal that [simulate] names, of
/// which the tracker sees the in-phase channel. Throws trackers::ZeroInnovationVariance. Holds
/// round-to-nearest.
[[nodiscard]] Simulation simulate_single_channel(const SingleChannelEkfTables& tables);

/// P(0|0) of a run that starts at that frequency (rad/sample) and phase (rad), in the frame of the estimated
/// phase: as given, or the value at which the covariance settles on a noise-free tone that reaches that
/// phase. Needs round-to-nearest.
[[nodiscard]] Eigen::Matrix3d run_start_covariance(const SingleChannelEkfTables& tables, double frequency,
                                                   double phase);

/// The tracker of a design, to be run on samples.
[[nodiscard]] TrackerOnSamples single_channel_on_samples(const Design& design);

}  // namespace veritrack::certificates

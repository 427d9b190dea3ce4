// A set of errors and covariances as a few samples see it, in floating point: for proposals only.
#pragma once

#include <optional>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/quadrature/contraction/step_inequality.hpp"

namespace veritrack::quadrature {

/// The sampled properties of the set {|T e| <= radius}, with matching covariance bounds.
struct SampledSet {
  StepSetting<double> setting;  ///< with the covariance bounds found
  /// The least rate^2 with which the samples satisfy the inequality of step_inequality.hpp; infinity when
  /// there are no bounds or it is found to be useless.
  double rate_squared;
};

/// The set to sample. The rate in `constants` is not read.
struct SampleRequest {
  trackers::ToneModel<double> design;
  BlockMetric<double> metric;
  double radius = 0.0;
  double noise = 0.0;  ///< relative to the amplitude
  StepConstants<double> constants;
  /// The margin of the covariance bounds beyond the necessary ones, in units of the steady state: room for a
  /// proof.
  double covariance_margin = 0.02;
  std::optional<CovarianceRange> start_covariance;  ///< to be held by the bounds as well
  double useless_rate_squared = 1.0;                ///< from here on it does not matter how large it is
};

/// Finds covariance bounds by iteration from the steady state and samples the inequality.
[[nodiscard]] SampledSet sample_set(const SampleRequest& request, const BlockCovariance<double>& steady);

}  // namespace veritrack::quadrature

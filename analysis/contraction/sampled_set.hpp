// A set of errors and covariances as a few samples see it, in floating point: for proposals only.
#pragma once

#include "analysis/contraction/polar_step_form.hpp"

namespace veritrack::contraction {

/// What sampling finds of the set {|T e| <= radius} with covariance bounds to match.
struct SampledSet {
  StepSetting<double> setting;  ///< with the covariance bounds found
  double rate;                  ///< infinity when there are no bounds or a sample does not contract
  double noise_gain;
  double slew_gain;
};

/// Finds covariance bounds by iteration from the steady state and samples the rate of contraction.
[[nodiscard]] SampledSet sample_set(const trackers::QuadratureEkfDesign<double>& design,
                                    const BlockCovariance<double>& steady, const BlockMetric<double>& metric,
                                    double radius, double noise);

}  // namespace veritrack::contraction

// A question that is answered fast: for tests.
#pragma once

#include <cmath>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"

namespace veritrack::quadrature::test_sets {

/// A thousand samples of Figure 3.5's design at 26 dB: a small set, some thousand cells.
inline LockQuestion question(double decibels) {
  using rigor::Interval;
  const rigor::UpwardRounding upward;
  const trackers::ToneModel<double>& d = kDesigns[1];
  const BlockCovariance<double> p = *steady_covariance(d);
  Eigen::Matrix3d centre;
  centre << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  LockQuestion result;
  result.design = {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)};
  result.noise_deviation = Interval(std::sqrt(0.5 * std::pow(10.0, -decibels / 10.0)));
  result.frequency_walk = Interval(0.0);
  result.samples = Interval(1000.0);
  result.probability = 1e-2;
  result.starts = {Interval(0.01),
                   Interval(0.02),
                   Interval(0.01),
                   {rigor::to_interval(centre), Interval::from_bounds(1.0 - 1e-6, 1.0 + 1e-6), false}};
  return result;
}

}  // namespace veritrack::quadrature::test_sets

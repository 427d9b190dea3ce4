// Does every step of a set of errors and covariances contract the errors?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/contraction/polar_step_form.hpp"

namespace veritrack::contraction {

/// The contraction of one ray, proposed in double: the smallest rate for which the form of the ray is
/// certified by some multiplier, and that multiplier.
struct RayRate {
  double rate_squared;
  double multiplier;
};

/// Proposal only. A rate of infinity when no multiplier works.
[[nodiscard]] RayRate propose_rate(const PolarStepForm<double>& form, const BlockMetric<double>& metric);

/// True only when |T e+|^2 <= rate^2 |T e|^2 for every ray of the form and every m. By the S-procedure with
/// multiplier lambda > 0 it suffices that
///     [[rate^2 q - lambda eta^2 E, P'], [P, I - G/lambda]]  is positive definite,
/// q and G of the form, P = (T c, T (0,0,1)'), E = diag(1, 0): since by Schur complement then I > G/lambda,
/// and
///     |p + T J D y / r|^2 <= p' (I - G/lambda)^-1 p + lambda |y|^2      for any p.
/// Needs the upward mode.
[[nodiscard]] bool certainly_contracts(const PolarStepForm<rigor::Interval>& form,
                                       const BlockMetric<rigor::Interval>& metric,
                                       const rigor::Interval& rate_squared, double multiplier);

/// What the cells that cover a set say together.
struct ContractionOverSet {
  bool proved = false;
  std::string reason;            ///< one sentence when not proved
  double noise_gain = 0.0;       ///< L_v, an upper bound
  std::vector<TurnBound> turns;  ///< ranges of |z| that cover the set, with their turns
  std::int64_t cells = 0;        ///< examined
};

/// Covers the projection {(a/A)^2 + (chi/C)^2 <= 1, chi >= 0} of the ellipsoid by cells in (s, beta),
/// bisected until each contracts by `rate`. Half of the ellipse is enough: the step commutes with the mirror
/// image (psi, nu, P12, P13) -> -(psi, nu, P12, P13), which maps the set to itself. Needs the upward mode.
///
/// Cells are also bisected until their noise gain is at most `gain_limit`, which may be infinite.
[[nodiscard]] ContractionOverSet prove_contraction(const StepSetting<rigor::Interval>& setting, double rate,
                                                   double gain_limit);

}  // namespace veritrack::contraction

// Does every step of a set of errors and covariances satisfy the inequality of step_inequality.hpp?
#pragma once

#include <cstdint>
#include <string>

#include "analysis/quadrature/contraction/step_inequality.hpp"
#include "trackers/instruction_set.hpp"

namespace veritrack::quadrature {

/// The joint result of the cells that cover a set.
struct ContractionOverSet {
  bool proved = false;
  std::string reason;      ///< one sentence when not proved
  std::int64_t cells = 0;  ///< examined
};

/// An upper bound on the tangent squared of the angle between the axis (cos, sin) and any beta in [low,
/// high]; infinity when it may be a right angle. On an interval of betas less than pi wide the tangent is
/// monotone where the cosine is positive at both ends. Needs the upward mode.
[[nodiscard]] double tangent_squared_from(const rigor::Interval& axis_cosine,
                                          const rigor::Interval& axis_sine, double low, double high);

/// The widest that this processor has.
[[nodiscard]] trackers::InstructionSet instructions_for_cells();

/// Covers the projection {(a/A)^2 + (chi/C)^2 <= 1, chi >= 0} of the ellipsoid by cells in (s, beta),
/// bisected until the inequality is proved in each. Half of the ellipse is enough: the step commutes with the
/// mirror image (psi, nu, P12, P13, v2, w) -> -(psi, nu, P12, P13, v2, w), which maps the set to itself. The
/// result does not depend on the set of instructions. Needs the upward mode; throws std::invalid_argument
/// where this processor lacks the instructions.
[[nodiscard]] ContractionOverSet prove_contraction(const StepSetting<rigor::Interval>& setting,
                                                   const StepConstants<rigor::Interval>& constants,
                                                   trackers::InstructionSet set = instructions_for_cells());

}  // namespace veritrack::quadrature

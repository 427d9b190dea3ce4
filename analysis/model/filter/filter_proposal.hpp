// A tube of an extended Kalman filter that bounds its covariance: a proposal, in floating point.
//
// Along an orbit of the tone the bounds and the shape are carried together, Pi being U U' with the radius in
// it, and F_i the change of F along column i of U:
//   high+ = (1 + eta) F Phi_high F' + (1 + 1/eta) sum_i F_i Phi_high F_i' + Q,
//   low+ = (1 - theta) F Phi_low F' - (1/theta - 1) sum_i F_i Phi_low F_i' + Q,
//   Pi+ = A Pi A'/lambda + b K K' + d (Phi_high+ - Phi_low+)/2 + W,
// where Phi is the updated covariance of a predicted one, K and A = (I - K H) F those of the middle.
#pragma once

#include <optional>

#include "analysis/model/shape/proposed_tube.hpp"
#include "analysis/model/shape/shape_proposal.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"

namespace veritrack::model {

/// Around the curve of a settled filter, whose first states are its estimate and whose others are the upper
/// triangle of its covariance: fills in the shape, its worth, the tube and the outcome. `nearby`: parameters
/// that were good at neighbouring frequencies; with `keep` they are used as they are. Deterministic; holds
/// round-to-nearest. Needs tone.filter.
void propose_filter_tube(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings,
                         const std::optional<ShapeParameters>& nearby, bool keep, TubeProposal& proposal);

/// For noise, of estimates that stay in the tube `around`, at the level `radius` or below: a tube of the same
/// curve and frequencies that is small in the long run, with bounds of the covariance for all estimates in
/// that level. `of_around`: the parameters of that tube. Deterministic; holds round-to-nearest. Needs
/// tone.filter.
[[nodiscard]] TubeProposal propose_long_run_tube(const TrackedTone& tone, const Tube& around, double radius,
                                                 double noise, const ShapeParameters& of_around,
                                                 const std::optional<ShapeParameters>& nearby);

}  // namespace veritrack::model

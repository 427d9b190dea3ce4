// Proposals, in floating point, of sets around the steady state that tolerate as much noise, or as much slew,
// as possible, or are as large as possible. Nothing here is evidence; steady_verification.hpp decides.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/quadrature/leak/steady_proposal.hpp"

namespace veritrack::quadrature {

/// The shape that allows the most, as far as coarse samples can tell.
struct SteadyLimit {
  rigor::Matrix<3> metric;  ///< of level 1
  double goal;              ///< the share of the covariance bounds that a step may fill
  /// The noise, relative to the amplitude, the slew, rad/sample per sample, or the radius, rad/sample.
  double size;
  Eigen::VectorXd point;  ///< where the search for a neighbouring band may begin
};

/// Raises `size` (the noise, the slew or the radius of the request, the others stay as they are) from a small
/// value as far as a shape can be found that allows it: first for the last of the request's steady states,
/// then for all of them. Each round searches for the shape with the least rate at the present size, and then
/// raises the size as far as this shape maps level 1 into `target` < 1: the rest is room for the proof. The
/// same from each of `harder`, limits for higher frequencies; the largest is returned. Deterministic; nothing
/// when no shape is found at all.
[[nodiscard]] std::optional<SteadyLimit> propose_steady_limit(const SteadyRequest& request,
                                                              double SteadyRequest::*size, double target,
                                                              const std::vector<SteadyLimit>& harder = {});

/// A shape that maps level 1 into `target` < 1 at the size of the request, searched for from `point`; nothing
/// when none is found. Deterministic.
[[nodiscard]] std::optional<SteadyLimit> propose_steady_size(const SteadyRequest& request,
                                                             double SteadyRequest::*size, double target,
                                                             const Eigen::VectorXd& point);

/// A set of one level and of this shape for the noise and slew of the request; nothing when finer samples
/// find that it is not invariant.
[[nodiscard]] std::optional<SteadySet> set_of_limit(const SteadyRequest& request, const SteadyLimit& limit);

}  // namespace veritrack::quadrature

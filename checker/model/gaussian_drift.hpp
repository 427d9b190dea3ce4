// Tubes in Gaussian noise: with the level l of a state and W = exp(L l^2/R^2),
//   E[W after a step; |v| <= V] <= kappa W + c_0
// for all states of a tube, so that states rarely leave it (docs/model-proof.md, section 11).
#pragma once

#include <cstdint>

#include "checker/model/length_bound.hpp"
#include "checker/model/tube_evidence.hpp"
#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// True only when the inequality holds for all |xi| <= R: `step` is F for |xi| <= R and |v| <= V, both scaled
/// to 1, with `channels` channels of noise.
bool drift_is_bounded(const LengthBound& step, double radius, const GaussianTerms& terms,
                      std::size_t channels);

/// The inequality on all phases and frequencies of all tubes of a set that has Gaussian terms; the shape is
/// valid, everything is defined, only angles turn, and angles are known modulo 2 pi. Objects otherwise.
bool is_seldom_left(const TrackedModel& model, const TubeSet& set, std::int64_t& cells,
                    Objections& objections);

/// A bound on the probability that a state which starts at a level of at most `start_share` R leaves the set
/// within any `samples` successive samples, however late:
///   exp(-L) (exp(L start_share^2) + (c_0 + t exp(L))/(1 - kappa) + N c_0) + N t,
/// where t bounds the probability that the noise of a sample is longer than V.
Ball leaving_probability(const GaussianTerms& terms, std::size_t channels, const Ball& samples,
                         const Ball& start_share);

}  // namespace veritrack::checker

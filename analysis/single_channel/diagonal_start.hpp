// The covariance with which the user may start the single-channel tracker.
#pragma once

#include <optional>
#include <string>

#include "analysis/single_channel/window_proposal.hpp"

namespace veritrack::single_channel {

/// P(0|0) from `from` M to `to` M, M = diag(signal, signal, frequency) in signal units, as decimals: the same
/// in every frame of the phase.
struct DiagonalStart {
  std::string signal, frequency, from, to;

  /// A multiple of M, for a signal of amplitude 1. Needs the upward mode.
  [[nodiscard]] StartVariances times(const std::string& multiple, const rigor::Interval& amplitude) const;
};

/// The least of the levels |e|, at most, that all errors of the box have in the metric P^-1 of every such
/// P(0|0); nothing when M is not certainly positive definite. Needs the upward mode.
[[nodiscard]] std::optional<double> level_of(const DiagonalStart& start, const StartBox& box,
                                             const rigor::Interval& amplitude);

/// The box, for which a start is proposed: no side vanishes.
[[nodiscard]] StartBox shape_of(const StartBox& box);

/// From a proposal for the shape of the box: one that lies below the covariances of the window on a grid, by
/// that margin, and in which the box has a small level. Needs the upward mode.
[[nodiscard]] DiagonalStart diagonal_start(const StartProposal& start, const StartBox& box, double margin,
                                           double amplitude);

}  // namespace veritrack::single_channel

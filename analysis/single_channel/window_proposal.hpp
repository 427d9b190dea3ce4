// Proposals, in floating point, for windows in which the errors of the single-channel tracker shrink.
#pragma once

#include <optional>
#include <vector>

#include "analysis/single_channel/window_claim.hpp"

namespace veritrack::single_channel {

/// The purpose of a window; amplitude 1, epsilon = 0.
struct WindowRequest {
  trackers::ToneModel<double> design;
  double lowest_frequency = 0.0;   ///< rad/sample
  double highest_frequency = 0.0;  ///< rad/sample
  double slew = 0.0;               ///< rad/sample per sample
};

/// Claims for radii from small to large, each with the loosening and the length that leave most room, as
/// computed on a grid of phases and frequencies, with some slack. Empty when the covariance does not settle.
[[nodiscard]] std::vector<WindowClaim> propose_windows(const WindowRequest& request);

/// The same claim with values that are easier to verify; `slack` is a relative margin.
[[nodiscard]] WindowClaim with_slack(WindowClaim claim, double slack);

/// diag(signal^2 / weight, signal^2 / weight, frequency^2 / (1 - weight)) / level^2 of the box lies below the
/// covariances of the window.
struct StartProposal {
  double level = 0.0;
  double weight = 0.5;
};
[[nodiscard]] StartProposal propose_start(const WindowRequest& request, const WindowClaim& claim,
                                          const StartBox& box);

}  // namespace veritrack::single_channel

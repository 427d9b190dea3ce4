// Conditions (a) to (c) of invariant_curve.hpp on a tube, at every frequency of its interval.
#pragma once

#include <string>

#include "analysis/single_channel/invariant_tube.hpp"

namespace veritrack::single_channel {

enum class TubeAttempt { succeeded, wants_smaller_cells, hopeless };

/// How far the verification came.
struct TubeVerification {
  TubeAttempt attempt = TubeAttempt::hopeless;
  std::string reason;     ///< unless it succeeded
  double rate = 1.0;      ///< kappa, an upper bound
  double distance = 0.0;  ///< rho / (1 - kappa), an upper bound on |u| along the invariant curve
};

/// Succeeded only when the conditions hold for some radius. Opens its own rounding modes.
[[nodiscard]] TubeVerification verify_tube(const InvariantTube& tube);

}  // namespace veritrack::single_channel

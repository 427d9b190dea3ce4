#include "analysis/single_channel/window_proposal.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "analysis/single_channel/window_grid.hpp"

namespace veritrack::single_channel {

namespace {

using detail::GridView;
using detail::kLongestWindow;
using detail::PhaseGrid;

/// The largest two variances of the upper bounds, in the form of an assumption.
WindowAssumption variances_of(const PhaseGrid& grid, WindowAssumption assumption) {
  const detail::GridVariances seen = detail::grid_functions().variances(grid.task(assumption, 1));
  assumption.signal_variance = seen.signal;
  assumption.frequency_variance = seen.frequency;
  return assumption;
}

/// kappa_n + c R sum kappa, see window_errors.hpp.
double factor_of(const WindowClaim& claim) {
  double sum = 1.0;
  for (std::size_t m = 0; m + 1 < claim.shares.size(); ++m) {
    sum += std::sqrt(1.0 - claim.shares[m]);
  }
  return std::sqrt(1.0 - claim.shares.back()) +
         claim.curvature / std::sqrt(claim.signal_uncertainty) * claim.assumption.radius * sum;
}

/// The room that noise and slew have.
double room_of(const WindowClaim& claim) {
  return (1.0 - factor_of(claim)) * claim.assumption.radius /
         std::sqrt(static_cast<double>(claim.shares.size()));
}

/// The claim with this assumption whose length leaves most room; nothing when there is none.
std::optional<WindowClaim> best_length(const WindowRequest& request, const WindowAssumption& assumption,
                                       const GridView& seen) {
  std::optional<WindowClaim> best;
  const auto* const curvature = std::min_element(std::begin(seen.curvatures), std::end(seen.curvatures));
  const double weight = detail::grid_weight(static_cast<int>(curvature - std::begin(seen.curvatures)));
  for (std::size_t n = 1; n <= kLongestWindow; ++n) {
    if (!(seen.shares[n - 1] > 0.0 && seen.shares[n - 1] < 1.0) ||
        !(seen.signal_uncertainties[n - 1] > 0.0)) {
      break;
    }
    const WindowClaim claim{
        assumption,
        detail::kSettling,
        request.slew,
        std::vector<double>(std::begin(seen.shares), std::begin(seen.shares) + static_cast<long>(n)),
        *curvature,
        weight,
        seen.signal_uncertainties[n - 1]};
    if (room_of(claim) > (best ? room_of(*best) : 0.0)) {
      best = claim;
    }
  }
  return best;
}

/// The claim for this radius and loosening.
std::optional<WindowClaim> propose_window(const WindowRequest& request, const PhaseGrid& grid,
                                          WindowAssumption assumption) {
  const double settled = assumption.signal_variance;
  constexpr int kRounds = 6;
  constexpr double kMargin = 1.004;  // so that the iteration ends above the variances that it requires
  constexpr double kTooLarge = 5.0;
  for (int round = 0; round < kRounds; ++round) {
    assumption = variances_of(grid, assumption);
    assumption.signal_variance *= kMargin;
    assumption.frequency_variance *= kMargin;
    if (!(assumption.signal_variance < kTooLarge * settled)) {
      return std::nullopt;
    }
  }
  GridView seen;
  detail::grid_functions().look(grid.task(assumption, kLongestWindow), seen);
  return best_length(request, assumption, seen);
}

}  // namespace

std::vector<WindowClaim> propose_windows(const WindowRequest& request) {
  const rigor::UpwardRounding outer;
  const PhaseGrid grid(request);
  WindowAssumption still;
  still.radius = 0.0;
  still.loosening = 1e-9;
  still.frequency_variance = 30.0 * request.design.q2;
  still.signal_variance = 300.0 * request.design.q1;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    still = variances_of(grid, still);
  }
  if (!(still.signal_variance > 0.0 && std::isfinite(still.signal_variance))) {
    return {};
  }
  constexpr std::array<double, 5> kLoosenings = {0.012, 0.025, 0.045, 0.08, 0.13};
  constexpr std::size_t kRadii = 24;
  std::array<std::optional<WindowClaim>, kRadii> found;
  tbb::parallel_for(std::size_t{0}, kRadii, [&](std::size_t i) {
    const rigor::UpwardRounding upward;
    for (const double loosening : kLoosenings) {
      WindowAssumption assumption = still;
      // Radii that reach to frequency errors from 0.001 to 0.17 rad/sample.
      assumption.radius =
          0.001 * std::pow(1.25, static_cast<double>(i)) / std::sqrt(still.frequency_variance);
      assumption.loosening = loosening;
      const auto claim = propose_window(request, grid, assumption);
      if (claim && room_of(*claim) > (found[i] ? room_of(*found[i]) : 0.0)) {
        found[i] = claim;
      }
    }
  });
  std::vector<WindowClaim> claims;
  claims.reserve(kRadii);
  for (const auto& claim : found) {
    if (claim) {
      claims.push_back(*claim);
    }
  }
  return claims;
}

WindowClaim with_slack(WindowClaim claim, double slack) {
  claim.assumption.signal_variance *= 1.0 + slack;
  claim.assumption.frequency_variance *= 1.0 + slack;
  claim.curvature *= 1.0 + 2.0 * slack;
  claim.signal_uncertainty *= 1.0 - 4.0 * slack;
  for (double& share : claim.shares) {
    share = std::max(0.0, share * (1.0 - 2.0 * slack) - 0.1 * slack);
  }
  return claim;
}

}  // namespace veritrack::single_channel

#include "analysis/single_channel/window_proposal.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "analysis/single_channel/window_grid.hpp"

namespace veritrack::single_channel {

namespace {

using detail::Covariance;
using detail::follow_grid;
using detail::kInfinity;
using detail::kSettling;
using detail::Matrix3;
using detail::matrix_of;
using detail::smallest_eigenvalue;

constexpr int kLongestWindow = 12;

/// The largest t with lower >= t upper.
double share_of(const Covariance& lower, const Covariance& upper) {
  const Eigen::LLT<Matrix3> factor(matrix_of(upper));
  const Matrix3 half = factor.matrixL().solve(matrix_of(lower));
  const Matrix3 both = factor.matrixL().solve(half.transpose());
  return smallest_eigenvalue<3>(0.5 * (both + both.transpose()));
}

/// The largest two variances of the upper bounds, in the form of an assumption.
WindowAssumption variances_of(const WindowRequest& request, WindowAssumption assumption) {
  double signal = 0.0;
  double frequency = 0.0;
  follow_grid(request, assumption, 1,
              [&](int /*m*/, const Covariance& upper, const Covariance& /*lower*/, const Covariance&) {
                const double half_difference = 0.5 * (upper.p11 - upper.p22);
                signal =
                    std::max(signal, 0.5 * (upper.p11 + upper.p22) + std::hypot(half_difference, upper.p12));
                frequency = std::max(frequency, upper.p33);
              });
  assumption.signal_variance = signal;
  assumption.frequency_variance = frequency;
  return assumption;
}

/// The least curvature at this weight, for one covariance.
double curvature_of(const Covariance& p, double weight) {
  const double s = std::sqrt(weight);
  Matrix3 c;
  c << 0.0, 0.0, s, 1.0 / s, 0.0, 0.0, 0.0, 1.0 / s, 0.5 / s;
  return -0.5 * smallest_eigenvalue<3>(-(c * matrix_of(p) * c.transpose()));
}

/// The smallest variance of the first two components that is left when the third is known.
double signal_uncertainty_of(const Covariance& p) {
  rigor::Matrix<2> rest;
  rest << p.p11 - p.p13 * p.p13 / p.p33, p.p12 - p.p13 * p.p23 / p.p33, p.p12 - p.p13 * p.p23 / p.p33,
      p.p22 - p.p23 * p.p23 / p.p33;
  return smallest_eigenvalue<2>(rest);
}

/// What is seen on the grid under the assumption, for windows of every length up to the longest.
struct Seen {
  std::array<double, kLongestWindow> shares;
  std::array<double, kLongestWindow> signal_uncertainties;
  double curvature = kInfinity;
  double curvature_weight = 1.0;
};

Seen look(const WindowRequest& request, const WindowAssumption& assumption) {
  Seen seen;
  seen.shares.fill(1.0);
  seen.signal_uncertainties.fill(kInfinity);
  std::array<double, 10> weights{};
  std::array<double, 10> curvatures{};
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = 0.5 * std::pow(1.35, static_cast<double>(i));
  }
  follow_grid(request, assumption, kLongestWindow,
              [&](int m, const Covariance& upper, const Covariance& lower, const Covariance& predicted) {
                const auto k = static_cast<std::size_t>(m - 1);
                seen.shares[k] = std::min(seen.shares[k], share_of(lower, upper));
                seen.signal_uncertainties[k] =
                    std::min(seen.signal_uncertainties[k], signal_uncertainty_of(predicted));
                if (m == kLongestWindow) {
                  for (std::size_t i = 0; i < weights.size(); ++i) {
                    curvatures[i] = std::max(curvatures[i], curvature_of(upper, weights[i]));
                  }
                }
              });
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (curvatures[i] < seen.curvature) {
      seen.curvature = curvatures[i];
      seen.curvature_weight = weights[i];
    }
  }
  return seen;
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
                                       const Seen& seen) {
  std::optional<WindowClaim> best;
  for (std::size_t n = 1; n <= seen.shares.size(); ++n) {
    if (!(seen.shares[n - 1] > 0.0 && seen.shares[n - 1] < 1.0) ||
        !(seen.signal_uncertainties[n - 1] > 0.0)) {
      break;
    }
    const WindowClaim claim{
        assumption,
        kSettling,
        request.slew,
        std::vector<double>(seen.shares.begin(), seen.shares.begin() + static_cast<long>(n)),
        seen.curvature,
        seen.curvature_weight,
        seen.signal_uncertainties[n - 1]};
    if (room_of(claim) > (best ? room_of(*best) : 0.0)) {
      best = claim;
    }
  }
  return best;
}

/// The claim for this radius and loosening.
std::optional<WindowClaim> propose_window(const WindowRequest& request, WindowAssumption assumption) {
  const double settled = assumption.signal_variance;
  constexpr int kRounds = 6;
  constexpr double kMargin = 1.004;  // so that the iteration ends above the variances that it requires
  constexpr double kTooLarge = 5.0;
  for (int round = 0; round < kRounds; ++round) {
    assumption = variances_of(request, assumption);
    assumption.signal_variance *= kMargin;
    assumption.frequency_variance *= kMargin;
    if (!(assumption.signal_variance < kTooLarge * settled)) {
      return std::nullopt;
    }
  }
  return best_length(request, assumption, look(request, assumption));
}

}  // namespace

std::vector<WindowClaim> propose_windows(const WindowRequest& request) {
  const rigor::UpwardRounding outer;
  WindowAssumption still;
  still.radius = 0.0;
  still.loosening = 1e-9;
  still.frequency_variance = 30.0 * request.design.q2;
  still.signal_variance = 300.0 * request.design.q1;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    still = variances_of(request, still);
  }
  if (!(still.signal_variance > 0.0 && still.signal_variance < kInfinity)) {
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
      const auto claim = propose_window(request, assumption);
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

#include "analysis/quadrature/gaussian/lock_centre.hpp"

#include <cmath>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::quadrature {

std::optional<LockCentre> lock_centre(const trackers::ToneModel<double>& design, double frequency) {
  using namespace trackers;
  ToneModel<double> without_leak = design;
  without_leak.epsilon = 0.0;
  const auto start = steady_covariance(without_leak);
  if (!start) {
    return std::nullopt;
  }
  if (design.epsilon == 0.0) {
    return LockCentre{{}, level_covariance(*start)};
  }
  constexpr double kWay = 0.05;
  constexpr int kMostSteps = 20000;
  RotatingFrameState<double> x;
  x << 0.0, 0.0, 0.0, start->p11, 0.0, 0.0, start->p22, start->p23, start->p33;
  const int ways = 1 + static_cast<int>(std::fabs(frequency) / kWay);
  for (int way = 1; way <= ways; ++way) {
    const double here = frequency * way / ways;
    // In between, near enough is near enough.
    const double near = way == ways ? 1e-12 : 1e-6;
    double moved = 1.0;
    for (int k = 0; k < kMostSteps && moved > near; ++k) {
      const RotatingFrameState<double> next = rotating_frame_map(x, {0.0, 0.0, 0.0, here}, design);
      moved = (next - x).norm();
      x = next;
    }
    if (!(moved <= near)) {
      return std::nullopt;
    }
  }
  return LockCentre{{x(kDeltaInPhase), x(kDeltaQuadrature), x(kFrequencyError)},
                    {x(kP11), x(kP22), x(kP23), x(kP33), x(kP12), x(kP13), false}};
}

}  // namespace veritrack::quadrature

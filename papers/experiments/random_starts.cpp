#include "papers/experiments/random_starts.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/signals/phasor.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::experiments {

std::vector<double> starts_without_lock(const trackers::ToneModel<double>& design, int starts) {
  const rigor::NearestRounding nearest;
  const Eigen::Matrix3d first = design.q2 * Eigen::Matrix3d::Identity();
  std::vector<double> lost;
  lost.reserve(static_cast<std::size_t>(starts));
  for (int start = 1; start <= starts; ++start) {
    trackers::RandomStream random(static_cast<std::uint64_t>(start));
    const auto [in_phase, quadrature] =
        trackers::unit_phasor(std::numbers::pi * (2.0 * random.uniform() - 1.0));
    const double frequency = kStartTone + kStartReach * (2.0 * random.uniform() - 1.0);
    trackers::QuadratureEkf<double> tracker(
        {design.q1, design.q2, design.r, 0.0},
        {in_phase, quadrature, frequency, trackers::FactoredCovariance<double>::from_matrix(first)});
    for (int k = 1; k <= kStartSamples; ++k) {
      const auto [cosine, sine] = trackers::unit_phasor(trackers::wrapped(kStartTone * k));
      tracker.step(cosine, sine);
    }
    const double error = std::fabs(tracker.filtered().frequency - kStartTone);
    lost.push_back(error < kStartLocked ? 0.0 : 1.0);  // NaN is no lock
  }
  return lost;
}

}  // namespace veritrack::experiments

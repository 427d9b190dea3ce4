#include "analysis/quadrature/start_covariance.hpp"

#include <cmath>
#include <utility>

#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::quadrature {

rigor::Matrix<3> near_steady_covariance(const trackers::ToneModel<double>& design, double frequency) {
  constexpr int kMostSamples = 1'000'000;
  constexpr double kStill = 1e-13;
  trackers::PolarFrameState<double> state{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 1.0, 0.0, 1.0}};
  for (int k = 0; k < kMostSamples; ++k) {
    const auto before = state.covariance;
    state = trackers::polar_frame_map(state, {0.0, 0.0, 0.0, frequency}, design);
    const auto& now = state.covariance;
    const auto stands = [](double a, double b) { return std::abs(a - b) <= kStill * std::abs(a); };
    if (stands(now.p11, before.p11) && stands(now.p22, before.p22) && stands(now.p33, before.p33)) {
      break;
    }
  }
  return state.covariance.matrix();
}

sets::ContractionQuestion with_start_covariance(sets::ContractionQuestion question, double frequency) {
  if (question.start_covariance) {
    return question;
  }
  const rigor::NearestRounding nearest;
  constexpr double kMargin = 1e-6;
  const auto& d = question.design;
  const rigor::Matrix<3> p =
      near_steady_covariance({midpoint(d.q1), midpoint(d.q2), midpoint(d.r), midpoint(d.epsilon)}, frequency);
  if (p.allFinite()) {
    question.start_covariance = sets::StartCovariance{
        rigor::to_interval(p), rigor::Interval::from_bounds(1.0 - kMargin, 1.0 + kMargin), false};
  }
  return question;
}

}  // namespace veritrack::quadrature

#include "analysis/model/steady_state/curve_dynamics.hpp"

#include <cstddef>

namespace veritrack::model {

CurveDynamics follow_curve(const TrackedTone& tone, const NodeCurve& curve, const Eigen::MatrixXcd& slope,
                           const PhaseGrid& grid) {
  const int n = tone.step.states();
  CurveDynamics result{
      Cocycle(grid, curve.frequency, jacobians_along(tone, curve, grid), n), {}, {}, {}, {}, {}, {}};
  const auto count = static_cast<std::size_t>(grid.size());
  result.step.reserve(count);
  result.gradient.reserve(count);
  result.hessian.reserve(count);
  result.noise_source.resize(n * n, grid.size());
  result.slew.resize(n, grid.size());
  const Eigen::VectorXd scale = curve.harmonics.cwiseAbs().rowwise().sum().cwiseMax(1e-6);
  result.size = Eigen::VectorXd::Zero(n);
  for (int j = 0; j < grid.size(); ++j) {
    const double next = grid.phase(j) + curve.frequency;
    const Eigen::VectorXd state = state_at(curve, grid.phase(j));
    result.step.push_back(tone.step.derivatives(state, samples_of(tone.signal, tone.amplitude, next), scale));
    result.gradient.push_back(tone.step.frequency_gradient(state));
    result.hessian.push_back(tone.step.frequency_hessian(state));
    result.size += state.cwiseAbs2() / static_cast<double>(grid.size());
    const Eigen::MatrixXd& sample = result.step.back().sample;
    const Eigen::MatrixXd source = sample * sample.transpose();
    result.noise_source.col(j) = source.reshaped();
    result.slew.col(j) = value_at(slope, next);
  }
  result.size = result.size.cwiseSqrt();
  for (int i = 0; i < n; ++i) {
    result.size[i] = curve.turns[static_cast<std::size_t>(i)] != 0 ? 1.0 : result.size[i];
  }
  return result;
}

}  // namespace veritrack::model

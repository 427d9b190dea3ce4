#include "analysis/single_channel/curve_proposal.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/invariant_curve.hpp"

namespace veritrack::single_channel {

namespace {

using trackers::QuadratureEkfDesign;
using State = RotatingFrameState<double>;

constexpr std::size_t kHarmonics = 28;
constexpr int kSettlingSteps = 4000;

/// The image of X at `phase` after one sample without noise.
template <typename Scalar>
RotatingFrameState<Scalar> image(const RotatingFrameState<Scalar>& state, double phase, double frequency,
                                 const QuadratureEkfDesign<Scalar>& design) {
  return trackers::single_channel_map(
      state, {Scalar(phase + frequency), Scalar(0.0), Scalar(0.0), Scalar(frequency)}, design);
}

/// Where the simulated tracker is at `phase` after it started from the exact estimate.
State settled_state(const QuadratureEkfDesign<double>& design, double frequency, double phase) {
  State state = State::Zero();
  state(trackers::kP11) = state(trackers::kP22) = design.r + design.q1;
  state(trackers::kP33) = design.q2;
  for (int step = kSettlingSteps; step > 0; --step) {
    state = image(state, std::remainder(phase - step * frequency, std::numbers::pi), frequency, design);
  }
  return state;
}

rigor::Matrix<9> jacobian(const State& state, double phase, double frequency,
                          const QuadratureEkfDesign<double>& design) {
  using Dual = rigor::Dual<double, 9>;
  const QuadratureEkfDesign<Dual> lifted{Dual(design.q1), Dual(design.q2), Dual(design.r),
                                         Dual(design.epsilon)};
  return rigor::linearize([&](const auto& x) { return image<Dual>(x, phase, frequency, lifted); }, state)
      .jacobian;
}

/// How the product of the Jacobians along an orbit grows or shrinks per step.
double observed_rate(const QuadratureEkfDesign<double>& design, double frequency, const PhaseSeries& curve) {
  constexpr int kSteps = 400;
  rigor::Matrix<9> product = rigor::Matrix<9>::Identity();
  double logarithm = 0.0;
  double phase = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    product = (jacobian(curve.at(phase), phase, frequency, design) * product).eval();
    const double size = product.cwiseAbs().maxCoeff();
    logarithm += std::log(size);
    product /= size;
    phase = std::remainder(phase + frequency, std::numbers::pi);
  }
  return std::exp(logarithm / kSteps);
}

/// One over the size of each component along the curve.
State weights_of(const PhaseSeries& curve) {
  State weights = State::Ones();
  const double z = std::sqrt(0.5 * (curve.mean(trackers::kP11) + curve.mean(trackers::kP22)));
  const double frequency = std::sqrt(curve.mean(trackers::kP33));
  weights(trackers::kFrequencyError) = z / frequency;
  weights(trackers::kP11) = weights(trackers::kP12) = weights(trackers::kP22) = 1.0 / (z * z);
  weights(trackers::kP13) = weights(trackers::kP23) = 1.0 / (z * frequency);
  weights(trackers::kP33) = 1.0 / (frequency * frequency);
  return weights;
}

}  // namespace

std::optional<PhaseSeries> propose_invariant_curve(const QuadratureEkfDesign<double>& design,
                                                   double frequency) {
  const rigor::NearestRounding outer;
  constexpr std::size_t kNodes = 4 * kHarmonics;
  std::vector<State> states(kNodes);
  const auto phase_of = [](std::size_t node) {
    return std::numbers::pi * static_cast<double>(node) / static_cast<double>(kNodes);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, kNodes), [&](const auto& range) {
    const rigor::NearestRounding nearest;
    for (std::size_t node = range.begin(); node < range.end(); ++node) {
      states[node] = settled_state(design, frequency, phase_of(node));
      if (design.epsilon == 0.0) {
        states[node].head<3>().setZero();
      }
    }
  });
  PhaseSeries curve{State::Zero(), std::vector<State>(kHarmonics, State::Zero()),
                    std::vector<State>(kHarmonics, State::Zero())};
  for (std::size_t node = 0; node < kNodes; ++node) {
    curve.mean += states[node] / static_cast<double>(kNodes);
    for (std::size_t k = 1; k <= kHarmonics; ++k) {
      const double angle = 2.0 * static_cast<double>(k) * phase_of(node);
      curve.cosines[k - 1] += states[node] * (2.0 * std::cos(angle) / static_cast<double>(kNodes));
      curve.sines[k - 1] += states[node] * (2.0 * std::sin(angle) / static_cast<double>(kNodes));
    }
  }
  if (!curve.mean.allFinite()) {
    return std::nullopt;
  }
  return curve;
}

std::optional<CurveCoordinates> propose_coordinates(const QuadratureEkfDesign<double>& design,
                                                    double frequency, const PhaseSeries& curve,
                                                    const std::vector<double>& phases) {
  const rigor::NearestRounding outer;
  CurveCoordinates coordinates;
  const double observed = observed_rate(design, frequency, curve);
  constexpr double kTooSlow = 0.995;  // beyond it the sum below needs too many terms
  if (!(observed < kTooSlow)) {
    return std::nullopt;
  }
  coordinates.rate = std::max(std::sqrt(observed), 0.5);
  const State weights = weights_of(curve);
  coordinates.matrices.resize(phases.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, phases.size()), [&](const auto& range) {
    const rigor::NearestRounding nearest;
    constexpr int kTerms = 8000;
    for (std::size_t cell = range.begin(); cell < range.end(); ++cell) {
      rigor::Matrix<9> product = rigor::Matrix<9>::Identity();
      rigor::Matrix<9> sum = rigor::Matrix<9>::Zero();
      double phase = phases[cell];
      for (int term = 0; term < kTerms; ++term) {
        const rigor::Matrix<9> weighted = weights.asDiagonal() * product;
        const rigor::Matrix<9> addend = weighted.transpose() * weighted;
        sum += addend;
        if (addend.trace() <= 1e-8 * sum.trace()) {
          break;
        }
        product = (jacobian(curve.at(phase), phase, frequency, design) * product / coordinates.rate).eval();
        phase = std::remainder(phase + frequency, std::numbers::pi);
      }
      const rigor::Matrix<9> factor = sum.llt().matrixU();
      coordinates.matrices[cell] = factor.inverse();
    }
  });
  for (const rigor::Matrix<9>& matrix : coordinates.matrices) {
    if (!matrix.allFinite()) {
      return std::nullopt;
    }
  }
  return coordinates;
}

}  // namespace veritrack::single_channel

#include "analysis/single_channel/curve_proposal.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::single_channel {

namespace {

using trackers::ToneModel;
using State = RotatingFrameState<double>;

constexpr int kSettlingSteps = 2000;

/// The image of X at `phase` after one sample without noise.
template <typename Scalar>
RotatingFrameState<Scalar> image(const RotatingFrameState<Scalar>& state, double phase, double frequency,
                                 const ToneModel<Scalar>& design) {
  return trackers::single_channel_map(
      state, {Scalar(phase + frequency), Scalar(0.0), Scalar(0.0), Scalar(frequency)}, design);
}

/// Where the simulated tracker is at `phase` after it started from the exact estimate.
State settled_state(const ToneModel<double>& design, double frequency, double phase) {
  State state = State::Zero();
  state(trackers::kP11) = state(trackers::kP22) = design.r + design.q1;
  state(trackers::kP33) = design.q2;
  for (int step = kSettlingSteps; step > 0; --step) {
    state = image(state, std::remainder(phase - step * frequency, std::numbers::pi), frequency, design);
  }
  return state;
}

rigor::Matrix<9> jacobian(const State& state, double phase, double frequency,
                          const ToneModel<double>& design) {
  using Dual = rigor::Dual<double, 9>;
  const ToneModel<Dual> lifted{Dual(design.q1), Dual(design.q2), Dual(design.r), Dual(design.epsilon)};
  return rigor::linearize([&](const auto& x) { return image<Dual>(x, phase, frequency, lifted); }, state)
      .jacobian;
}

/// How the product of the Jacobians along an orbit grows or shrinks per step.
double observed_rate(const ToneModel<double>& design, double frequency, const PhaseSeries& curve) {
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

/// The settled states as a trigonometric polynomial with so many harmonics.
PhaseSeries settled_curve(const ToneModel<double>& design, double frequency, std::size_t harmonics) {
  const std::size_t nodes = 4 * harmonics;
  std::vector<State> states(nodes);
  const auto phase_of = [nodes](std::size_t node) {
    return std::numbers::pi * static_cast<double>(node) / static_cast<double>(nodes);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes), [&](const auto& range) {
    const rigor::NearestRounding nearest;
    for (std::size_t node = range.begin(); node < range.end(); ++node) {
      states[node] = settled_state(design, frequency, phase_of(node));
      if (design.without_leak()) {
        states[node].head<3>().setZero();
      }
    }
  });
  PhaseSeries curve{State::Zero(), std::vector<State>(harmonics, State::Zero()),
                    std::vector<State>(harmonics, State::Zero())};
  for (std::size_t node = 0; node < nodes; ++node) {
    curve.mean += states[node] / static_cast<double>(nodes);
    for (std::size_t k = 1; k <= harmonics; ++k) {
      const double angle = 2.0 * static_cast<double>(k) * phase_of(node);
      curve.cosines[k - 1] += states[node] * (2.0 * std::cos(angle) / static_cast<double>(nodes));
      curve.sines[k - 1] += states[node] * (2.0 * std::sin(angle) / static_cast<double>(nodes));
    }
  }
  return curve;
}

constexpr std::size_t kManyHarmonics = 72;

/// Whether the last harmonics still matter.
bool needs_more_harmonics(const PhaseSeries& curve) {
  constexpr double kSmall = 1e-11;
  const double last =
      std::max(curve.cosines.back().cwiseAbs().maxCoeff(), curve.sines.back().cwiseAbs().maxCoeff());
  return last > kSmall * curve.mean.cwiseAbs().maxCoeff();
}

}  // namespace

std::optional<PhaseSeries> propose_invariant_curve(const ToneModel<double>& design, double frequency) {
  const rigor::NearestRounding outer;
  PhaseSeries curve = settled_curve(design, frequency, kFewHarmonics);
  if (needs_more_harmonics(curve)) {
    curve = settled_curve(design, frequency, kManyHarmonics);
  }
  if (!curve.mean.allFinite()) {
    return std::nullopt;
  }
  return curve;
}

std::optional<PhaseFamily> propose_invariant_curves(const ToneModel<double>& design,
                                                    const rigor::Interval& frequency) {
  const rigor::NearestRounding outer;
  const double center = midpoint(frequency);
  const auto middle = propose_invariant_curve(design, center);
  constexpr double kVeryNarrow = 1e-9;  // rad/sample
  const double half_width = 0.5 * (frequency.upper() - frequency.lower());
  if (!middle) {
    return std::nullopt;
  }
  if (!(half_width > kVeryNarrow)) {
    return PhaseFamily{center, 0.0, {*middle}};
  }
  // Interpolation at Chebyshev's points: terms[k] = sum_j weights(k, j) curve_j.
  constexpr int kTerms = 5;
  rigor::Matrix<kTerms> powers;
  std::vector<PhaseSeries> curves;
  curves.reserve(kTerms);
  for (int j = 0; j < kTerms; ++j) {
    const double t = std::cos(std::numbers::pi * (j + 0.5) / kTerms);
    for (int k = 0; k < kTerms; ++k) {
      powers(j, k) = std::pow(t, k);
    }
    curves.push_back(settled_curve(design, center + t * half_width, middle->cosines.size()));
  }
  const rigor::Matrix<kTerms> weights = powers.inverse();
  PhaseFamily family{center, 1.0 / half_width, {}};
  family.terms.reserve(kTerms);
  for (int k = 0; k < kTerms; ++k) {
    const std::size_t harmonics = middle->cosines.size();
    PhaseSeries term{State::Zero(), std::vector<State>(harmonics, State::Zero()),
                     std::vector<State>(harmonics, State::Zero())};
    for (int j = 0; j < kTerms; ++j) {
      const PhaseSeries& curve = curves[static_cast<std::size_t>(j)];
      term.mean += weights(k, j) * curve.mean;
      for (std::size_t i = 0; i < harmonics; ++i) {
        term.cosines[i] += weights(k, j) * curve.cosines[i];
        term.sines[i] += weights(k, j) * curve.sines[i];
      }
    }
    if (!term.mean.allFinite()) {
      return std::nullopt;
    }
    family.terms.push_back(std::move(term));
  }
  return family;
}

std::optional<CurveCoordinates> propose_coordinates(const ToneModel<double>& design, double frequency,
                                                    const PhaseSeries& curve,
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

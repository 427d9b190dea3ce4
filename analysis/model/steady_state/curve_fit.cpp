#include "analysis/model/steady_state/curve_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/larger_or_nan.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

namespace {

Eigen::VectorXd turns_of(const std::vector<int>& turns) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(turns.size()));
  std::copy(turns.begin(), turns.end(), result.begin());
  return result;
}

/// The size of each state on the curve; an angle's is at least 1. A state that is 0 there up to rounding,
/// such as a phase error, has the size that it gets from the others and the samples in a step.
Eigen::VectorXd sizes_on(const TrackedTone& tone, const NodeCurve& curve) {
  constexpr int kPhases = 12;
  constexpr double kNothing = 1e-9;
  Eigen::VectorXd sizes = curve.harmonics.cwiseAbs().rowwise().sum();
  for (std::size_t i = 0; i < curve.turns.size(); ++i) {
    auto& size = sizes[static_cast<Eigen::Index>(i)];
    size = curve.turns[i] != 0 ? std::max(size, 1.0) : size;
  }
  // The largest contribution of each state and of the samples to a next value.
  const Eigen::Index n = sizes.size();
  Eigen::MatrixXd shares;
  for (int j = 0; j < kPhases; ++j) {
    const double phase = 2.0 * std::numbers::pi * j / kPhases;
    const Eigen::VectorXd samples = samples_of(tone.signal, tone.amplitude, phase + curve.frequency);
    const Eigen::MatrixXd jacobian = tone.step.jacobian(state_at(curve, phase), samples).cwiseAbs();
    shares = shares.size() == 0 ? jacobian : shares.cwiseMax(jacobian);
  }
  // Another state, a delayed one, may get its size from such a state.
  for (Eigen::Index round = 0; round < n; ++round) {
    const Eigen::VectorXd given =
        shares.leftCols(n) * sizes + tone.amplitude * shares.rightCols(shares.cols() - n).rowwise().sum();
    for (Eigen::Index i = 0; i < n; ++i) {
      sizes[i] = sizes[i] < kNothing * given[i] ? given[i] : sizes[i];
    }
  }
  return sizes.cwiseMax(1e-12 * std::max(1.0, sizes.maxCoeff()));
}

double largest(const Eigen::MatrixXd& residual, const Eigen::VectorXd& sizes) {
  return (sizes.cwiseInverse().asDiagonal() * residual.cwiseAbs()).maxCoeff();
}

/// This number of harmonics: zeros added or the last ones left out.
Eigen::MatrixXcd resized(const Eigen::MatrixXcd& harmonics, Eigen::Index columns) {
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(harmonics.rows(), columns);
  const Eigen::Index common = std::min(columns, harmonics.cols());
  result.leftCols(common) = harmonics.leftCols(common);
  return result;
}

/// Newton's method on a grid. False when it does not converge.
bool refine(const TrackedTone& tone, const PhaseGrid& grid, NodeCurve& curve) {
  constexpr int kSteps = 12;
  double last = INFINITY;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::MatrixXd residual = residual_of(tone, curve, grid);
    const double size = largest(residual, sizes_on(tone, curve));
    if (!std::isfinite(size)) {
      return false;
    }
    constexpr double kRounding = 1e-15;
    constexpr double kConverging = 1e-10;
    if (size < kRounding || (size < kConverging && size > 0.5 * last)) {
      return true;
    }
    const Cocycle cocycle(grid, curve.frequency, jacobians_along(tone, curve, grid), tone.step.states());
    if (!(cocycle.rate() < 1.0)) {
      return false;
    }
    curve.harmonics += harmonics_of(cocycle.bounded_solution(residual), grid.harmonics());
    last = size;
  }
  return false;
}

}  // namespace

Eigen::VectorXd state_at(const NodeCurve& curve, double phase) {
  return value_at(curve.harmonics, phase) + phase * turns_of(curve.turns);
}

Eigen::MatrixXd residual_of(const TrackedTone& tone, const NodeCurve& curve, const PhaseGrid& grid) {
  Eigen::MatrixXd result(curve.harmonics.rows(), grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    const double phase = grid.phase(j);
    const double next = phase + curve.frequency;
    result.col(j) = tone.step.next(state_at(curve, phase), samples_of(tone.signal, tone.amplitude, next)) -
                    state_at(curve, next);
  }
  return result;
}

Eigen::MatrixXd jacobians_along(const TrackedTone& tone, const NodeCurve& curve, const PhaseGrid& grid) {
  const int n = tone.step.states();
  Eigen::MatrixXd result(n * n, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    const double phase = grid.phase(j);
    const Eigen::VectorXd samples = samples_of(tone.signal, tone.amplitude, phase + curve.frequency);
    const Eigen::MatrixXd jacobian = tone.step.jacobian(state_at(curve, phase), samples).leftCols(n);
    result.col(j) = jacobian.reshaped();
  }
  return result;
}

std::optional<NodeCurve> fit_curve_at(const TrackedTone& tone, double frequency, const SteadyState& settled,
                                      int most_harmonics) {
  const rigor::NearestRounding nearest;
  NodeCurve curve{frequency, settled.turns, harmonics_of(settled.states, 6), 0.0};
  std::optional<NodeCurve> best;
  for (int harmonics = 6; harmonics <= most_harmonics; harmonics *= 2) {
    const PhaseGrid grid(harmonics);
    curve.harmonics = resized(curve.harmonics, harmonics + 1);
    if (!refine(tone, grid, curve)) {
      // Too few harmonics may be why.
      curve.harmonics = harmonics_of(settled.states, harmonics);
      continue;
    }
    // The grid's own phases do not show the error between them.
    const double error = largest(residual_of(tone, curve, PhaseGrid(harmonics + 7)), sizes_on(tone, curve));
    curve.residual = error;
    if (std::isfinite(error) && (!best || error < best->residual)) {
      best = curve;
    }
    constexpr double kExact = 2e-14;
    if (error < kExact || (best && best->residual < 1e-12 && error > 0.5 * best->residual && error < 1e-13)) {
      break;
    }
  }
  constexpr double kUseful = 1e-3;
  return best && best->residual < kUseful ? best : std::nullopt;
}

const std::array<double, kNodes>& node_places() {
  static const std::array<double, kNodes> places = [] {
    std::array<double, kNodes> result{};
    for (std::size_t j = 0; j < result.size(); ++j) {
      result[j] = -std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / kNodes);
    }
    result[kNodes / 2] = 0.0;
    return result;
  }();
  return places;
}

const Eigen::Matrix<double, kNodes, kNodes>& node_weights() {
  static const Eigen::Matrix<double, kNodes, kNodes> weights = [] {
    Eigen::Matrix<double, kNodes, kNodes> powers;
    for (int j = 0; j < kNodes; ++j) {
      for (int d = 0; d < kNodes; ++d) {
        powers(j, d) = std::pow(node_places()[static_cast<std::size_t>(j)], d);
      }
    }
    return Eigen::Matrix<double, kNodes, kNodes>(rigor::approximate_inverse(powers));
  }();
  return weights;
}

NodeCurve CurveFit::at(double z) const {
  NodeCurve curve{frequency + z * half_width, turns, coefficients.back(), 0.0};
  for (std::size_t d = coefficients.size() - 1; d-- > 0;) {
    curve.harmonics = (curve.harmonics * z + coefficients[d]).eval();
  }
  return curve;
}

Eigen::MatrixXcd CurveFit::slope_at(double z) const {
  Eigen::MatrixXcd slope = Eigen::MatrixXcd::Zero(coefficients[0].rows(), coefficients[0].cols());
  for (std::size_t d = 1; d < coefficients.size(); ++d) {
    const auto power = static_cast<double>(d);
    slope += power * std::pow(z, power - 1.0) / half_width * coefficients[d];
  }
  return slope;
}

namespace {

/// Leaves out coefficients far below the last digits of a state, and harmonics that are then empty.
void drop_small_harmonics(CurveFit& fit, const Eigen::VectorXd& sizes, double negligible) {
  Eigen::Index highest = 0;
  for (Eigen::MatrixXcd& coefficients : fit.coefficients) {
    for (Eigen::Index h = 0; h < coefficients.cols(); ++h) {
      for (Eigen::Index i = 0; i < coefficients.rows(); ++i) {
        if (std::abs(coefficients(i, h)) < negligible * sizes[i]) {
          coefficients(i, h) = 0.0;
        } else {
          highest = std::max(highest, h);
        }
      }
    }
  }
  for (Eigen::MatrixXcd& coefficients : fit.coefficients) {
    coefficients = coefficients.leftCols(highest + 1).eval();
  }
}

/// To first order, the distance of the estimates on the curve from those on the invariant curve at z.
double frequency_error_at(const TrackedTone& tone, const CurveFit& fit, double z) {
  const NodeCurve curve = fit.at(z);
  const PhaseGrid grid(static_cast<int>(curve.harmonics.cols()) + 4);
  const Cocycle cocycle(grid, curve.frequency, jacobians_along(tone, curve, grid), tone.step.states());
  const Eigen::MatrixXd change = cocycle.bounded_solution(residual_of(tone, curve, grid));
  double error = cocycle.rate() < 1.0 ? 0.0 : INFINITY;
  for (int j = 0; j < grid.size(); ++j) {
    const double here =
        std::fabs(tone.step.frequency_gradient(state_at(curve, grid.phase(j))).dot(change.col(j)));
    error = rigor::larger_or_nan(error, here);
  }
  return std::isfinite(error) ? error : INFINITY;
}

}  // namespace

std::optional<CurveFit> fit_curve(const TrackedTone& tone, double frequency, double half_width,
                                  const SteadyState& settled, double negligible, int nodes) {
  const rigor::NearestRounding nearest;
  if (!(half_width > 0.0) || nodes < 1 || nodes % 2 == 0) {
    throw std::invalid_argument("a cell of frequencies needs a width, and an odd number of nodes");
  }
  CurveFit fit;
  fit.frequency = frequency;
  fit.half_width = half_width;
  fit.turns = settled.turns;
  fit.nodes.reserve(static_cast<std::size_t>(nodes));
  Eigen::MatrixXd powers(nodes, nodes);
  Eigen::Index columns = 0;
  for (int j = 0; j < nodes; ++j) {
    const double z =
        2 * j + 1 == nodes ? 0.0 : -std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / nodes);
    for (int d = 0; d < nodes; ++d) {
      powers(j, d) = std::pow(z, d);
    }
    std::optional<NodeCurve> node = fit_curve_at(tone, frequency + z * half_width, settled);
    if (!node) {
      return std::nullopt;
    }
    columns = std::max(columns, node->harmonics.cols());
    fit.nodes.push_back(std::move(*node));
  }
  const rigor::SmallMatrix weights = rigor::approximate_inverse(powers);
  for (int d = 0; d < nodes; ++d) {
    Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(tone.step.states(), columns);
    for (int j = 0; j < nodes; ++j) {
      sum += weights(d, j) * resized(fit.nodes[static_cast<std::size_t>(j)].harmonics, columns);
    }
    fit.coefficients.push_back(std::move(sum));
  }
  drop_small_harmonics(fit, sizes_on(tone, fit.nodes[static_cast<std::size_t>(nodes / 2)]), negligible);
  for (const double z : {-1.0, -0.8, -0.3, 0.0, 0.3, 0.8, 1.0}) {
    fit.frequency_error = std::max(fit.frequency_error, frequency_error_at(tone, fit, z));
  }
  return fit;
}

}  // namespace veritrack::model

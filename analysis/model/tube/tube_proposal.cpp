#include "analysis/model/tube/tube_proposal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "analysis/model/filter/filter_fit.hpp"
#include "analysis/model/filter/filter_proposal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// Enough harmonics for the products of the Jacobians along the curve.
int grid_harmonics(const TrackedTone& tone, const NodeCurve& curve) {
  constexpr double kSmall = 1e-5;
  constexpr int kFewest = 12;
  constexpr int kMost = 64;
  const PhaseGrid fine(std::max<int>(kFewest, static_cast<int>(curve.harmonics.cols())));
  const MatrixXcd spectrum = harmonics_of(jacobians_along(tone, curve, fine), fine.harmonics());
  const Eigen::VectorXd sizes = spectrum.cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-300);
  int highest = 0;
  for (Index h = 0; h < spectrum.cols(); ++h) {
    const double share = spectrum.col(h).cwiseAbs().cwiseQuotient(sizes).maxCoeff();
    highest = share > kSmall ? static_cast<int>(h) : highest;
  }
  return std::clamp(2 * highest + 6, kFewest, kMost);
}

/// A shape over the cell: coefficients of z^d, n^2 x harmonics.
using ShapeFit = std::array<MatrixXcd, kNodes>;

/// The shapes of these parameters at the nodes, as polynomials in the frequency; their coefficients rounded
/// to 24 bits, without those that are too small to matter.
std::optional<ShapeFit> fit_shape(const TrackedTone& tone, const CurveFit& curve, const PhaseGrid& grid,
                                  const ShapeProposal& shape) {
  const int n = tone.step.states();
  std::array<MatrixXcd, kNodes> at_nodes;
  Eigen::VectorXd diagonal;
  for (std::size_t j = 0; j < at_nodes.size(); ++j) {
    const double z = node_places()[j];
    const CurveDynamics dynamics = follow_curve(tone, curve.at(z), curve.slope_at(z), grid);
    const auto factors = cholesky_factors(dynamics, shape.parameters);
    if (!factors || !factors->allFinite()) {
      return std::nullopt;
    }
    at_nodes[j] = harmonics_of(*factors, shape.harmonics);
    if (z == 0.0) {
      const MatrixXd mean = factors->rowwise().mean().reshaped(n, n);
      diagonal = mean.diagonal();
    }
  }
  constexpr double kNegligible = 1e-6;
  ShapeFit fit;
  for (int d = 0; d < kNodes; ++d) {
    MatrixXcd& sum = fit[static_cast<std::size_t>(d)];
    sum = MatrixXcd::Zero(n * n, shape.harmonics + 1);
    for (int j = 0; j < kNodes; ++j) {
      sum += node_weights()(d, j) * at_nodes[static_cast<std::size_t>(j)];
    }
    for (Index place = 0; place < sum.rows(); ++place) {
      for (Index h = 0; h < sum.cols(); ++h) {
        std::complex<double>& c = sum(place, h);
        const bool is_small = std::abs(c) < kNegligible * diagonal[place % n];
        c = is_small ? 0.0 : detail::rounded_to_24_bits(c);
      }
    }
  }
  return fit;
}

ShapeOnGrid shape_at(const ShapeFit& fit, const NodeCurve& curve, double z, const PhaseGrid& grid) {
  MatrixXcd harmonics = fit.back();
  for (int d = kNodes - 2; d >= 0; --d) {
    harmonics = (harmonics * z + fit[static_cast<std::size_t>(d)]).eval();
  }
  ShapeOnGrid shape{MatrixXd(harmonics.rows(), grid.size()), MatrixXd(harmonics.rows(), grid.size())};
  for (int j = 0; j < grid.size(); ++j) {
    shape.here.col(j) = value_at(harmonics, grid.phase(j));
    shape.next.col(j) = value_at(harmonics, grid.phase(j) + curve.frequency);
  }
  return shape;
}

Tube tube_of(const TrackedTone& tone, const CurveFit& curve, const ShapeFit& shape) {
  const int n = tone.step.states();
  Tube tube;
  tube.frequency = curve.frequency;
  tube.half_width = curve.half_width;
  tube.amplitude = tone.amplitude;
  tube.turns = curve.turns;
  tube.curve.reserve(static_cast<std::size_t>(n));
  tube.shape.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1) / 2);
  for (int i = 0; i < n; ++i) {
    tube.curve.push_back(detail::series_of(curve.coefficients, i));
    for (int j = 0; j <= i; ++j) {
      tube.shape.push_back(detail::series_of(shape, j * n + i));
    }
  }
  return tube;
}

/// The worse of both, number by number.
void make_worse(ShapeWorth& worth, const ShapeWorth& other) {
  worth.score = std::min(worth.score, other.score);
  worth.noise = std::min(worth.noise, other.noise);
  worth.slew = std::min(worth.slew, other.slew);
  worth.rate = std::max(worth.rate, other.rate);
  worth.reach = std::min(worth.reach, other.reach);
  worth.least_reach = std::min(worth.least_reach, other.least_reach);
  worth.start_share = std::min(worth.start_share, other.start_share);
}

/// Compares the tube with the exact shapes of its parameters between the nodes. False when it is invalid at
/// some frequency of the cell.
[[nodiscard]] bool judge(const TrackedTone& tone, const CurveFit& curve, const ShapeFit& fit,
                         const PhaseGrid& grid, const TubeSettings& settings, TubeProposal& proposal) {
  const ShapeParameters& parameters = proposal.shape.parameters;
  const bool is_long_run = settings.shape.objective == ShapeObjective::least_long_run_error;
  bool is_first = true;
  double highest = 0.0;
  for (const double z : {0.0, -1.0, -0.5, 0.5, 1.0}) {
    const NodeCurve here = curve.at(z);
    const CurveDynamics dynamics = follow_curve(tone, here, curve.slope_at(z), grid);
    const auto exact = shape_on_grid(dynamics, parameters, proposal.shape.harmonics);
    const auto best = exact ? worth_of(dynamics, *exact, parameters.weights, settings.shape) : std::nullopt;
    const auto worth = worth_of(dynamics, shape_at(fit, here, z, grid), parameters.weights, settings.shape);
    if (!best || !worth) {
      proposal.worth = {};
      return false;
    }
    proposal.loss = std::max(proposal.loss, 1.0 - std::exp(worth->score - best->score));
    if (is_first) {
      proposal.worth = *worth;
      highest = worth->score;
    }
    is_first = false;
    highest = std::max(highest, worth->score);
    make_worse(proposal.worth, *worth);
    proposal.variation = 1.0 - std::exp(proposal.worth.score - highest);
    // For a set for disturbances the guess is the level of the middle; for the others the one that fits all.
    if (settings.shape.objective == ShapeObjective::largest_starts) {
      proposal.worth.level = std::min(proposal.worth.level, worth->level);
    } else if (is_long_run) {
      proposal.worth.level = std::max(proposal.worth.level, worth->level);
    }
  }
  return true;
}

TubeProposal propose(const TrackedTone& tone, double frequency, double half_width,
                     const TubeSettings& settings, const std::optional<ShapeParameters>& nearby, bool keep) {
  if (!(half_width > 0.0 && frequency - half_width > 0.0 && frequency + half_width < std::numbers::pi)) {
    throw std::invalid_argument("a cell of frequencies must be within (0, pi)");
  }
  TubeProposal proposal;
  proposal.frequency = frequency;
  proposal.half_width = half_width;
  proposal.steady_state = find_steady_state(tone, frequency, settings.steady_state);
  if (proposal.steady_state.outcome != SteadyStateOutcome::settled) {
    return proposal;
  }
  // The omitted part of the curve adds up over 1/(1 - rate) samples.
  constexpr double kShare = 1e-3;
  const double negligible =
      std::max(1e-15, kShare * settings.largest_curve_error * (1.0 - proposal.steady_state.rate));
  const std::optional<CurveFit> curve =
      fit_curve(tone, frequency, half_width, proposal.steady_state, negligible);
  if (!curve) {
    proposal.outcome = TubeOutcome::no_curve;
    return proposal;
  }
  proposal.curve_error = curve->frequency_error;
  proposal.outcome = TubeOutcome::cell_too_wide;
  if (!(curve->frequency_error <= settings.largest_curve_error)) {
    return proposal;
  }
  if (tone.filter != nullptr) {
    propose_filter_tube(tone, *curve, settings, nearby, keep, proposal);
    return proposal;
  }
  const PhaseGrid grid(grid_harmonics(tone, curve->at(0.0)));
  const CurveDynamics dynamics = follow_curve(tone, curve->at(0.0), curve->slope_at(0.0), grid);
  if (nearby && keep) {
    proposal.shape.parameters = *nearby;
    proposal.shape.harmonics = std::min(settings.shape.harmonics, grid.harmonics());
  } else {
    ShapeSettings shape_settings = settings.shape;
    for (const double z : {-1.0, 1.0}) {
      const NodeCurve end = curve->at(z);
      const Cocycle cocycle(grid, end.frequency, jacobians_along(tone, end, grid), tone.step.states());
      shape_settings.largest_rate = std::max(shape_settings.largest_rate, cocycle.rate());
    }
    const auto shape = propose_shape(dynamics, shape_settings, nearby);
    if (!shape) {
      proposal.outcome = TubeOutcome::no_shape;
      return proposal;
    }
    proposal.shape = *shape;
  }
  const auto fit = fit_shape(tone, *curve, grid, proposal.shape);
  if (!fit) {
    proposal.outcome = TubeOutcome::no_shape;
    return proposal;
  }
  if (!judge(tone, *curve, *fit, grid, settings, proposal)) {
    proposal.outcome = TubeOutcome::no_common_shape;
    return proposal;
  }
  constexpr int kFewStates = 3;
  std::optional<CurveFit> fine;
  if (settings.fine_curve && tone.step.states() <= kFewStates) {
    fine = fit_curve(tone, frequency, half_width, proposal.steady_state, 1e-15, kFineNodes);
    proposal.curve_error =
        fine ? std::min(fine->frequency_error, curve->frequency_error) : proposal.curve_error;
  }
  const bool is_better = fine && fine->frequency_error < curve->frequency_error;
  proposal.tube = tube_of(tone, is_better ? *fine : *curve, *fit);
  if (proposal.loss <= settings.largest_loss && proposal.variation <= settings.largest_variation) {
    proposal.outcome = TubeOutcome::proposed;
  }
  return proposal;
}

}  // namespace

TubeProposal propose_tube(const TrackedTone& tone, double frequency, double half_width,
                          const TubeSettings& settings, const std::optional<ShapeParameters>& nearby,
                          bool keep) {
  const rigor::NearestRounding nearest;
  TubeProposal proposal = propose(tone, frequency, half_width, settings, nearby, keep);
  // A search that ran out of time proves nothing about the tracker.
  if (proposal.outcome != TubeOutcome::proposed &&
      (settings.shape.deadline.is_over() || settings.steady_state.deadline.is_over())) {
    proposal.outcome = TubeOutcome::time_limit;
  }
  return proposal;
}

}  // namespace veritrack::model

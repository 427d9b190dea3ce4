#include "analysis/model/gain/floquet_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/model/gain/floquet_nodes.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_matrix.hpp"
#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::model {

namespace {

using Complex = std::complex<double>;

/// The polynomials in z through values at the nodes: entry d of the result.
template <typename Matrix>
std::vector<Matrix> interpolated(const std::vector<Matrix>& values, const Eigen::MatrixXd& weights) {
  std::vector<Matrix> result;
  for (Eigen::Index d = 0; d < weights.rows(); ++d) {
    Matrix sum = Matrix::Zero(values[0].rows(), values[0].cols());
    for (std::size_t j = 0; j < values.size(); ++j) {
      sum += weights(d, static_cast<Eigen::Index>(j)) * values[j];
    }
    result.push_back(std::move(sum));
  }
  return result;
}

/// The series of one row; what is far below its size is left out.
PhaseSeries series_of(const std::vector<Eigen::MatrixXcd>& powers, Eigen::Index row, double negligible) {
  PhaseSeries series;
  double size = 0.0;
  for (const Eigen::MatrixXcd& each : powers) {
    size = std::max(size, each.row(row).cwiseAbs().maxCoeff());
  }
  for (Eigen::Index h = 0; h < powers[0].cols(); ++h) {
    std::vector<Complex> of_z;
    for (const Eigen::MatrixXcd& each : powers) {
      const Complex value = std::abs(each(row, h)) > negligible * size ? each(row, h) : Complex(0.0);
      of_z.push_back(h == 0 ? Complex(value.real()) : value);
    }
    while (!of_z.empty() && of_z.back() == Complex(0.0)) {
      of_z.pop_back();
    }
    series.coefficients.push_back(std::move(of_z));
  }
  while (!series.coefficients.empty() && series.coefficients.back().empty()) {
    series.coefficients.pop_back();
  }
  return series;
}

}  // namespace

std::optional<FloquetCell> propose_floquet_cell(const TrackedTone& tone, FloquetGauge gauge, double low,
                                                double high, double largest_mean_error) {
  constexpr int kFewestHarmonics = 24;
  constexpr int kMostHarmonics = 64;
  constexpr double kNegligible = 1e-13;
  const rigor::NearestRounding nearest;
  const double middle = 0.5 * (low + high);
  SteadyStateSettings settings;
  settings.largest_mean_error = largest_mean_error;
  const SteadyState settled = find_steady_state(tone, middle, settings);
  if (settled.outcome != SteadyStateOutcome::settled) {
    return std::nullopt;
  }
  const auto fit = fit_curve(tone, middle, std::max(high - middle, 1e-9), settled, 1e-15, kFineNodes);
  if (!fit) {
    return std::nullopt;
  }
  int harmonics = kFewestHarmonics;  // as many as the curve has
  for (const NodeCurve& each : fit->nodes) {
    harmonics = std::clamp(static_cast<int>(each.harmonics.cols()) - 1, harmonics, kMostHarmonics);
  }
  const auto nodes = floquet_nodes(tone, fit->nodes, gauge, harmonics);
  if (!nodes) {
    return std::nullopt;
  }
  std::vector<Eigen::MatrixXcd> bases;
  std::vector<Eigen::MatrixXd> matrices;
  Eigen::MatrixXd powers(kFineNodes, kFineNodes);
  for (int j = 0; j < kFineNodes; ++j) {
    bases.push_back((*nodes)[static_cast<std::size_t>(j)].basis);
    matrices.push_back((*nodes)[static_cast<std::size_t>(j)].matrix);
    const double z = 2 * j + 1 == kFineNodes
                         ? 0.0
                         : -std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / kFineNodes);
    for (int d = 0; d < kFineNodes; ++d) {
      powers(j, d) = std::pow(z, d);
    }
  }
  const Eigen::MatrixXd weights = rigor::approximate_inverse(powers);
  const auto basis = interpolated(bases, weights);
  const auto matrix = interpolated(matrices, weights);
  const auto n = static_cast<Eigen::Index>(tone.step.states());
  FloquetCell cell;
  cell.curve.frequency = fit->frequency;
  cell.curve.half_width = fit->half_width;
  cell.curve.amplitude = tone.amplitude;
  cell.curve.turns = fit->turns;
  for (Eigen::Index i = 0; i < n; ++i) {
    cell.curve.curve.push_back(series_of(fit->coefficients, i, 0.0));
  }
  for (Eigen::Index i = 0; i < n * n; ++i) {
    cell.basis.push_back(series_of(basis, i, kNegligible));
    std::vector<double> of_z;
    of_z.reserve(matrix.size());
    for (const Eigen::MatrixXd& each : matrix) {
      of_z.push_back(each(i / n, i % n));
    }
    cell.matrix.push_back(std::move(of_z));
  }
  return cell;
}

std::vector<std::complex<double>> floquet_multipliers(const FloquetCell& cell) {
  const auto n = static_cast<Eigen::Index>(cell.states());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n * n; ++i) {
    matrix(i / n, i % n) = cell.matrix[static_cast<std::size_t>(i)].front();
  }
  return rigor::eigenvalues_by_size(matrix);
}

}  // namespace veritrack::model

#include "analysis/model/gain/floquet_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

namespace {

using Complex = std::complex<double>;

/// X with e X B - B X = R, by elimination of the n^2 equations; false where there is no solution.
bool solve_sylvester(Complex e, const Eigen::MatrixXd& b, Eigen::MatrixXcd& x) {
  const auto n = b.rows();
  const auto size = n * n;
  Eigen::MatrixXcd a = Eigen::MatrixXcd::Zero(size, size + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index row = i * n + j;
      for (Eigen::Index k = 0; k < n; ++k) {
        a(row, i * n + k) += e * b(k, j);
        a(row, k * n + j) -= b(i, k);
      }
      a(row, size) = x(i, j);
    }
  }
  for (Eigen::Index p = 0; p < size; ++p) {
    Eigen::Index pivot = p;
    for (Eigen::Index i = p + 1; i < size; ++i) {
      pivot = std::abs(a(i, p)) > std::abs(a(pivot, p)) ? i : pivot;
    }
    if (!(std::abs(a(pivot, p)) > 1e-14)) {
      return false;
    }
    a.row(p).swap(a.row(pivot));
    for (Eigen::Index i = 0; i < size; ++i) {
      if (i != p) {
        const Complex factor = a(i, p) / a(p, p);
        for (Eigen::Index j = p; j <= size; ++j) {
          a(i, j) -= factor * a(p, j);
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      x(i, j) = a(i * n + j, size) / a(i * n + j, i * n + j);
    }
  }
  return true;
}

/// Matrices on a grid of phases, column-major in columns.
Eigen::Map<Eigen::MatrixXd> matrix_at(Eigen::MatrixXd& values, int j, Eigen::Index n) {
  return {values.col(j).data(), n, n};
}

}  // namespace

std::optional<FloquetNode> floquet_node(const TrackedTone& tone, const NodeCurve& curve, int harmonics) {
  constexpr int kMostSteps = 30;
  const auto n = static_cast<Eigen::Index>(tone.step.states());
  const PhaseGrid grid(harmonics);
  Eigen::MatrixXd a = jacobians_along(tone, curve, grid);
  const Eigen::MatrixXd shift = grid.shift(curve.frequency);
  Eigen::MatrixXd basis(n * n, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    matrix_at(basis, j, n).setIdentity();
  }
  Eigen::MatrixXd mean;
  double change = INFINITY;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::MatrixXd there = basis * shift;
    Eigen::MatrixXd seen(n * n, grid.size());
    for (int j = 0; j < grid.size(); ++j) {
      matrix_at(seen, j, n) = rigor::product(rigor::approximate_inverse(matrix_at(there, j, n)),
                                             rigor::product(matrix_at(a, j, n), matrix_at(basis, j, n)));
    }
    const Eigen::MatrixXcd waves = harmonics_of(seen, harmonics);
    const Eigen::VectorXd first = waves.col(0).real();
    mean = Eigen::Map<const Eigen::MatrixXd>(first.data(), n, n);
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n * n, grid.size());
    const double before = change;
    change = 0.0;
    for (int h = 1; h <= harmonics; ++h) {
      const Eigen::VectorXcd column = waves.col(h);
      Eigen::MatrixXcd x = Eigen::Map<const Eigen::MatrixXcd>(column.data(), n, n);
      if (!(x.cwiseAbs().maxCoeff() > 1e-17)) {
        continue;
      }
      if (!solve_sylvester(std::polar(1.0, h * curve.frequency), mean, x)) {
        return std::nullopt;
      }
      for (int j = 0; j < grid.size(); ++j) {
        matrix_at(factor, j, n) += (x * std::polar(1.0, h * grid.phase(j))).real();
      }
    }
    for (int j = 0; j < grid.size(); ++j) {
      const Eigen::MatrixXd more = rigor::product(matrix_at(basis, j, n), matrix_at(factor, j, n));
      change = std::max(change, matrix_at(factor, j, n).cwiseAbs().maxCoeff());
      matrix_at(basis, j, n) += more;
    }
    if (!(change < 1e6)) {
      return std::nullopt;
    }
    if (change < 1e-11 || (step > 6 && change < 1e-8 && change >= 0.5 * before)) {
      break;
    }
  }
  if (!(change < 1e-7)) {
    return std::nullopt;
  }
  FloquetNode node{Eigen::MatrixXcd(n * n, harmonics + 1), mean};
  const Eigen::MatrixXcd waves = harmonics_of(basis, harmonics);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      node.basis.row(i * n + j) = waves.row(j * n + i);
    }
  }
  return node;
}

namespace {

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

std::optional<FloquetCell> propose_floquet_cell(const TrackedTone& tone, double low, double high) {
  constexpr int kHarmonics = 24;
  constexpr double kNegligible = 1e-13;
  const rigor::NearestRounding nearest;
  const double middle = 0.5 * (low + high);
  const SteadyState settled = find_steady_state(tone, middle);
  if (settled.outcome != SteadyStateOutcome::settled) {
    return std::nullopt;
  }
  const auto fit = fit_curve(tone, middle, std::max(high - middle, 1e-9), settled, 1e-15, kFineNodes);
  if (!fit) {
    return std::nullopt;
  }
  std::vector<Eigen::MatrixXcd> bases;
  std::vector<Eigen::MatrixXd> matrices;
  Eigen::MatrixXd powers(kFineNodes, kFineNodes);
  for (int j = 0; j < kFineNodes; ++j) {
    const NodeCurve& curve = fit->nodes[static_cast<std::size_t>(j)];
    const auto node = floquet_node(tone, curve, kHarmonics);
    if (!node) {
      return std::nullopt;
    }
    bases.push_back(node->basis);
    matrices.push_back(node->matrix);
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

}  // namespace veritrack::model

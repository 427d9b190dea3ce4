#include "analysis/model/filter/filter_fit.hpp"

#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>

#include "analysis/model/steady_state/phase_grid.hpp"

namespace veritrack::model::detail {

using Eigen::MatrixXcd;

namespace {

double rounded_to_24_bits(double x) {
  constexpr std::uint64_t kDropped = (std::uint64_t{1} << 29U) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) + kDropped / 2 + 1) & ~kDropped);
}

}  // namespace

std::complex<double> rounded_to_24_bits(std::complex<double> c) {
  return {rounded_to_24_bits(c.real()), rounded_to_24_bits(c.imag())};
}

VectorXd triangle_of(const MatrixXd& matrix) {
  const Index n = matrix.rows();
  VectorXd entries(n * (n + 1) / 2);
  Index place = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      entries[place++] = matrix(i, j);
    }
  }
  return entries;
}

MatrixXd matrix_of_triangle(const VectorXd& entries, Index n, bool is_symmetric) {
  MatrixXd matrix = MatrixXd::Zero(n, n);
  Index place = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      matrix(i, j) = entries[place++];
      if (is_symmetric) {
        matrix(j, i) = matrix(i, j);
      }
    }
  }
  return matrix;
}

PhaseFit fit_of(const std::array<MatrixXd, kNodes>& values, int harmonics, double scale) {
  std::array<MatrixXcd, kNodes> at_nodes;
  for (std::size_t j = 0; j < at_nodes.size(); ++j) {
    at_nodes.at(j) = harmonics_of(values.at(j), harmonics) * scale;
  }
  PhaseFit fit;
  for (int d = 0; d < kNodes; ++d) {
    MatrixXcd sum = MatrixXcd::Zero(at_nodes[0].rows(), at_nodes[0].cols());
    for (int j = 0; j < kNodes; ++j) {
      sum += node_weights()(d, j) * at_nodes.at(static_cast<std::size_t>(j));
    }
    const double size = at_nodes[0].cwiseAbs().maxCoeff();
    constexpr double kNegligible = 1e-7;
    for (Index i = 0; i < sum.size(); ++i) {
      std::complex<double>& c = sum(i);
      c = std::abs(c) < kNegligible * size ? 0.0 : rounded_to_24_bits(c);
    }
    fit.at(static_cast<std::size_t>(d)) = sum;
  }
  return fit;
}

VectorXd value_of(const PhaseFit& fit, double z, double phase) {
  MatrixXcd harmonics = fit.back();
  for (int d = kNodes - 2; d >= 0; --d) {
    harmonics = (harmonics * z + fit.at(static_cast<std::size_t>(d))).eval();
  }
  return value_at(harmonics, phase);
}

PhaseSeries series_of(std::span<const MatrixXcd> coefficients, Index row) {
  PhaseSeries series;
  series.coefficients.resize(static_cast<std::size_t>(coefficients[0].cols()));
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    auto& powers = series.coefficients[h];
    powers.reserve(coefficients.size());
    for (const MatrixXcd& matrix : coefficients) {
      powers.push_back(matrix(row, static_cast<Index>(h)));
    }
    while (!powers.empty() && powers.back() == 0.0) {
      powers.pop_back();
    }
  }
  while (!series.coefficients.empty() && series.coefficients.back().empty()) {
    series.coefficients.pop_back();
  }
  return series;
}

std::vector<PhaseSeries> series_of_fit(const PhaseFit& fit) {
  std::vector<PhaseSeries> all;
  for (Index row = 0; row < fit[0].rows(); ++row) {
    all.push_back(series_of(fit, row));
  }
  return all;
}

}  // namespace veritrack::model::detail

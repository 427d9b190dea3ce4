// Series over the phase and the frequency through the matrices of a filter's tube on a grid, for proposals.
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "analysis/model/filter/filter_numbers.hpp"
#include "analysis/model/step/tube.hpp"

namespace veritrack::model::detail {

/// The lower triangle row by row, and the matrix from one: symmetric, or lower triangular.
[[nodiscard]] VectorXd triangle_of(const MatrixXd& matrix);
[[nodiscard]] MatrixXd matrix_of_triangle(const VectorXd& entries, Index n, bool is_symmetric);

/// Both parts to 24 bits, a tie away from zero. Not by way of float: g++ 12 skips the pair of conversions
/// where it puts both parts into one register.
[[nodiscard]] std::complex<double> rounded_to_24_bits(std::complex<double> c);

/// Coefficients of z^d, rows x harmonics.
using PhaseFit = std::array<Eigen::MatrixXcd, kNodes>;

/// Through values at the nodes, each rows x phases of a grid; times `scale`, rounded to 24 bits.
[[nodiscard]] PhaseFit fit_of(const std::array<MatrixXd, kNodes>& values, int harmonics, double scale);
/// A column of its values.
[[nodiscard]] VectorXd value_of(const PhaseFit& fit, double z, double phase);
/// The series of one row, from coefficients of z^d, each rows x harmonics; zeros at its end are left out.
[[nodiscard]] PhaseSeries series_of(std::span<const Eigen::MatrixXcd> coefficients, Index row);
/// A series for each row.
[[nodiscard]] std::vector<PhaseSeries> series_of_fit(const PhaseFit& fit);

}  // namespace veritrack::model::detail

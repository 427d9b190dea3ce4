// The controllers of sections 5.4.1 and 5.4.2 of the thesis, ideal and as printed: their responses, poles and
// residues. Parameters are numerator, then denominator, in powers of z^-1.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace veritrack::reports::vibration {

/// The ideal controller of order 3.
[[nodiscard]] Eigen::VectorXd ideal();
/// The limit of Table 5.1, over rho.
[[nodiscard]] Eigen::VectorXd table_5_1();
/// The limit of Table 5.2.
[[nodiscard]] Eigen::VectorXd table_5_2();

/// Numerator by denominator at a frequency, rad/sample: as the thesis draws it.
[[nodiscard]] std::complex<double> response(const Eigen::VectorXd& parameters, double frequency);

/// The numerator at the vibration over the denominator there, without its factor 1 - 2 cos(omega) z^-1 +
/// z^-2.
[[nodiscard]] std::complex<double> residue(const Eigen::VectorXd& parameters);

/// The poles in z, the real ones first in rising order.
[[nodiscard]] std::vector<std::complex<double>> poles_of(const Eigen::VectorXd& parameters);

/// The largest |z| of a pole of the loop that the controller, held constant, closes around section 5.4's
/// plant.
[[nodiscard]] double loop_radius(const Eigen::VectorXd& parameters);

}  // namespace veritrack::reports::vibration

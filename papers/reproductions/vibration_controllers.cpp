#include "papers/reproductions/vibration_controllers.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "papers/experiments/vibration_runs.hpp"
#include "papers/reproductions/vibration_printed.hpp"

namespace veritrack::reports::vibration {

namespace {

using Complex = std::complex<double>;

/// sum c_i z^-i at z = e^{i omega}.
Complex polynomial_at(const Eigen::VectorXd& coefficients, double frequency) {
  const Complex back = std::polar(1.0, -frequency);
  Complex power = 1.0;
  Complex sum = 0.0;
  for (const double coefficient : coefficients) {
    sum += coefficient * power;
    power *= back;
  }
  return sum;
}

}  // namespace

Eigen::VectorXd ideal() {
  return experiments::ideal_parameters(experiments::VibrationOrder::three);
}

Eigen::VectorXd table_5_2() {
  Eigen::VectorXd result(10);
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    result(i) = printed::kTable52Numbers.at(static_cast<std::size_t>(i)).value();
  }
  return result;
}

Eigen::VectorXd table_5_1() {
  Eigen::VectorXd result(6);
  result << printed::kNumerator51[0].value(), printed::kNumerator51[1].value(),
      printed::kNumerator51[2].value(), printed::kLeading51, printed::kDenominator51[0].value(),
      printed::kDenominator51[1].value();
  return result;
}

std::complex<double> response(const Eigen::VectorXd& parameters, double frequency) {
  const Eigen::Index order = parameters.size() / 2;
  return polynomial_at(parameters.head(order), frequency) / polynomial_at(parameters.tail(order), frequency);
}

std::complex<double> residue(const Eigen::VectorXd& parameters) {
  const Eigen::Index order = parameters.size() / 2;
  std::vector<double> rest(parameters.data() + order, parameters.data() + 2 * order);
  const double twice = 2.0 * std::cos(experiments::kVibration);
  for (std::size_t i = 0; i + 2 < rest.size(); ++i) {
    rest[i + 1] += twice * rest[i];
    rest[i + 2] -= rest[i];
  }
  const Eigen::VectorXd quotient = Eigen::Map<Eigen::VectorXd>(rest.data(), order - 2);
  return polynomial_at(parameters.head(order), experiments::kVibration) /
         polynomial_at(quotient, experiments::kVibration);
}

namespace {

/// Where b_0 z^n + ... + b_n vanishes.
Eigen::VectorXcd zeros_of(const Eigen::VectorXd& b) {
  const Eigen::Index degree = b.size() - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  companion.row(0) = -b.tail(degree).transpose() / b(0);
  companion.diagonal(-1).setOnes();
  return companion.eigenvalues();
}

}  // namespace

double loop_radius(const Eigen::VectorXd& parameters) {
  const Eigen::Index order = parameters.size() / 2;
  // A_1 D + 3 z^-1 N, A_1 = 1 - 0.5 z^-1.
  Eigen::VectorXd loop = Eigen::VectorXd::Zero(order + 1);
  loop.head(order) = parameters.tail(order);
  loop.tail(order) += 3.0 * parameters.head(order) - 0.5 * parameters.tail(order);
  return zeros_of(loop).cwiseAbs().maxCoeff();
}

std::vector<std::complex<double>> poles_of(const Eigen::VectorXd& parameters) {
  const Eigen::VectorXcd roots = zeros_of(parameters.tail(parameters.size() / 2));
  std::vector<Complex> result(roots.data(), roots.data() + roots.size());
  std::sort(result.begin(), result.end(), [](const Complex& x, const Complex& y) {
    const bool x_real = std::fabs(x.imag()) < 1e-9;
    const bool y_real = std::fabs(y.imag()) < 1e-9;
    return x_real != y_real ? x_real : std::pair(x.real(), x.imag()) < std::pair(y.real(), y.imag());
  });
  return result;
}

}  // namespace veritrack::reports::vibration

#include "analysis/linear/loop_response.hpp"

#include <Eigen/LU>
#include <cmath>

#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::linear {

LoopMode mode_of(const std::complex<double>& multiplier) {
  constexpr double kNothing = 1e-12;
  LoopMode mode{multiplier, 0.0, 1.0, 0.0};
  if (std::abs(multiplier) > kNothing) {
    const std::complex<double> s = std::log(multiplier);
    mode.time_constant = -1.0 / s.real();
    mode.frequency = std::abs(s);
    mode.damping = mode.frequency > 0.0 ? -s.real() / mode.frequency : 0.0;
  }
  return mode;
}

std::vector<LoopMode> modes_of(const LinearLoop& loop) {
  std::vector<LoopMode> modes;
  for (const std::complex<double>& z : rigor::eigenvalues_by_size(loop.a)) {
    if (z.imag() < 0.0) {
      continue;  // the other one of a pair
    }
    modes.push_back(mode_of(z));
  }
  return modes;
}

double noise_deviation(const LinearLoop& loop, std::size_t samples) {
  double sum = 0.0;
  Eigen::RowVectorXd row = loop.estimate;
  for (std::size_t k = 0; k < samples; ++k) {
    sum += (row * loop.noise).squaredNorm();
    row = (row * loop.a).eval();
  }
  return std::sqrt(sum);
}

std::vector<double> followed_share(const LinearLoop& loop, std::size_t samples) {
  std::vector<double> share;
  Eigen::VectorXd state = loop.step;
  for (std::size_t k = 0; k < samples; ++k) {
    share.push_back(1.0 + loop.estimate.dot(state));
    state = (loop.a * state).eval();
  }
  return share;
}

double noise_gain(const LinearLoop& loop, double frequency) {
  const Eigen::Index n = loop.a.rows();
  const Eigen::MatrixXcd shifted =
      std::polar(1.0, frequency) * Eigen::MatrixXcd::Identity(n, n) - loop.a.cast<std::complex<double>>();
  const Eigen::MatrixXcd columns = loop.noise.cast<std::complex<double>>();
  const Eigen::MatrixXcd response = shifted.partialPivLu().solve(columns);
  return loop.tone_share * (loop.estimate.cast<std::complex<double>>() * response).norm();
}

}  // namespace veritrack::linear

#include "analysis/model/steady_state/phase_grid.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace veritrack::model {

double PhaseGrid::phase(int j) const {
  return 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(size());
}

Eigen::MatrixXd PhaseGrid::shift(double shift, int harmonics) const {
  // Entry (k, j) depends on j - k only: one row of it is summed up.
  const int count = size();
  const int highest = std::min(harmonics, harmonics_);
  Eigen::VectorXd kernel(count);
  for (int d = 0; d < count; ++d) {
    double sum = 1.0;
    for (int h = 1; h <= highest; ++h) {
      sum += 2.0 * std::cos(static_cast<double>(h) * (phase(d) + shift));
    }
    kernel[d] = sum / static_cast<double>(count);
  }
  Eigen::MatrixXd result(count, count);
  for (int k = 0; k < count; ++k) {
    for (int j = 0; j < count; ++j) {
      result(k, j) = kernel[(j - k + count) % count];
    }
  }
  return result;
}

Eigen::MatrixXcd harmonics_of(const Eigen::MatrixXd& values, int harmonics) {
  const auto count = static_cast<int>(values.cols());
  Eigen::MatrixXcd turns(count, harmonics + 1);
  for (int j = 0; j < count; ++j) {
    for (int h = 0; h <= harmonics; ++h) {
      const auto place = static_cast<long long>(h) * j % count;
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(place) / count;
      turns(j, h) = std::polar((h == 0 ? 1.0 : 2.0) / count, -angle);
    }
  }
  return values * turns;
}

Eigen::VectorXd value_at(const Eigen::MatrixXcd& coefficients, double phase) {
  Eigen::VectorXd result = coefficients.col(0).real();
  for (Eigen::Index h = 1; h < coefficients.cols(); ++h) {
    result += (coefficients.col(h) * std::polar(1.0, static_cast<double>(h) * phase)).real();
  }
  return result;
}

}  // namespace veritrack::model

#include "analysis/model/steady_state/cocycle.hpp"

#include <cmath>
#include <limits>

namespace veritrack::model {

namespace {

/// A slower decay than that of 2^kDoublings samples is not resolved.
constexpr int kDoublings = 20;

auto matrix_at(const Eigen::MatrixXd& field, Eigen::Index j, int n) {
  return Eigen::Map<const Eigen::MatrixXd>(field.col(j).data(), n, n);
}
auto matrix_at(Eigen::MatrixXd& field, Eigen::Index j, int n) {
  return Eigen::Map<Eigen::MatrixXd>(field.col(j).data(), n, n);
}

}  // namespace

Cocycle::Cocycle(const PhaseGrid& grid, double frequency, const Eigen::MatrixXd& jacobians, int states)
    : grid_(grid), frequency_(frequency), states_(states), jacobians_(jacobians), logarithms_{0.0} {
  constexpr double kVanished = -200.0;  // of the logarithm of a product
  Eigen::MatrixXd last = jacobians;
  for (int k = 0; k < kDoublings; ++k) {
    const double samples = std::ldexp(1.0, k);
    shifts_.push_back(grid_.shift(std::remainder(samples * frequency, 2.0 * M_PI)));
    later_.emplace_back(last * shifts_.back());
    const Eigen::MatrixXd& later = later_.back();
    Eigen::MatrixXd next(last.rows(), last.cols());
    for (Eigen::Index j = 0; j < last.cols(); ++j) {
      matrix_at(next, j, states_).noalias() = matrix_at(later, j, states_) * matrix_at(last, j, states_);
    }
    const double size = next.cwiseAbs().maxCoeff();
    if (!std::isfinite(size)) {
      rate_ = std::numeric_limits<double>::quiet_NaN();
      return;
    }
    // The growth over the second half of the samples: free of the size of transients.
    const double logarithm = 2.0 * logarithms_.back() + (size > 0.0 ? std::log(size) : kVanished);
    rate_ = std::exp((logarithm - logarithms_.back()) / samples);
    last = size > 0.0 ? Eigen::MatrixXd(next / size) : next;
    logarithms_.push_back(logarithm);
    if (logarithm < kVanished) {
      break;
    }
  }
}

Eigen::MatrixXd Cocycle::bounded_solution(const Eigen::MatrixXd& source) const {
  Eigen::MatrixXd sum = source;
  for (std::size_t k = 0; k < shifts_.size(); ++k) {
    Eigen::MatrixXd next = sum * shifts_[k];
    const double size = std::exp(logarithms_[k]);
    for (Eigen::Index j = 0; j < sum.cols(); ++j) {
      next.col(j) += size * (matrix_at(later_[k], j, states_) * sum.col(j));
    }
    sum = next;
  }
  // sum(phi) is the solution at phi + 2^k omega.
  const double samples = std::ldexp(1.0, static_cast<int>(shifts_.size()));
  return sum * grid_.shift(-std::remainder(samples * frequency_, 2.0 * M_PI));
}

Eigen::MatrixXd Cocycle::lyapunov_solution(double lambda, const Eigen::MatrixXd& source) const {
  constexpr double kSmall = 1e-11;
  Eigen::MatrixXd sum = source;
  std::size_t k = 0;
  for (; k < shifts_.size(); ++k) {
    const double samples = std::ldexp(1.0, static_cast<int>(k));
    const double weight = std::exp(2.0 * logarithms_[k] - samples * std::log(lambda));
    Eigen::MatrixXd next = sum * shifts_[k];
    for (Eigen::Index j = 0; j < sum.cols(); ++j) {
      const auto product = matrix_at(later_[k], j, states_);
      matrix_at(next, j, states_).noalias() +=
          weight * (product * matrix_at(sum, j, states_) * product.transpose());
    }
    sum = next;
    if (weight < kSmall) {
      ++k;
      break;
    }
  }
  const double samples = std::ldexp(1.0, static_cast<int>(k));
  return sum * grid_.shift(-std::remainder(samples * frequency_, 2.0 * M_PI));
}

}  // namespace veritrack::model

#include "analysis/model/disturbance_split.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "analysis/search/golden_section.hpp"

namespace veritrack::model {

namespace {

double largest_eigenvalue_about(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

double logistic(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

/// Splits are searched in their logits, which reach both ends: slow trackers need t close to 1.
constexpr double kFarthestLogit = 20.0;

/// Where a function of the logit with one valley is least, and its value there.
template <typename Function>
search::GoldenPoint lowest_of(const Function& value) {
  constexpr int kSteps = 22;
  return search::golden_section(-kFarthestLogit, kFarthestLogit, kSteps, value);
}

}  // namespace

double proposed_split(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v) {
  if (v.size() == 0 || x.size() == 0) {
    return 0.5;
  }
  const auto value = [&](double logit) {
    const double t = logistic(logit);
    return largest_eigenvalue_about(x / t + v / (1.0 - t));
  };
  // Convex in t, so one valley in the logit.
  double low = -kFarthestLogit;
  double high = kFarthestLogit;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const double first = low + (high - low) / 3.0;
    const double second = high - (high - low) / 3.0;
    if (value(first) < value(second)) {
      high = second;
    } else {
      low = first;
    }
  }
  return logistic((low + high) / 2.0);
}

std::array<double, 3> proposed_shares(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v,
                                      const Eigen::MatrixXd& w) {
  if (x.size() == 0 || v.size() == 0 || w.size() == 0) {
    return {1.0, 1.0, 1.0};
  }
  // Convex in (t1, t2): what is least over t2 is convex in t1.
  const auto of_others = [&](double logit_of_x) {
    const double t = logistic(logit_of_x);
    const double rest = logistic(-logit_of_x);
    return lowest_of([&](double logit) {
      return largest_eigenvalue_about(x / t + v / (rest * logistic(logit)) + w / (rest * logistic(-logit)));
    });
  };
  const double logit_of_x = lowest_of([&](double logit) { return of_others(logit).cost; }).point;
  const double logit_of_v = of_others(logit_of_x).point;
  const double rest = logistic(-logit_of_x);
  return {logistic(logit_of_x), rest * logistic(logit_of_v), rest * logistic(-logit_of_v)};
}

}  // namespace veritrack::model

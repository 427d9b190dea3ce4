#include "analysis/model/step/disturbance_split.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::model {

namespace {

/// The states of a tracker and the samples of a filter. (Ball models have at most 16 and 3.)
using Square = rigor::SmallMatrix;

double logistic(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

/// Splits are searched in their logits, which reach both ends: slow trackers need t close to 1.
constexpr double kFarthestLogit = 20.0;

/// The place where a function of the logit with one valley is least, and its value there.
template <typename Function>
search::GoldenPoint lowest_of(const Function& value, int steps = 22) {
  return search::golden_section(-kFarthestLogit, kFarthestLogit, steps, value);
}

/// Shares t for which the largest eigenvalue of sum A_i/t_i is least, up to one in a million; empty when they
/// are not found soon. For the eigenvector p of that eigenvalue, (sum sqrt(p'A_i p))^2 is at most the value
/// for any shares, and shares in proportion to these roots reach it along p.
template <std::size_t kParts>
std::optional<std::array<double, kParts>> soon_found(
    const std::array<const Eigen::MatrixXd*, kParts>& parts) {
  constexpr int kRounds = 16;
  constexpr int kWholeSteps = 2;
  constexpr double kClose = 1e-6;
  constexpr double kLeastShare = 1e-9;
  std::array<double, kParts> shares;
  shares.fill(1.0 / static_cast<double>(kParts));
  double bound = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    Square sum = *parts[0] / shares[0];
    for (std::size_t i = 1; i < kParts; ++i) {
      sum += *parts.at(i) / shares.at(i);
    }
    const rigor::Eigensystem system = rigor::symmetric_eigensystem(sum);
    const Eigen::Index last = sum.rows() - 1;
    const auto p = system.vectors.col(last);
    std::array<double, kParts> lengths;
    double whole = 0.0;
    for (std::size_t i = 0; i < kParts; ++i) {
      lengths.at(i) = std::sqrt(std::max(0.0, p.dot(*parts.at(i) * p)));
      whole += lengths.at(i);
    }
    bound = std::max(bound, whole * whole);
    if (system.values[last] <= (1.0 + kClose) * bound) {
      return shares;
    }
    const double step = round < kWholeSteps ? 1.0 : 0.5;
    double total = 0.0;
    for (std::size_t i = 0; i < kParts; ++i) {
      const double there = std::max(kLeastShare, lengths.at(i) / whole);
      shares.at(i) += step * (there - shares.at(i));
      total += shares.at(i);
    }
    if (!std::isfinite(total)) {
      return std::nullopt;
    }
    for (double& share : shares) {
      share /= total;
    }
  }
  return std::nullopt;
}

}  // namespace

double proposed_split(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v) {
  if (v.size() == 0 || x.size() == 0 || x.rows() > rigor::kMostSmallRows) {
    return 0.5;
  }
  if (const auto shares = soon_found<2>({&x, &v})) {
    return shares->front();
  }
  const auto value = [&](double logit) {
    const double t = logistic(logit);
    return rigor::largest_eigenvalue(Square(x / t + v / (1.0 - t)));
  };
  // Convex in t, so one valley in the logit.
  constexpr int kSteps = 30;
  return logistic(lowest_of(value, kSteps).point);
}

std::array<double, 3> proposed_shares(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v,
                                      const Eigen::MatrixXd& w) {
  if (x.size() == 0 || v.size() == 0 || w.size() == 0 || x.rows() > rigor::kMostSmallRows) {
    return {1.0, 1.0, 1.0};
  }
  if (const auto shares = soon_found<3>({&x, &v, &w})) {
    return *shares;
  }
  // Convex in (t1, t2): the minimum over t2 is convex in t1.
  const auto of_others = [&](double logit_of_x) {
    const double t = logistic(logit_of_x);
    const double rest = logistic(-logit_of_x);
    return lowest_of([&](double logit) {
      return rigor::largest_eigenvalue(
          Square(x / t + v / (rest * logistic(logit)) + w / (rest * logistic(-logit))));
    });
  };
  const double logit_of_x = lowest_of([&](double logit) { return of_others(logit).cost; }).point;
  const double logit_of_v = of_others(logit_of_x).point;
  const double rest = logistic(-logit_of_x);
  return {logistic(logit_of_x), rest * logistic(logit_of_v), rest * logistic(-logit_of_v)};
}

}  // namespace veritrack::model

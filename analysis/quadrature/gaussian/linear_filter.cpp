#include "analysis/quadrature/gaussian/linear_filter.hpp"

#include <cmath>

namespace veritrack::quadrature {

namespace {

/// N = A'NA + diag(0, 1), by doubling.
std::optional<Eigen::Matrix2d> sum_of_later(Eigen::Matrix2d power) {
  constexpr int kDoublings = 40;
  constexpr double kSettled = 1e-9;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  sum(1, 1) = 1.0;
  for (int k = 0; k < kDoublings; ++k) {
    sum = (sum + power.transpose() * sum * power).eval();
    power = (power * power).eval();
  }
  return sum.allFinite() && power.norm() < kSettled ? std::optional(sum) : std::nullopt;
}

}  // namespace

std::optional<LinearFilter> linear_filter(const trackers::ToneModel<double>& design,
                                          const LevelCovariance<double>& covariance) {
  // F P F' + Q for F = [[1, 1], [0, 1]].
  const double p22 = covariance.p22 + 2.0 * covariance.p23 + covariance.p33 + design.q1;
  const double p23 = covariance.p23 + covariance.p33;
  const double innovation = p22 + design.r;
  LinearFilter filter;
  filter.gain << p22 / innovation, p23 / innovation;
  filter.errors << 1.0 - filter.gain[0], 1.0 - filter.gain[0], -filter.gain[1], 1.0 - filter.gain[1];
  const auto later = sum_of_later(filter.errors);
  if (!later) {
    return std::nullopt;
  }
  filter.later = *later;
  return filter;
}

double frequency_variance(const LinearFilter& filter, double noise_deviation, double walk) {
  return noise_deviation * noise_deviation * filter.gain.dot(filter.later * filter.gain) +
         walk * walk * filter.later(1, 1);
}

double least_frequency_variance(double noise_deviation, double walk) {
  if (walk == 0.0) {
    return 0.0;
  }
  const double r = noise_deviation * noise_deviation;
  constexpr int kMostSteps = 10'000'000;
  constexpr double kSettled = 1e-13;
  double p22 = r;
  double p23 = 0.0;
  double p33 = walk * noise_deviation;
  for (int k = 0; k < kMostSteps; ++k) {
    const double before = p33;
    p22 += 2.0 * p23 + p33;
    p23 += p33;
    p33 += walk * walk;
    const double innovation = p22 + r;
    p33 -= p23 * p23 / innovation;
    p23 *= r / innovation;
    p22 *= r / innovation;
    if (std::fabs(p33 - before) <= kSettled * p33) {
      break;
    }
  }
  return p33;
}

}  // namespace veritrack::quadrature

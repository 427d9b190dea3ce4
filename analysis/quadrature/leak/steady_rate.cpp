#include "analysis/quadrature/leak/steady_rate.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "analysis/quadrature/leak/rate_descent.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// N N' of a 3x2 matrix given row by row.
template <typename Scalar>
Symmetric<Scalar> row_products(const std::array<Scalar, 6>& n) {
  using trackers::detail::square;
  const auto dot = [&n](std::size_t i, std::size_t j) -> Scalar {
    return n[2 * i] * n[2 * j] + n[2 * i + 1] * n[2 * j + 1];
  };
  const auto norm = [&n](std::size_t i) -> Scalar { return square(n[2 * i]) + square(n[2 * i + 1]); };
  return {norm(0), dot(0, 1), dot(0, 2), norm(1), dot(1, 2), norm(2)};
}

}  // namespace

SteadyReach reach_of(const SteadyStep<double>& step, const SteadyBounds<double>& bounds,
                     const SteadySetting<double>& setting, double level, double noise) {
  return {step.image,
          hidden_image(setting),
          step.gram,
          row_products(step.noise),
          step.hidden_squared,
          bounds.eta_factor * step.eta_squared + bounds.eta_rest,
          noise * noise / (level * level)};
}

SteadyRate propose_rate(const SteadyReach& reach, double target_squared) {
  const Eigen::Vector3d hidden(reach.hidden[0], reach.hidden[1], reach.hidden[2]);
  const RateDescent<3> descent({reach.image[0], reach.image[1], reach.image[2]},
                               {hidden * hidden.transpose(), reach.gram.matrix(), reach.noise.matrix()},
                               {reach.hidden_squared, reach.eta_squared, reach.noise_squared});
  auto [least, mu] = descent.least();
  const double left = target_squared - least;
  if (left > 0.0) {
    constexpr double kShare = 0.22;  // of what is left, for each of the multipliers
    for (int i = 0; i < 3; ++i) {
      mu[i] += std::min(kShare * left / descent.weights()[i], 3.0 * mu[i]);
    }
  }
  return {least, {mu[0], mu[1], mu[2], 0.0}};
}

std::array<std::array<double, 3>, 2> middle_slopes(const SteadyStep<SteadySecant>& step) {
  std::array<std::array<double, 3>, 2> slopes{};
  for (std::size_t i = 0; i < 3; ++i) {
    slopes[kX][i] = midpoint(step.image[i].slope(kX));
    slopes[kY][i] = midpoint(step.image[i].slope(kY));
  }
  return slopes;
}

bool certainly_contracts(const SteadyStep<SteadySecant>& step, const SteadyBounds<Interval>& bounds,
                         const std::array<Interval, 3>& hidden, const SteadyCell& cell,
                         const Interval& noise_squared, const std::vector<SteadyOffset>& corners,
                         const Interval& rate_squared,
                         const SteadyMultipliers& multipliers VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  const Interval one(1.0);
  const Interval mu(multipliers.hidden);
  const Interval lambda(multipliers.spread);
  const Interval sigma(multipliers.noise);
  const Interval tau(multipliers.cell);
  if (!certainly_positive(mu) || !certainly_positive(lambda) || !certainly_positive(sigma) ||
      !certainly_not_negative(tau)) {
    return false;
  }
  const std::array<Interval, 2> middle{Interval(cell.middle(kX)), Interval(cell.middle(kY))};
  const Interval size = square(cell.side(kX) - middle[kX]) + square(cell.side(kY) - middle[kY]);
  // The value of 1 - x^2 - y^2 in the middle stays here; the linear and quadratic parts have their own rows.
  const SteadySecant head =
      SteadySecant(rate_squared - lambda * bounds.eta_rest - sigma * noise_squared -
                   mu * (one - square(middle[kX]) - square(middle[kY])) - tau * Interval(size.upper())) -
      SteadySecant(lambda * bounds.eta_factor) * step.eta_squared;
  const SteadySecant over_lambda(one / lambda);
  const SteadySecant over_sigma(one / sigma);
  const Symmetric<SteadySecant> noise = row_products(step.noise);
  const auto& g = step.gram;
  const auto gap = [&](std::size_t i, std::size_t j, const SteadySecant& spread,
                       const SteadySecant& by_noise) {
    const Interval diagonal = i == j ? one : Interval(0.0);
    return SteadySecant(diagonal - hidden[i] * hidden[j] / mu) - over_lambda * spread - over_sigma * by_noise;
  };
  const Symmetric<SteadySecant> rest{gap(0, 0, g.p11, noise.p11), gap(0, 1, g.p12, noise.p12),
                                     gap(0, 2, g.p13, noise.p13), gap(1, 1, g.p22, noise.p22),
                                     gap(1, 2, g.p23, noise.p23), gap(2, 2, g.p33, noise.p33)};
  const std::array<std::array<double, 3>, 2> slopes = middle_slopes(step);
  return std::all_of(corners.begin(), corners.end(), [&](const SteadyOffset& corner) {
    const Symmetric<Interval> p = moved_by(rest, corner);
    rigor::LowerTriangle<6> a;
    a[0][0] = p.p11;
    a[1][0] = p.p12;
    a[1][1] = p.p22;
    a[2][0] = p.p13;
    a[2][1] = p.p23;
    a[2][2] = p.p33;
    for (std::size_t i = 0; i < 3; ++i) {
      // The image without the linear part that has rows of its own.
      a[3][i] = Interval(slopes[kX][i]);
      a[4][i] = Interval(slopes[kY][i]);
      a[5][i] = step.image[i].moved_by(corner) - a[3][i] * corner[kX] - a[4][i] * corner[kY];
    }
    a[3][3] = a[4][4] = mu + tau;
    a[4][3] = Interval(0.0);
    a[5][3] = mu * middle[kX];
    a[5][4] = mu * middle[kY];
    a[5][5] = head.moved_by(corner);
    return rigor::certainly_positive_definite<6>(a);
  });
}

bool certainly_positive_definite(const Symmetric<Interval>& p VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  rigor::LowerTriangle<3> a;
  a[0][0] = p.p11;
  a[1][0] = p.p12;
  a[1][1] = p.p22;
  a[2][0] = p.p13;
  a[2][1] = p.p23;
  a[2][2] = p.p33;
  return rigor::certainly_positive_definite<3>(a);
}

}  // namespace veritrack::quadrature

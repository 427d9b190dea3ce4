#include "analysis/quadrature/leak/steady_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/rigor/small_definiteness.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// N N' of a matrix given row by row.
template <typename Scalar>
Symmetric<Scalar> row_products(const std::array<Scalar, 9>& n) {
  using trackers::detail::square;
  const auto dot = [&n](std::size_t i, std::size_t j) -> Scalar {
    return n[3 * i] * n[3 * j] + n[3 * i + 1] * n[3 * j + 1] + n[3 * i + 2] * n[3 * j + 2];
  };
  const auto norm = [&n](std::size_t i) -> Scalar {
    return square(n[3 * i]) + square(n[3 * i + 1]) + square(n[3 * i + 2]);
  };
  return {norm(0), dot(0, 1), dot(0, 2), norm(1), dot(1, 2), norm(2)};
}

/// mu + lambda eta^2 + c' (I - N N'/mu - G/lambda)^-1 c; infinity when the inverse is not positive definite.
double rate_squared_with(const std::array<double, 3>& c, const Symmetric<double>& products,
                         const Symmetric<double>& gram, double eta_squared, double lambda, double mu) {
  const double a11 = 1.0 - products.p11 / mu - gram.p11 / lambda;
  const double a12 = -products.p12 / mu - gram.p12 / lambda;
  const double a13 = -products.p13 / mu - gram.p13 / lambda;
  const double a22 = 1.0 - products.p22 / mu - gram.p22 / lambda;
  const double a23 = -products.p23 / mu - gram.p23 / lambda;
  const double a33 = 1.0 - products.p33 / mu - gram.p33 / lambda;
  if (!(a11 > 0.0)) {
    return kInfinity;
  }
  const double d2 = a22 - a12 * a12 / a11;
  const double e23 = a23 - a12 * a13 / a11;
  if (!(d2 > 0.0)) {
    return kInfinity;
  }
  const double d3 = a33 - a13 * a13 / a11 - e23 * e23 / d2;
  if (!(d3 > 0.0)) {
    return kInfinity;
  }
  const double y2 = c[1] - a12 / a11 * c[0];
  const double y3 = c[2] - a13 / a11 * c[0] - e23 / d2 * y2;
  return mu + lambda * eta_squared + c[0] * c[0] / a11 + y2 * y2 / d2 + y3 * y3 / d3;
}

}  // namespace

SteadyRate propose_rate(const SteadyStep<double>& step, const SteadyBounds<double>& bounds,
                        double target_squared) {
  const Symmetric<double> products = row_products(step.slope);
  const double eta_squared = std::max(step.eta_squared, 1e-300);
  const double spread_trace = bounds.gram.p11 + bounds.gram.p22 + bounds.gram.p33;
  // Of the whole, 1: the share x of lambda eta^2, the larger the smaller; mu takes what it needs.
  const auto lambda = [&](double x) { return std::exp(x) * spread_trace; };
  const auto mu = [](double x) { return std::exp(x); };
  const auto cost = [&](double log_lambda, double log_mu) {
    return rate_squared_with(step.constant, products, bounds.gram, eta_squared, lambda(log_lambda),
                             mu(log_mu));
  };
  const auto best_mu = [&](double log_lambda) {
    return search::golden_section(-3.0, 0.3, 9, [&](double log_mu) { return cost(log_lambda, log_mu); })
        .point;
  };
  const double log_lambda =
      search::golden_section(-0.2, 6.0, 9, [&](double x) { return cost(x, best_mu(x)); }).point;
  const double log_mu = best_mu(log_lambda);
  SteadyRate rate{cost(log_lambda, log_mu), lambda(log_lambda), mu(log_mu)};
  const double left = target_squared - rate.rate_squared;
  if (left > 0.0 && std::isfinite(rate.rate_squared)) {
    rate.error_multiplier += 0.4 * left;
    rate.spread_multiplier += std::min(0.3 * left / eta_squared, 3.0 * rate.spread_multiplier);
  }
  return rate;
}

bool certainly_contracts(const SteadyStep<SteadySecant>& step, const SteadyBounds<Interval>& bounds,
                         const Interval& eta_squared, const std::vector<SteadyOffset>& corners,
                         const Interval& rate_squared,
                         const SteadyRate& multipliers VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  const Interval one(1.0);
  const Interval lambda(multipliers.spread_multiplier);
  const Interval mu(multipliers.error_multiplier);
  const Interval head_over_cell = rate_squared - mu - lambda * rigor::max(eta_squared, Interval(0.0));
  if (!certainly_positive(lambda) || !certainly_positive(mu) || !certainly_positive(head_over_cell)) {
    return false;
  }
  const SteadySecant head =
      (SteadySecant(rate_squared - mu) - SteadySecant(lambda) * step.eta_squared).within(head_over_cell);
  const SteadySecant over_head = SteadySecant(1.0) / head;
  const SteadySecant over_mu(one / mu);
  const SteadySecant over_lambda(bounds.gram_factor / lambda);
  const SteadySecant diagonal(one - bounds.gram_rest / lambda);
  const Symmetric<SteadySecant> products = row_products(step.slope);
  const auto& g = step.gram;
  const auto& c = step.constant;
  const auto sum = [&](const SteadySecant& product, const SteadySecant& spread,
                       const SteadySecant& constants) {
    return over_mu * product + over_lambda * spread + over_head * constants;
  };
  const Symmetric<SteadySecant> gap{diagonal - sum(products.p11, g.p11, square(c[0])),
                                    -sum(products.p12, g.p12, c[0] * c[1]),
                                    -sum(products.p13, g.p13, c[0] * c[2]),
                                    diagonal - sum(products.p22, g.p22, square(c[1])),
                                    -sum(products.p23, g.p23, c[1] * c[2]),
                                    diagonal - sum(products.p33, g.p33, square(c[2]))};
  return std::all_of(corners.begin(), corners.end(), [&](const SteadyOffset& corner) {
    return certainly_positive_definite(moved_by(gap, corner));
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

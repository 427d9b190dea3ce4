// Condition (b): every step keeps the covariance between its bounds.
#include "checker/quadrature/set_inequality.hpp"

#include <cmath>

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

namespace {

/// sign (P - U Phi U'), U = diag(Rot(angle), 1), tan(angle) = tangent, cos(angle) > 0.
Matrix3 difference(const Covariance<Ball>& p, const Covariance<Ball>& phi, const Ball& tangent,
                   const Ball& sign) {
  const Ball cosine2 = one / (one + square(tangent));
  const Ball sine2 = one - cosine2;
  const Ball cosine = sqrt(cosine2);
  const Ball gap = phi.p11 - phi.p22;
  Matrix3 d;
  d[0][0] = sign * (p.p11 - phi.p11 + sine2 * gap);
  d[1][0] = sign * -(tangent * cosine2 * gap);
  d[1][1] = sign * (p.p22 - phi.p22 - sine2 * gap);
  d[2][0] = sign * (tangent * cosine * phi.p23);
  d[2][1] = sign * (p.p23 - cosine * phi.p23);
  d[2][2] = sign * (p.p33 - phi.p33);
  return d;
}

Covariance<Ball> scaled(const Covariance<Ball>& p, const Ball& factor) {
  return {factor * p.p11, factor * p.p22, factor * p.p23, factor * p.p33};
}

bool keeps_order(const Setting& setting, double rho_low, double rho_high, double tan_low, double tan_high,
                 int depth) {
  const Ball rho = Ball::hull(Ball(rho_low), Ball(rho_high));
  const Ball tangent = Ball::hull(Ball(tan_low), Ball(tan_high));
  const Covariance<Ball> low = update(setting, setting.lower, rho).filtered;
  const Covariance<Ball> high = update(setting, setting.upper, rho).filtered;
  // Rounding then moves P by no more than its share of the lower bound.
  const auto least = scaled(setting.lower, one + setting.covariance_rounding);
  const auto most = scaled(setting.upper, one - setting.covariance_rounding);
  if (definite(difference(least, low, tangent, Ball(-1.0))) &&
      definite(difference(most, high, tangent, one))) {
    return true;
  }
  if (depth == 0) {
    return false;
  }
  const double rho_middle = 0.5 * (rho_low + rho_high);
  const double tan_middle = 0.5 * (tan_low + tan_high);
  if (tan_high - tan_low > 2.0 * (rho_high - rho_low)) {
    return keeps_order(setting, rho_low, rho_high, tan_low, tan_middle, depth - 1) &&
           keeps_order(setting, rho_low, rho_high, tan_middle, tan_high, depth - 1);
  }
  return keeps_order(setting, rho_low, rho_middle, tan_low, tan_high, depth - 1) &&
         keeps_order(setting, rho_middle, rho_high, tan_low, tan_high, depth - 1);
}

/// Bounds the turns for `ranges` of the amplitude, looking at `phases` parts of each.
bool keeps_order_over(const Setting& setting, int ranges, int phases) {
  constexpr int kDepth = 14;
  const double end = setting.largest_amplitude.upper_double();
  for (int i = 0; i < ranges; ++i) {
    const double low = end * (2.0 * i / ranges - 1.0);
    const double high = end * (2.0 * (i + 1) / ranges - 1.0);
    const Ball a = Ball::hull(Ball(low), Ball(high));
    // The largest |chi| of the ellipse there.
    const Ball share(std::fmin(std::fabs(low), std::fabs(high)) * (low * high > 0.0 ? 1.0 : 0.0));
    const Ball chi_end =
        setting.largest_chi * sqrt(max(one - square(share / setting.largest_amplitude), zero)).upper();
    double tangent = 0.0;
    for (int j = 0; j < phases; ++j) {
      const Ball chi = chi_end * Ball::hull(Ball(j / static_cast<double>(phases)),
                                            Ball((j + 1) / static_cast<double>(phases)));
      const Correction<Ball> c = correction(setting, a, chi);
      const Ball along = c.mean[0] - c.reach[0];
      const Ball turned = (abs(c.mean[1]) + c.reach[1]) / along;
      if (!certainly_positive(along) || !turned.finite()) {
        return false;
      }
      tangent = std::fmax(tangent, turned.upper_double());
    }
    // 1 + low and 1 + high in double need not be exact: one step outward each.
    if (!keeps_order(setting, std::nextafter(1.0 + low, -1.0), std::nextafter(1.0 + high, 3.0), 0.0, tangent,
                     kDepth)) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool keeps_covariance(const Setting& setting) {
  return keeps_order_over(setting, 8, 6) || keeps_order_over(setting, 64, 24);
}

}  // namespace veritrack::checker

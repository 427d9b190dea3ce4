#include "analysis/rigor/taylor_coefficients.hpp"

#include "analysis/rigor/elementary.hpp"

namespace veritrack::rigor {

namespace {

constexpr std::size_t kCount = std::tuple_size_v<TaylorCoefficients>;

Interval whole(std::size_t k) {
  return Interval(static_cast<double>(k));
}

TaylorCoefficients nothing() {
  TaylorCoefficients result;
  result.fill(Interval::empty());
  return result;
}

/// Those of the integral whose value at t is given: a_(k+1) = g_k/(k + 1).
TaylorCoefficients integral(const Interval& value, const TaylorCoefficients& g) {
  TaylorCoefficients result;
  result[0] = value;
  for (std::size_t k = 0; k + 1 < kCount; ++k) {
    result[k + 1] = g[k] / whole(k + 1);
  }
  return result;
}

/// Those of (w0 + w1 h + w2 h^2)^p, w0 > 0, whose first is y0: from w y' = p w' y.
TaylorCoefficients power_of_quadratic(const std::array<Interval, 3>& w, const Interval& p,
                                      const Interval& y0) {
  TaylorCoefficients y;
  y[0] = y0;
  for (std::size_t k = 1; k < kCount; ++k) {
    Interval sum(0.0);
    for (std::size_t j = 1; j <= k && j < w.size(); ++j) {
      sum = sum + (p * whole(j) - whole(k - j)) * w[j] * y[k - j];
    }
    y[k] = sum / (whole(k) * w[0]);
  }
  return y;
}

/// Those of the integral of (1 - t^2)^(-1/2) whose value at t is given.
TaylorCoefficients integral_of_arcsine(const Interval& t, const Interval& value) {
  const Interval below_one = (Interval(1.0) - t) * (Interval(1.0) + t);
  if (!certainly_positive(below_one) || is_empty(value)) {
    return nothing();
  }
  const std::array<Interval, 3> w{below_one, Interval(-2.0) * t, Interval(-1.0)};
  return integral(value, power_of_quadratic(w, Interval(-0.5), Interval(1.0) / sqrt(below_one)));
}

}  // namespace

TaylorCoefficients taylor_of_reciprocal(const Interval& t) {
  if (contains(t, 0.0) || !is_finite(t)) {
    return nothing();
  }
  TaylorCoefficients result;
  result[0] = Interval(1.0) / t;
  for (std::size_t k = 1; k < kCount; ++k) {
    result[k] = -result[k - 1] / t;
  }
  return result;
}

TaylorCoefficients taylor_of_sqrt(const Interval& t) {
  if (!certainly_positive(t)) {
    return nothing();
  }
  TaylorCoefficients result;
  result[0] = sqrt(t);
  for (std::size_t k = 1; k < kCount; ++k) {
    result[k] = result[k - 1] * (Interval(1.5) - whole(k)) / (whole(k) * t);
  }
  return result;
}

TaylorCoefficients taylor_of_exp(const Interval& t) {
  TaylorCoefficients result;
  result[0] = exp(t);
  for (std::size_t k = 1; k < kCount; ++k) {
    result[k] = result[k - 1] / whole(k);
  }
  return result;
}

TaylorCoefficients taylor_of_log(const Interval& t) {
  return certainly_positive(t) ? integral(log(t), taylor_of_reciprocal(t)) : nothing();
}

TaylorCoefficients taylor_of_sin(const Interval& t) {
  const auto [sine, cosine] = sin_cos(t);
  return {sine,
          cosine,
          -sine / Interval(2.0),
          -cosine / Interval(6.0),
          sine / Interval(24.0),
          cosine / Interval(120.0)};
}

TaylorCoefficients taylor_of_cos(const Interval& t) {
  const auto [sine, cosine] = sin_cos(t);
  return {cosine,
          -sine,
          -cosine / Interval(2.0),
          sine / Interval(6.0),
          cosine / Interval(24.0),
          -sine / Interval(120.0)};
}

/// From tan' = 1 + tan^2.
TaylorCoefficients taylor_of_tan(const Interval& t) {
  TaylorCoefficients result = nothing();
  result[0] = tan(t);
  if (is_empty(result[0])) {
    return result;
  }
  for (std::size_t k = 0; k + 1 < kCount; ++k) {
    Interval sum(k == 0 ? 1.0 : 0.0);
    for (std::size_t i = 0; i <= k; ++i) {
      sum = sum + result[i] * result[k - i];
    }
    result[k + 1] = sum / whole(k + 1);
  }
  return result;
}

/// From asin' = (1 - t^2)^(-1/2).
TaylorCoefficients taylor_of_asin(const Interval& t) {
  return integral_of_arcsine(t, asin(t));
}

TaylorCoefficients taylor_of_acos(const Interval& t) {
  const Interval value = acos(t);
  TaylorCoefficients result = integral_of_arcsine(t, value);
  for (std::size_t k = 1; k < kCount; ++k) {
    result[k] = -result[k];
  }
  return result;
}

/// From atan' = 1/(1 + t^2).
TaylorCoefficients taylor_of_atan(const Interval& t) {
  const Interval above_one = Interval(1.0) + square(t);
  const std::array<Interval, 3> w{above_one, Interval(2.0) * t, Interval(1.0)};
  return integral(atan(t), power_of_quadratic(w, Interval(-1.0), Interval(1.0) / above_one));
}

}  // namespace veritrack::rigor

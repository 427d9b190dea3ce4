#include "checker/quadrature/lock_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace veritrack::checker::lock_proposal {

namespace {

using lock_form::kNoise;
using lock_form::kRest;
using lock_form::kSize;

constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// L^-1 of x = L L'; "not a number" in it where x is not definite.
Matrix3 inverse_factor(const Matrix3& x) {
  Matrix3 l{};
  Matrix3 inverse{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = x[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= l[i][k] * l[j][k];
      }
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  }
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = j; i < 3; ++i) {
      double sum = i == j ? 1.0 : 0.0;
      for (std::size_t k = j; k < i; ++k) {
        sum -= l[i][k] * inverse[k][j];
      }
      inverse[i][j] = sum / l[i][i];
    }
  }
  return inverse;
}

/// The largest eigenvalue of c x c', c lower triangular, of x the lower triangle.
double largest(const Matrix3& c, const Matrix3& x) {
  Matrix3 left{};
  Matrix3 y{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k <= i; ++k) {
        left[i][j] += c[i][k] * (k < j ? x[j][k] : x[k][j]);
      }
    }
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k <= j; ++k) {
        y[i][j] += left[i][k] * c[j][k];
      }
    }
  }
  const double mean = (y[0][0] + y[1][1] + y[2][2]) / 3.0;
  const double a = y[0][0] - mean;
  const double b = y[1][1] - mean;
  const double d = y[2][2] - mean;
  const double off = y[1][0] * y[1][0] + y[2][0] * y[2][0] + y[2][1] * y[2][1];
  const double p = std::sqrt((a * a + b * b + d * d + 2.0 * off) / 6.0);
  if (!(p > 0.0)) {
    return mean;
  }
  const double determinant = a * (b * d - y[2][1] * y[2][1]) - y[1][0] * (y[1][0] * d - y[2][1] * y[2][0]) +
                             y[2][0] * (y[1][0] * y[2][1] - b * y[2][0]);
  return mean + 2.0 * p * std::cos(std::acos(std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0)) / 3.0);
}

Matrix3 difference(const Matrix3& x, const Matrix3& y) {
  Matrix3 z{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      z[i][j] = x[i][j] - y[i][j];
    }
  }
  return z;
}

/// Eliminates the first rows; false when a pivot is not positive.
bool eliminate(Matrix6& n) {
  for (std::size_t k = 0; k < kRest; ++k) {
    if (!(n[k][k] > 0.0)) {
      return false;
    }
    for (std::size_t i = k + 1; i < kSize; ++i) {
      const double factor = n[i][k] / n[k][k];
      for (std::size_t j = k + 1; j <= i; ++j) {
        n[i][j] -= factor * n[j][k];
      }
    }
  }
  return true;
}

}  // namespace

LevelOf::LevelOf(const Matrix3& centre, const Matrix3& above, const Matrix3& centre_inverse,
                 const Matrix3& below)
    : centre_(centre),
      above_(inverse_factor(above)),
      centre_inverse_(centre_inverse),
      below_(inverse_factor(below)) {}

double LevelOf::operator()(const Matrix3& upper, const Matrix3& lower) const {
  const Matrix3 c = inverse_factor(lower);
  Matrix3 inverse{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = i; k < 3; ++k) {
        inverse[i][j] += c[k][i] * c[k][j];
      }
    }
  }
  const double high = largest(above_, difference(upper, centre_));
  const double low = largest(below_, difference(inverse, centre_inverse_));
  return std::isfinite(low) && std::isfinite(high) ? std::max({high, low, 0.0})
                                                   : std::numeric_limits<double>::quiet_NaN();
}

LevelPlane plane_above(const std::array<double, 16>& levels) {
  LevelPlane plane;
  const auto side = [](std::size_t corner, std::size_t k) { return ((corner >> k) & 1U) != 0U ? 1.0 : -1.0; };
  for (std::size_t corner = 0; corner < levels.size(); ++corner) {
    for (std::size_t k = 0; k < plane.along.size(); ++k) {
      plane.along[k] += side(corner, k) * levels[corner] / 16.0;
    }
  }
  double most = 0.0;
  for (std::size_t corner = 0; corner < levels.size(); ++corner) {
    double rest = levels[corner];
    for (std::size_t k = 0; k < plane.along.size(); ++k) {
      rest -= side(corner, k) * plane.along[k];
    }
    most = corner == 0 ? rest : std::max(most, rest);
  }
  // Definite, not only on the border of it.
  plane.middle = most + 1e-7 * (1.0 + std::fabs(most));
  return plane;
}

double left_over(Matrix6 n) {
  if (!eliminate(n)) {
    return kNothing;
  }
  return n[kRest][kRest] + std::log(n[kNoise][kNoise] * n[kNoise + 1][kNoise + 1]);
}

Matrix6 form(const Matrix6& parts, const Matrix6& constant, double rest,
             const lock_form::Factors<double>& factors) {
  Matrix6 n = constant;
  n[kRest][kRest] += rest;
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double* factor = lock_form::factor_at(factors, i, j);
      n[i][j] += (factor != nullptr ? *factor : 1.0) * parts[i][j];
    }
  }
  return n;
}

double propose_multiplier(const Ends& ends, const Matrix6& constant, double deviation, double r) {
  const auto value = [&](double log_multiplier) {
    const auto factors = lock_form::factors_of(std::exp(log_multiplier), deviation, r);
    return std::min(left_over(form(ends.parts[0], constant, ends.rest[0], factors)),
                    left_over(form(ends.parts[1], constant, ends.rest[1], factors)));
  };
  // Between the multipliers for which the rows of the error and of the noise are definite.
  double spread = 0.0;
  double noise = 0.0;
  for (const Matrix6& parts : ends.parts) {
    spread = std::max({spread, parts[0][0], parts[1][1], parts[2][2]});
    noise = std::max({noise, parts[kNoise][kNoise], parts[kNoise + 1][kNoise + 1]});
  }
  double low = std::log(std::max(spread, 1e-12)) - 0.7;
  double high =
      std::max(low + 1.0, std::min(std::log(r * r / (deviation * deviation * noise)) + 0.7, low + 12.0));
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 14;
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double at_left = value(left);
  double at_right = value(right);
  for (int step = 0; step < kSteps; ++step) {
    // Where neither gives a bound, towards the middle of the sensible range: smaller multipliers first.
    if (at_left >= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = value(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = value(right);
    }
  }
  return std::exp(at_left >= at_right ? left : right);
}

std::array<double, kSize> propose_weights(const Matrix6& n) {
  // v with N v = (0, ..., 0, pivot) and v_6 = 1, by elimination and substitution.
  Matrix6 rows = n;
  std::array<double, kSize> v{};
  v[kRest] = 1.0;
  if (eliminate(rows)) {
    for (std::size_t k = kRest; k-- > 0;) {
      for (std::size_t i = k + 1; i < kSize; ++i) {
        v[k] -= rows[i][k] / rows[k][k] * v[i];
      }
    }
  }
  constexpr double kLeast = 0.5;
  for (double& weight : v) {
    weight = std::isfinite(weight) ? std::max(std::fabs(weight), kLeast) : 1.0;
  }
  return v;
}

}  // namespace veritrack::checker::lock_proposal

#include "checker/quadrature/multipliers.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::checker::step_form {

namespace {

/// Eliminates the first rows; false when the matrix is not definite.
bool eliminate(Matrix<double>& m, std::size_t rows) {
  for (std::size_t k = 0; k < rows; ++k) {
    if (!(m[k][k] > 0.0)) {
      return false;
    }
    for (std::size_t i = k + 1; i < kSize; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j <= i; ++j) {
        m[i][j] -= factor * m[j][k];
      }
    }
  }
  return true;
}

/// The largest k for which k |T e|^2 could be subtracted, rate^2 = 1, with nothing across the axis: the
/// smaller root of det(left - k size) = 0 over (nu, along).
double room(const Form<double>& form, double lambda) {
  Matrix<double> left = with_lambda(form, lambda);
  if (!eliminate(left, kNu)) {
    return -HUGE_VAL;
  }
  const Matrix<double>& size = form.fixed;
  const auto det = [](const Matrix<double>& x, const Matrix<double>& y) {
    return x[kNu][kNu] * y[kAlong][kAlong] - x[kAlong][kNu] * y[kAlong][kNu];
  };
  const double mean = 0.5 * (det(left, size) + det(size, left));
  const double square = std::fmax(0.0, mean * mean - det(size, size) * det(left, left));
  return (mean - std::sqrt(square)) / det(size, size);
}

}  // namespace

Matrix<double> with_lambda(const Form<double>& f, double lambda) {
  Matrix<double> m{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m[i][j] = f.fixed[i][j] + lambda * f.by_lambda[i][j] + f.by_inverse[i][j] / lambda;
    }
  }
  return m;
}

double propose_lambda(const Form<double>& form) {
  const double trace = -(form.by_inverse[kNext][kNext] + form.by_inverse[kNext + 1][kNext + 1] +
                         form.by_inverse[kNext + 2][kNext + 2]);
  double best = trace;
  for (const double step : {1.0, 0.25, 0.0625}) {
    const double centre = step == 1.0 ? 8.0 * trace : best;
    for (int i = -9; i <= 9; ++i) {
      const double lambda = centre * std::exp2(0.5 * step * i);
      best = room(form, lambda) > room(form, best) ? lambda : best;
    }
  }
  return best;
}

double propose_tau(const Form<double>& form, double lambda, double tangent) {
  Matrix<double> m = with_lambda(form, lambda);
  return eliminate(m, kAcross)
             ? std::max(0.0, 0.5 * (m[kAlong][kAlong] / (tangent * tangent) - m[kAcross][kAcross]))
             : 0.0;
}

Matrix<double> inverse_factor(const Matrix<double>& m) {
  Matrix<double> l{};
  Matrix<double> inverse{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= l[i][k] * l[j][k];
      }
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (std::size_t k = j; k < i; ++k) {
        sum -= l[i][k] * inverse[k][j];
      }
      inverse[i][j] = sum / l[i][i];
    }
  }
  return inverse;
}

}  // namespace veritrack::checker::step_form

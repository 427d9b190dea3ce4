// The response of the estimates of the KKL observer (trackers/kkl_observer/kkl_observer.hpp) to moves of its
// filters, for any number of filters and as long as mu of (9) vanishes.
//
// Let the filters be at xi = A (T(x) + u), T at amplitude 1, s = x3 = w^2. With mu = 0, gamma is the
// least-squares solution of x1 lambda + x2 1 - x3 xi = F^2 xi, which scales with A in x1 and x2 and not at
// all in x3. Let N be an orthonormal basis of the complement of span(lambda, 1), y = N'(T + u), and [lambda
// 1]^+ the pseudoinverse. Since N'F^2 T = -s N'T,
//     x3 - s = -y'N'(F^2 + s) u / |y|^2,
//     (x1, x2)_hat - (x1, x2) = [lambda 1]^+ ((F^2 + s) u + (x3_hat - s)(T + u)):
// the errors as products with u, without a difference of nearly equal numbers. N'T has the closed form of
// kkl_excitation_ratio.hpp, and |M xi|^2 = (|lambda|^2 |1|^2 - (lambda'1)^2) A^2 |y|^2.
//
// The response to another sinusoid of frequency W is T at that frequency, for which N'(F^2 + s) T_W =
// (s - W^2) N'T_W: it enters x3_hat as a mean of s and W^2,
//     x3 - s = (W^2 - s) y'z / |y|^2,   z its share of y.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

#include "analysis/kkl_observer/non_negative_root.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::kkl_observer {

/// The errors of M >= 4 filters with distinct positive rates. Over intervals it needs the upward mode, and
/// encloses.
template <typename Scalar, int M = 4>
class KklErrorMap {
 public:
  static constexpr std::size_t kFilters = M;
  /// The dimension of the complement of span(lambda, 1).
  static constexpr std::size_t kAcross = kFilters - 2;
  template <typename Number>
  using Filters = std::array<Number, kFilters>;
  template <typename Number>
  using Across = std::array<Number, kAcross>;

  /// `lambda`: filter rates, 1/s.
  explicit KklErrorMap(const Eigen::Matrix<Scalar, M, 1>& lambda) {
    using std::sqrt;
    using trackers::detail::square;
    Scalar sum(0.0);
    Scalar squares(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      lambda_[i] = lambda(static_cast<Eigen::Index>(i));
      squared_[i] = square(lambda_[i]);
      sum += lambda_[i];
      squares += squared_[i];
    }
    // The Gram determinant |lambda|^2 |1|^2 - (lambda'1)^2, as a sum of squares.
    gram_ = Scalar(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      for (std::size_t j = i + 1; j < kFilters; ++j) {
        gram_ += square(Scalar(lambda_[i] - lambda_[j]));
      }
    }
    for (std::size_t i = 0; i < kFilters; ++i) {
      pseudoinverse_1_[i] = (Scalar(static_cast<double>(M)) * lambda_[i] - sum) / gram_;
      pseudoinverse_2_[i] = (squares - sum * lambda_[i]) / gram_;
    }
    find_basis();
  }

  [[nodiscard]] const Filters<Scalar>& lambda() const { return lambda_; }
  /// N, by columns.
  [[nodiscard]] const Across<Filters<Scalar>>& basis() const { return basis_; }
  /// |lambda|^2 |1|^2 - (lambda'1)^2, so that |M xi|^2 is this times |N'xi|^2.
  [[nodiscard]] const Scalar& gram_determinant() const { return gram_; }

  /// A signal of amplitude 1, and the place of the filters in it.
  template <typename Number>
  struct Signal {
    Number frequency;  ///< w, rad/s
    Number sine, cosine;
    Number s;                      ///< w^2
    Filters<Number> denominators;  ///< lambda_i^2 + s
    Filters<Number> transformed;   ///< T
    Across<Number> projected;      ///< N'T
  };

  /// The signal sin(w t + p) at the phase w t + p = `phase`, rad.
  template <typename Number>
  [[nodiscard]] Signal<Number> signal(const Number& frequency, const Number& phase) const {
    using trackers::detail::sin_cos;
    using trackers::detail::square;
    Signal<Number> at;
    at.frequency = frequency;
    const auto circle = sin_cos(phase);
    at.sine = circle.first;
    at.cosine = circle.second;
    at.s = square(frequency);
    const Number x2 = -(frequency * at.cosine);
    for (std::size_t i = 0; i < kFilters; ++i) {
      at.denominators[i] = at.s + squared_[i];
      at.transformed[i] = (at.sine * lambda_[i] + x2) / at.denominators[i];
    }
    const auto determinant = [&](const Triple& t) -> Number {
      const Number numerator = (t.e3 - at.s * t.e1) * at.sine + (t.e2 - at.s) * x2;
      return numerator * t.vandermonde /
             (at.denominators[t.at[0]] * at.denominators[t.at[1]] * at.denominators[t.at[2]]);
    };
    at.projected = along_basis<Number>(determinant);
    return at;
  }

  /// The response of the filters to a second sinusoid of amplitude 1, sin(W t + .), where its phase is
  /// `phase` (rad); `period` = 1 / W in s, which may be 0.
  template <typename Number>
  struct Response {
    Filters<Number> filters;   ///< T_W
    Across<Number> projected;  ///< z = N'T_W
    Across<Number> pull;       ///< (W^2 - s) z
  };
  template <typename Number>
  [[nodiscard]] Response<Number> response(const Signal<Number>& at, const Number& period,
                                          const Number& phase) const {
    using trackers::detail::sin_cos;
    using trackers::detail::square;
    const auto circle = sin_cos(phase);
    const Number squared_period = square(period);
    Response<Number> result;
    Filters<Number> denominators;  // (lambda_i / W)^2 + 1
    for (std::size_t i = 0; i < kFilters; ++i) {
      denominators[i] = squared_period * squared_[i] + Scalar(1.0);
      result.filters[i] = period * (period * circle.first * lambda_[i] - circle.second) / denominators[i];
    }
    // N'T_W = period^3 times this, by the same divided differences as for the signal.
    const auto determinant = [&](const Triple& t) -> Number {
      const Number numerator = period * (squared_period * t.e3 - t.e1) * circle.first -
                               (squared_period * t.e2 - Scalar(1.0)) * circle.second;
      return numerator * t.vandermonde /
             (denominators[t.at[0]] * denominators[t.at[1]] * denominators[t.at[2]]);
    };
    const Across<Number> of_basis = along_basis<Number>(determinant);
    const Number cube = squared_period * period;
    const Number pulling = period * (Scalar(1.0) - at.s * squared_period);
    for (std::size_t j = 0; j < kAcross; ++j) {
      result.projected[j] = of_basis[j] * cube;
      result.pull[j] = of_basis[j] * pulling;
    }
    return result;
  }

  /// y = N'(T + u).
  template <typename Number>
  [[nodiscard]] Across<Number> perturbed(const Signal<Number>& at, const Filters<Number>& u) const {
    Across<Number> y;
    for (std::size_t j = 0; j < kAcross; ++j) {
      y[j] = at.projected[j] + along(u, basis_[j]);
    }
    return y;
  }

  /// |y|^2.
  template <typename Number>
  [[nodiscard]] static Number squared_norm(const Across<Number>& y) {
    using trackers::detail::square;
    Number sum = square(y[0]);
    for (std::size_t j = 1; j < kAcross; ++j) {
      sum = Number(sum + square(y[j]));
    }
    return sum;
  }

  /// The sum of x_j y_j.
  template <typename Number>
  [[nodiscard]] static Number product(const Across<Number>& x, const Across<Number>& y) {
    Number sum = x[0] * y[0];
    for (std::size_t j = 1; j < kAcross; ++j) {
      sum = Number(sum + x[j] * y[j]);
    }
    return sum;
  }

  /// x3_hat - s.
  template <typename Number>
  [[nodiscard]] Number squared_frequency_error(const Signal<Number>& at, const Filters<Number>& u,
                                               const Across<Number>& y) const {
    return product(y, pulled_by(at, u)) / squared_norm(y);
  }

  /// -N'(F^2 + s) u: x3_hat - s is its product with y over |y|^2.
  template <typename Number>
  [[nodiscard]] Across<Number> pulled_by(const Signal<Number>& at, const Filters<Number>& u) const {
    Across<Number> pull;
    pull.fill(Number(0.0));
    for (std::size_t i = 0; i < kFilters; ++i) {
      const Number driven = at.denominators[i] * u[i];
      for (std::size_t j = 0; j < kAcross; ++j) {
        pull[j] -= driven * basis_[j][i];
      }
    }
    return pull;
  }

  /// The coefficients of y'N'(F^2 + s) u at y = N'T: -|y|^2 times the error of x3 to first order.
  template <typename Number>
  [[nodiscard]] Filters<Number> pulling(const Signal<Number>& at) const {
    Filters<Number> result;
    for (std::size_t i = 0; i < kFilters; ++i) {
      Number sum = at.projected[0] * basis_[0][i];
      for (std::size_t j = 1; j < kAcross; ++j) {
        sum = Number(sum + at.projected[j] * basis_[j][i]);
      }
      result[i] = at.denominators[i] * sum;
    }
    return result;
  }

  /// w_hat - w, from x3_hat - s; -w where x3_hat, which has to be positive, is not.
  template <typename Number>
  [[nodiscard]] static Number frequency_error(const Signal<Number>& at, const Number& squared_error) {
    return squared_error / (detail::root_of_non_negative(Number(at.s + squared_error)) + at.frequency);
  }

  /// A_hat / A - 1, from x3_hat - s. Needs a positive x3_hat.
  template <typename Number>
  [[nodiscard]] Number amplitude_error(const Signal<Number>& at, const Filters<Number>& u,
                                       const Number& squared_error) const {
    using trackers::detail::square;
    Number k1(0.0);  // errors of x1 and x2
    Number k2(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      const Number moved = at.denominators[i] * u[i] + squared_error * (at.transformed[i] + u[i]);
      k1 += moved * pseudoinverse_1_[i];
      k2 += moved * pseudoinverse_2_[i];
    }
    const Number x2 = -(at.frequency * at.cosine);
    // (A_hat / A)^2 - 1
    const Number squared = k1 * (at.sine + at.sine + k1) +
                           (k2 * (x2 + x2 + k2) - squared_error * square(at.cosine)) / (at.s + squared_error);
    return squared / (detail::root_of_non_negative(Number(squared + Scalar(1.0))) + Scalar(1.0));
  }

  /// |M xi|^2 / |xi|^2 at xi = T + u.
  template <typename Number>
  [[nodiscard]] Number excitation_ratio(const Signal<Number>& at, const Filters<Number>& u,
                                        const Across<Number>& y) const {
    using trackers::detail::square;
    Number norm(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      norm += square(Number(at.transformed[i] + u[i]));
    }
    return squared_norm(y) * gram_ / norm;
  }

  /// c'v for constant coefficients.
  template <typename Number>
  [[nodiscard]] static Number along(const Filters<Number>& v, const Filters<Scalar>& coefficients) {
    Number sum(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      sum += v[i] * coefficients[i];
    }
    return sum;
  }

  /// The rows of [lambda 1]^+.
  [[nodiscard]] const Filters<Scalar>& pseudoinverse_1() const { return pseudoinverse_1_; }
  [[nodiscard]] const Filters<Scalar>& pseudoinverse_2() const { return pseudoinverse_2_; }

 private:
  /// Three filters and the constants of their divided differences.
  struct Triple {
    std::array<std::size_t, 3> at;
    Scalar e1, e2, e3, vandermonde;
  };

  /// Three filters in a row, from this one on.
  [[nodiscard]] Triple triple(std::size_t i) const {
    const Scalar& a = lambda_[i];
    const Scalar& b = lambda_[i + 1];
    const Scalar& c = lambda_[i + 2];
    // The determinant of (f, lambda, 1) is (a - b)(b - c)(a - c) f[a, b, c].
    return {{i, i + 1, i + 2}, a + b + c, a * b + b * c + c * a, a * b * c, (a - b) * (b - c) * (a - c)};
  }

  /// The determinants of (xi, lambda, 1) of three filters in a row are orthogonal to lambda and 1: Gram and
  /// Schmidt.
  void find_basis() {
    using std::sqrt;
    using trackers::detail::square;
    Across<Filters<Scalar>> rest;  // orthogonal, not yet of length 1
    Across<Scalar> squares;
    for (std::size_t k = 0; k < kAcross; ++k) {
      triples_[k] = triple(k);
      Filters<Scalar> row;
      row.fill(Scalar(0.0));
      row[k] = lambda_[k + 1] - lambda_[k + 2];
      row[k + 1] = lambda_[k + 2] - lambda_[k];
      row[k + 2] = lambda_[k] - lambda_[k + 1];
      rest[k] = row;
      normal_[k].fill(Scalar(0.0));
      normal_[k][k] = Scalar(1.0);
      for (std::size_t j = 0; j < k; ++j) {
        const Scalar share = along(row, rest[j]) / squares[j];
        for (std::size_t i = 0; i < kFilters; ++i) {
          rest[k][i] -= share * rest[j][i];
        }
        for (std::size_t i = 0; i <= j; ++i) {
          normal_[k][i] -= share * normal_[j][i];
        }
      }
      squares[k] = Scalar(0.0);
      for (std::size_t i = 0; i < kFilters; ++i) {
        squares[k] += square(rest[k][i]);
      }
    }
    for (std::size_t k = 0; k < kAcross; ++k) {
      const Scalar norm = sqrt(squares[k]);
      for (std::size_t i = 0; i < kFilters; ++i) {
        basis_[k][i] = rest[k][i] / norm;
      }
      for (std::size_t i = 0; i <= k; ++i) {
        normal_[k][i] = normal_[k][i] / norm;
      }
    }
  }

  /// N'v from the determinants of v with lambda and 1.
  template <typename Number, typename Determinant>
  [[nodiscard]] Across<Number> along_basis(const Determinant& determinant) const {
    Across<Number> result;
    Across<Number> of_triples;
    for (std::size_t k = 0; k < kAcross; ++k) {
      of_triples[k] = determinant(triples_[k]);
      result[k] = of_triples[0] * normal_[k][0];
      for (std::size_t i = 1; i <= k; ++i) {
        result[k] = Number(result[k] + of_triples[i] * normal_[k][i]);
      }
    }
    return result;
  }

  Filters<Scalar> lambda_, squared_;
  Scalar gram_;
  Filters<Scalar> pseudoinverse_1_, pseudoinverse_2_;
  Across<Triple> triples_;
  Across<Filters<Scalar>> basis_;
  Across<Across<Scalar>> normal_;  ///< from the determinants to the orthonormal basis: lower triangular
};

}  // namespace veritrack::kkl_observer

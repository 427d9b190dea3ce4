// How the estimates of the KKL observer (trackers/kkl_observer/kkl_observer.hpp) move when its filters do,
// for four filters and as long as mu of (9) vanishes.
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
// (s - W^2) N'T_W: it enters x3_hat as the mean of s and W^2 that it is,
//     x3 - s = (W^2 - s) y'z / |y|^2,   z its share of y.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

#include "analysis/kkl_observer/non_negative_root.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::kkl_observer {

/// The errors of four filters with distinct positive rates. Over intervals it needs the upward mode, and
/// encloses.
template <typename Scalar>
class KklErrorMap {
 public:
  static constexpr std::size_t kFilters = 4;
  template <typename Number>
  using Filters = std::array<Number, kFilters>;

  /// `lambda`: filter rates, 1/s.
  explicit KklErrorMap(const Eigen::Matrix<Scalar, 4, 1>& lambda) {
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
      pseudoinverse_1_[i] = (Scalar(4.0) * lambda_[i] - sum) / gram_;
      pseudoinverse_2_[i] = (squares - sum * lambda_[i]) / gram_;
    }
    // The determinants of (xi, lambda, 1) for the first and the last three filters are orthogonal to lambda
    // and 1.
    const Filters<Scalar> first{lambda_[1] - lambda_[2], lambda_[2] - lambda_[0], lambda_[0] - lambda_[1],
                                Scalar(0.0)};
    const Filters<Scalar> last{Scalar(0.0), lambda_[2] - lambda_[3], lambda_[3] - lambda_[1],
                               lambda_[1] - lambda_[2]};
    triples_ = {triple(0, 1, 2), triple(1, 2, 3)};
    Scalar first_first(0.0);
    Scalar first_last(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      first_first += square(first[i]);
      first_last += first[i] * last[i];
    }
    const Scalar share = first_last / first_first;
    Filters<Scalar> rest;
    Scalar rest_rest(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      rest[i] = last[i] - share * first[i];
      rest_rest += square(rest[i]);
    }
    const Scalar first_norm = sqrt(first_first);
    const Scalar rest_norm = sqrt(rest_rest);
    for (std::size_t i = 0; i < kFilters; ++i) {
      basis_[0][i] = first[i] / first_norm;
      basis_[1][i] = rest[i] / rest_norm;
    }
    normal_ = {Scalar(1.0) / first_norm, -(share / rest_norm), Scalar(1.0) / rest_norm};
  }

  [[nodiscard]] const Filters<Scalar>& lambda() const { return lambda_; }
  /// N, by columns.
  [[nodiscard]] const std::array<Filters<Scalar>, 2>& basis() const { return basis_; }
  /// |lambda|^2 |1|^2 - (lambda'1)^2, so that |M xi|^2 is this times |N'xi|^2.
  [[nodiscard]] const Scalar& gram_determinant() const { return gram_; }

  /// A signal of amplitude 1, and where the filters are in it.
  template <typename Number>
  struct Signal {
    Number frequency;  ///< w, rad/s
    Number sine, cosine;
    Number s;                         ///< w^2
    Filters<Number> denominators;     ///< lambda_i^2 + s
    Filters<Number> transformed;      ///< T
    std::array<Number, 2> projected;  ///< N'T
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
    const Number first = determinant(triples_[0]);
    const Number last = determinant(triples_[1]);
    at.projected = {first * normal_[0], first * normal_[1] + last * normal_[2]};
    return at;
  }

  /// The response of the filters to a second sinusoid of amplitude 1, sin(W t + .), where its phase is
  /// `phase` (rad); `period` = 1 / W in s, which may be 0.
  template <typename Number>
  struct Response {
    Filters<Number> filters;          ///< T_W
    std::array<Number, 2> projected;  ///< z = N'T_W
    std::array<Number, 2> pull;       ///< (W^2 - s) z
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
    const Number first = determinant(triples_[0]);
    const Number last = determinant(triples_[1]);
    const Number cube = squared_period * period;
    const Number pulling = period * (Scalar(1.0) - at.s * squared_period);
    const std::array<Number, 2> along_basis{first * normal_[0], first * normal_[1] + last * normal_[2]};
    for (std::size_t j = 0; j < 2; ++j) {
      result.projected[j] = along_basis[j] * cube;
      result.pull[j] = along_basis[j] * pulling;
    }
    return result;
  }

  /// y = N'(T + u).
  template <typename Number>
  [[nodiscard]] std::array<Number, 2> perturbed(const Signal<Number>& at, const Filters<Number>& u) const {
    return {at.projected[0] + along(u, basis_[0]), at.projected[1] + along(u, basis_[1])};
  }

  /// |y|^2.
  template <typename Number>
  [[nodiscard]] static Number squared_norm(const std::array<Number, 2>& y) {
    using trackers::detail::square;
    return square(y[0]) + square(y[1]);
  }

  /// x3_hat - s.
  template <typename Number>
  [[nodiscard]] Number squared_frequency_error(const Signal<Number>& at, const Filters<Number>& u,
                                               const std::array<Number, 2>& y) const {
    const std::array<Number, 2> pull = pulled_by(at, u);
    return (y[0] * pull[0] + y[1] * pull[1]) / squared_norm(y);
  }

  /// -N'(F^2 + s) u: x3_hat - s is its product with y over |y|^2.
  template <typename Number>
  [[nodiscard]] std::array<Number, 2> pulled_by(const Signal<Number>& at, const Filters<Number>& u) const {
    std::array<Number, 2> pull{Number(0.0), Number(0.0)};
    for (std::size_t i = 0; i < kFilters; ++i) {
      const Number driven = at.denominators[i] * u[i];
      pull[0] -= driven * basis_[0][i];
      pull[1] -= driven * basis_[1][i];
    }
    return pull;
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
                                        const std::array<Number, 2>& y) const {
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

  [[nodiscard]] Triple triple(std::size_t i, std::size_t j, std::size_t k) const {
    const Scalar& a = lambda_[i];
    const Scalar& b = lambda_[j];
    const Scalar& c = lambda_[k];
    // The determinant of (f, lambda, 1) is (a - b)(b - c)(a - c) f[a, b, c].
    // order.
    return {{i, j, k}, a + b + c, a * b + b * c + c * a, a * b * c, (a - b) * (b - c) * (a - c)};
  }

  Filters<Scalar> lambda_, squared_;
  Scalar gram_;
  Filters<Scalar> pseudoinverse_1_, pseudoinverse_2_;
  std::array<Triple, 2> triples_;
  std::array<Filters<Scalar>, 2> basis_;
  std::array<Scalar, 3> normal_;  ///< from the two determinants to the orthonormal basis
};

}  // namespace veritrack::kkl_observer

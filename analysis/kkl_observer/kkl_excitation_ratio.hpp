// The reduced form of problem (10) of the KKL observer's paper (trackers/kkl_observer/kkl_observer.hpp), for
// four filters.
//
// T is linear in (x1, x2), T(x) = A(s) (x1, x2)' with s = x3, so that the infimum of |M T|^2 / |T|^2 over the
// signals of one frequency is the smaller eigenvalue of the 2 x 2 pencil (A'M'M A, A'A). M sums over triples
// of filters the determinants of (lambda, 1, xi), which are the triples' Vandermonde determinants times
// second divided differences of f(l) = (l x1 + x2) / (l^2 + s); with D_i = lambda_i^2 + s and the elementary
// symmetric polynomials e1, e2, e3 of the triple,
//     f[i, j, k] = ((e3 - s e1) x1 + (e2 - s) x2) / (D_i D_j D_k).
// Trace and determinant of the pencil then are sums of squares: nothing cancels, whatever the range of s.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "analysis/kkl_observer/non_negative_root.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::kkl_observer {

/// The infimum of |M T(x)|^2 / |T(x)|^2 over all signals of one frequency, as a function of the frequency,
/// for four distinct positive filter rates. Over intervals it needs the upward mode, and encloses.
template <typename Scalar>
class ExcitationRatio {
 public:
  /// `lambda`: filter rates, 1/s.
  explicit ExcitationRatio(const Eigen::Matrix<Scalar, 4, 1>& lambda) : lambda_(lambda) {
    using trackers::detail::square;
    for (std::size_t omitted = 0; omitted < 4; ++omitted) {
      const auto at = [&](std::size_t n) -> const Scalar& {
        return lambda(static_cast<Eigen::Index>(n + (n >= omitted ? 1 : 0)));
      };
      const Scalar& a = at(0);
      const Scalar& b = at(1);
      const Scalar& c = at(2);
      triples_[omitted] = {a + b + c, a * b + b * c + c * a, a * b * c,
                           square(Scalar((a - b) * (b - c) * (a - c))),
                           square(Scalar(a + b)) + square(Scalar(b + c)) + square(Scalar(c + a))};
    }
  }

  /// At `frequency`, rad/s; a Scalar or a dual number over it.
  template <typename Number>
  [[nodiscard]] Number at(const Number& frequency) const {
    using trackers::detail::square;
    const Number s = square(frequency);
    std::array<Number, 4> d;       // D_i
    std::array<Number, 4> first;   // e3 - s e1 of the triple that omits i
    std::array<Number, 4> second;  // e2 - s
    for (std::size_t i = 0; i < 4; ++i) {
      d[i] = s + square(lambda_(static_cast<Eigen::Index>(i)));
      first[i] = triples_[i].e3 - s * triples_[i].e1;
      second[i] = triples_[i].e2 - s;
    }
    Number trace(0.0);        // of adj(A'A) A'M'M A, times (D1 D2 D3 D4)^2
    Number determinant(0.0);  // of A'M'M A, times (D1 D2 D3 D4)^4
    Number gram(0.0);         // det(A'A), times (D1 D2 D3 D4)^2
    for (std::size_t i = 0; i < 4; ++i) {
      const Triple& triple = triples_[i];
      const Number crossed = first[i] - second[i] * lambda_(static_cast<Eigen::Index>(i));
      trace += (square(d[i]) * triple.squared_sums + square(crossed)) * triple.squared_vandermonde;
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Number minor = first[i] * second[j] - first[j] * second[i];
        determinant += square(Number(d[i] * d[j] * minor)) *
                       Scalar(triple.squared_vandermonde * triples_[j].squared_vandermonde);
        const auto [k, l] = others(i, j);
        gram += square(Number(d[k] * d[l])) *
                square(Scalar(lambda_(static_cast<Eigen::Index>(i)) - lambda_(static_cast<Eigen::Index>(j))));
      }
    }
    const Number product = d[0] * d[1] * d[2] * d[3];
    const Number mean = trace / gram;                                   // sum of the eigenvalues
    const Number eigenvalues = determinant / (gram * square(product));  // their product
    // The discriminant is never negative; where the eigenvalues meet its enclosure may be.
    const Number discriminant = square(mean) - eigenvalues * Scalar(4.0);
    return eigenvalues * Scalar(2.0) / (mean + detail::root_of_non_negative(discriminant));
  }

 private:
  /// Constants of three filters.
  struct Triple {
    Scalar e1, e2, e3;           ///< elementary symmetric polynomials
    Scalar squared_vandermonde;  ///< ((a - b)(b - c)(a - c))^2
    Scalar squared_sums;         ///< (a + b)^2 + (b + c)^2 + (c + a)^2
  };

  /// The two indices that are neither i nor j, for i < j.
  static constexpr std::array<std::size_t, 2> others(std::size_t i, std::size_t j) {
    std::array<std::size_t, 2> rest{};
    std::size_t count = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      if (n != i && n != j) {
        rest[count++] = n;
      }
    }
    return rest;
  }

  Eigen::Matrix<Scalar, 4, 1> lambda_;
  std::array<Triple, 4> triples_;
};

}  // namespace veritrack::kkl_observer

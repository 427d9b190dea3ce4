// The reduced form of problem (10) of the KKL observer's paper (trackers/kkl_observer/kkl_observer.hpp), for
// four filters or more.
//
// T is linear in (x1, x2), T(x) = A(s) (x1, x2)' with s = x3, so that the infimum of |M T|^2 / |T|^2 over the
// signals of one frequency is the smaller eigenvalue of the 2 x 2 pencil (A'M'M A, A'A). M sums over triples
// of filters the determinants of (lambda, 1, xi), which are the triples' Vandermonde determinants times
// second divided differences of f(l) = (l x1 + x2) / (l^2 + s); with D_i = lambda_i^2 + s and the elementary
// symmetric polynomials e1, e2, e3 of the triple,
//     f[i, j, k] = ((e3 - s e1) x1 + (e2 - s) x2) / (D_i D_j D_k).
// Trace and determinant of the pencil then are sums of squares: no large terms cancel, whatever the range of
// s. In the determinant nothing cancels at all: A'M'M A is g times the Schur complement of the Gram matrix of
// (lambda, 1) in that of (lambda, 1, A), g the determinant of the first, so that (Cauchy and Binet) its
// determinant is g times the sum over quadruples of filters of det(lambda, 1, A)^2, and that determinant is
// the quadruple's Vandermonde determinant over its D_i.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstddef>

#include "analysis/kkl_observer/non_negative_root.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::kkl_observer {

/// The infimum of |M T(x)|^2 / |T(x)|^2 over all signals of one frequency, as a function of the frequency,
/// for M distinct positive filter rates. Over intervals it needs the upward mode, and encloses.
template <typename Scalar, int M = 4>
class ExcitationRatio {
  static_assert(M >= 4);

 public:
  /// `lambda`: filter rates, 1/s.
  explicit ExcitationRatio(const Eigen::Matrix<Scalar, M, 1>& lambda) {
    using trackers::detail::square;
    Scalar gram(0.0);
    std::array<std::size_t, 4> found{};  // of pairs, triples, triples with another, quadruples
    for (std::size_t i = 0; i < kFilters; ++i) {
      lambda_[i] = lambda(static_cast<Eigen::Index>(i));
    }
    for (unsigned chosen = 1; chosen <= kAll; ++chosen) {
      const int size = std::popcount(chosen);
      if (size < 2 || size > 4) {
        continue;
      }
      const Scalar vandermonde = squared_vandermonde(chosen);
      if (size == 2) {
        gram += vandermonde;
        pairs_[found[0]++] = {kAll ^ chosen, vandermonde};
      } else if (size == 3) {
        const auto [a, b, c] = first_rates<3>(chosen);
        const Scalar e1 = a + b + c;
        const Scalar e2 = a * b + b * c + c * a;
        const Scalar e3 = a * b * c;
        triples_[found[1]++] = {
            kAll ^ chosen,
            (square(Scalar(a + b)) + square(Scalar(b + c)) + square(Scalar(c + a))) * vandermonde};
        for (std::size_t i = 0; i < kFilters; ++i) {
          const unsigned with = chosen | (1U << i);
          if (with != chosen) {
            crossed_[found[2]++] = {{kAll ^ with, vandermonde}, e3 - e2 * lambda_[i], lambda_[i] - e1};
          }
        }
      } else {
        quadruples_[found[3]++] = {kAll ^ chosen, vandermonde};
      }
    }
    for (Term& quadruple : quadruples_) {
      quadruple.weight = quadruple.weight * gram;
    }
  }

  /// At `frequency`, rad/s; a Scalar or a dual number over it.
  template <typename Number>
  [[nodiscard]] Number at(const Number& frequency) const {
    using trackers::detail::square;
    const Number s = square(frequency);
    std::array<Number, kAll + 1> products;  // of the D_i of a set of filters
    products[0] = Number(1.0);
    for (unsigned set = 1; set <= kAll; ++set) {
      const auto lowest = static_cast<std::size_t>(std::countr_zero(set));
      products[set] = products[set & (set - 1)] * Number(s + square(lambda_[lowest]));
    }
    // Each times the squared product of all D_i.
    const auto sum = [&products](const auto& terms) {
      Number total(0.0);
      for (const Term& term : terms) {
        total += square(products[term.others]) * term.weight;
      }
      return total;
    };
    const Number gram = sum(pairs_);              // det(A'A)
    const Number determinant = sum(quadruples_);  // det(A'M'M A)
    Number trace = sum(triples_);                 // of adj(A'A) A'M'M A
    for (const CrossedTerm& term : crossed_) {
      trace += square(Number(products[term.others] * Number(s * term.slope + term.constant))) * term.weight;
    }
    const Number mean = trace / gram;               // sum of the eigenvalues
    const Number eigenvalues = determinant / gram;  // their product
    // The discriminant is never negative; where the eigenvalues meet its enclosure may be.
    const Number discriminant = square(mean) - eigenvalues * Scalar(4.0);
    return eigenvalues * Scalar(2.0) / (mean + detail::root_of_non_negative(discriminant));
  }

 private:
  static constexpr std::size_t kFilters = M;
  static constexpr unsigned kAll = (1U << kFilters) - 1;  ///< the set of all filters, a bit for each

  static constexpr std::size_t kPairs = kFilters * (kFilters - 1) / 2;
  static constexpr std::size_t kTriples = kPairs * (kFilters - 2) / 3;
  static constexpr std::size_t kQuadruples = kTriples * (kFilters - 3) / 4;

  /// A number, and the filters by whose D_i it is multiplied.
  struct Term {
    unsigned others;
    Scalar weight;
  };
  /// For a triple and another filter l: e3 - s e1 - (e2 - s) l = constant + slope s.
  struct CrossedTerm : Term {
    Scalar constant, slope;
  };

  /// The rates of the first filters of a set.
  template <std::size_t Count>
  [[nodiscard]] std::array<Scalar, Count> first_rates(unsigned set) const {
    std::array<Scalar, Count> rates;
    for (Scalar& rate : rates) {
      rate = lambda_[static_cast<std::size_t>(std::countr_zero(set))];
      set &= set - 1;
    }
    return rates;
  }

  /// The squared product of all differences of rates of a set.
  [[nodiscard]] Scalar squared_vandermonde(unsigned set) const {
    using trackers::detail::square;
    Scalar product(1.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      for (std::size_t j = i + 1; j < kFilters; ++j) {
        if ((set >> i & set >> j & 1U) != 0) {
          product = product * square(Scalar(lambda_[i] - lambda_[j]));
        }
      }
    }
    return product;
  }

  std::array<Scalar, kFilters> lambda_;
  std::array<Term, kPairs> pairs_;
  std::array<Term, kTriples> triples_;
  std::array<CrossedTerm, kTriples*(kFilters - 3)> crossed_;
  std::array<Term, kQuadruples> quadruples_;
};

}  // namespace veritrack::kkl_observer

// How long a vector of ball polynomials can be.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"
#include "checker/model/symmetric_matrix.hpp"

namespace veritrack::checker {

/// Bounds on |F(x, v, w; s, z)| for vectors F of ball polynomials:
/// - the linear part, N x + B v + D w: for any positive p, q, r with p + q + r = 1 it is at most the root of
/// the
///   largest eigenvalue of N N'/p + B B'/q + D D'/r, of which the polynomial in s and z is expanded;
/// - of all other terms, of all degrees in x, v and w and each s^l z^m, the spectral norm of the
/// coefficients,
///   weighted as in Bombieri's norm.
class LengthBound {
 public:
  /// Keeps no reference.
  explicit LengthBound(const std::vector<BallPolynomial>& vector);

  /// True only when |F| <= bound for all |x| <= scale, |v| <= 1, |w| <= 1, and all s and z.
  [[nodiscard]] bool is_at_most(double bound, double scale) const;
  /// How much of the bound comes from the extent in s, and in z, about. Not evidence.
  [[nodiscard]] double by_phase() const { return by_phase_; }
  [[nodiscard]] double by_frequency() const { return by_frequency_; }

 private:
  /// N N' by s^l z^m: l, m <= 2 each, and a bound on all others; likewise of the other vectors.
  struct Gram {
    std::vector<SymmetricMatrix> terms;
    double others = 0.0;
    double rounding = 0.0;
    bool is_of_x = false;
  };
  using Shares = std::vector<double>;  ///< p, q, r of those that are there
  /// A part that is not linear.
  struct Part {
    int degree_in_x = 0;
    double norm = 0.0;
  };
  static Gram gram_of(const std::vector<BallPolynomial>& vector, std::size_t first, std::size_t last);
  void add_parts(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials, int degree);
  void add_form(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials, int degree,
                std::size_t form);
  /// 1/p and so on, times the square of the scale for x.
  [[nodiscard]] std::vector<double> factors(const Shares& shares, double scale) const;
  [[nodiscard]] bool linear_part_is_at_most(double square, double scale, const Shares& shares) const;
  [[nodiscard]] Shares proposed_shares(double scale) const;

  std::size_t size_;
  std::vector<Gram> grams_;  ///< of the vectors that there are
  std::vector<Part> parts_;
  double error_ = 0.0;
  double by_phase_ = 0.0;
  double by_frequency_ = 0.0;
};

}  // namespace veritrack::checker

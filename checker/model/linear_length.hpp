// Bounds on the length of the linear part of a vector of ball polynomials.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"
#include "checker/model/symmetric_matrix.hpp"

namespace veritrack::checker {

/// Bounds on the length of N x + B v + D w, where the matrices are polynomials in s and z: for any positive
/// p, q, r with p + q + r = 1 it is at most the root of the largest eigenvalue of N N'/p + B B'/q + D D'/r,
/// which is expanded as a polynomial in s and z. (N turns with the phase, N N' hardly does.)
class LinearLength {
 public:
  /// Nothing is known.
  LinearLength() = default;
  /// Keeps no reference.
  LinearLength(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials);

  /// True only when its square is at most this for all |x| <= scale, |v| <= 1, |w| <= 1, and all s and z.
  [[nodiscard]] bool square_is_at_most(double square, double scale) const;
  /// True only when of_x N N' + of_v B B' <= bound I, for all s and z; factors that are not negative.
  [[nodiscard]] bool sum_is_at_most(double bound, double of_x, double of_v) const;
  /// Approximately the largest eigenvalue of that matrix in the middle. Not evidence.
  [[nodiscard]] double near_sum(double of_x, double of_v) const;
  /// Approximately how much of the bound comes from the extent in s, and in z. Not evidence.
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
  using Shares = std::vector<double>;  ///< p, q, r of the vectors that are present

  static Gram gram_of(const std::vector<BallPolynomial>& vector, std::size_t first, std::size_t last);
  /// 1/p and so on, times the square of the scale for x.
  [[nodiscard]] std::vector<double> factors(const Shares& shares, double scale) const;
  [[nodiscard]] bool is_bounded(double square, double scale, const Shares& shares) const;
  /// The sum of the Gram matrices times these factors is at most `bound`, after a deduction for the parts
  /// that are not kept.
  [[nodiscard]] bool is_bounded(double bound, const std::vector<double>& factor) const;
  [[nodiscard]] Shares proposed_shares(double scale) const;

  std::size_t size_ = 0;
  std::vector<Gram> grams_;  ///< of the vectors that are present
  double by_phase_ = 0.0;
  double by_frequency_ = 0.0;
};

}  // namespace veritrack::checker

// How long a vector of ball polynomials can be.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"
#include "checker/model/symmetric_matrix.hpp"

namespace veritrack::checker {

/// Bounds on |F(x, v; s, z)| for vectors F of ball polynomials:
/// - the part that is linear in x and in v, N x + B v: for any t in (0, 1) it is at most the root of the
///   largest eigenvalue of N N'/t + B B'/(1 - t), of which the polynomial in s and z is expanded;
/// - of all other terms, of each pair of degrees in x and v and each s^l z^m, the spectral norm of the
///   coefficients, weighted as in Bombieri's norm.
class LengthBound {
 public:
  /// Keeps no reference.
  explicit LengthBound(const std::vector<BallPolynomial>& vector);

  /// True only when |F| <= bound for all |x| <= scale, |v| <= 1, and all s and z.
  [[nodiscard]] bool is_at_most(double bound, double scale) const;
  /// How much of the bound comes from the extent in s, and in z, about. Not evidence.
  [[nodiscard]] double by_phase() const { return by_phase_; }
  [[nodiscard]] double by_frequency() const { return by_frequency_; }

 private:
  /// Products of N with itself, by s^l z^m: l, m <= 2 each, and a bound on all others.
  struct Gram {
    std::vector<SymmetricMatrix> terms;
    double others = 0.0;
    double rounding = 0.0;
  };
  /// A part that is not linear.
  struct Part {
    int degree_in_x = 0;
    double norm = 0.0;
  };
  static Gram gram_of(const std::vector<BallPolynomial>& vector, std::size_t first, std::size_t last);
  void add_parts(const std::vector<BallPolynomial>& vector, int degree);
  [[nodiscard]] bool linear_part_is_at_most(double square, double scale, double t) const;
  [[nodiscard]] double proposed_share(double scale) const;

  std::size_t size_;
  Gram of_x_, of_v_;
  bool has_v_ = false;
  std::vector<Part> parts_;
  double error_ = 0.0;
  double by_phase_ = 0.0;
  double by_frequency_ = 0.0;
};

}  // namespace veritrack::checker

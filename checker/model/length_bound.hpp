// Bounds on the length of a vector of ball polynomials.
#pragma once

#include <vector>

#include "checker/model/linear_length.hpp"

namespace veritrack::checker {

/// Bounds on |F(x, v, w; s, z)| for vectors F of ball polynomials: the bound of the linear part; for all
/// other terms, of each set of degrees in x, v and w and each s^l z^m, the spectral norm of the coefficients,
/// weighted as in Bombieri's norm; and the errors.
class LengthBound {
 public:
  /// Keeps no reference.
  explicit LengthBound(const std::vector<BallPolynomial>& vector);

  /// True only when |F| <= bound for all |x| <= scale, |v| <= 1, |w| <= 1, and all s and z.
  [[nodiscard]] bool is_at_most(double bound, double scale) const;
  /// Whether the truncated part, which shrinks in smaller balls, exceeds what is present at x = 0. Not
  /// evidence.
  [[nodiscard]] bool is_cut_off() const;
  /// The linear part, and bounds of the other parts: of the terms without v and of the errors for |x| <=
  /// scale, and of the terms with v, over |v|. Infinite when nothing is known.
  [[nodiscard]] const LinearLength& linear() const { return linear_; }
  [[nodiscard]] double without_noise(double scale) const;
  [[nodiscard]] double with_noise(double scale) const;
  /// Approximately how much of the bound comes from the extent in s, and in z. Not evidence.
  [[nodiscard]] double by_phase() const { return by_phase_; }
  [[nodiscard]] double by_frequency() const { return by_frequency_; }
  /// The truncated part. Not evidence by itself.
  [[nodiscard]] double error() const { return error_; }
  /// Whether these bounds are of use: not where errors are far longer than the bound to be shown. Not
  /// evidence.
  [[nodiscard]] bool tells_extents(double radius) const { return error_ < 64.0 * radius; }

 private:
  /// A part that is not linear.
  struct Part {
    int degree_in_x = 0;
    bool has_noise = false;  ///< of degree 1 or more in v or w
    double norm = 0.0;
    [[nodiscard]] double at(double scale) const;
  };
  void add_parts(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials, int degree);
  void add_form(const std::vector<BallPolynomial>& vector, const VectorMonomials& monomials, int degree,
                std::size_t form);

  LinearLength linear_;
  std::vector<Part> parts_;
  double error_ = 0.0;
  double by_phase_ = 0.0;
  double by_frequency_ = 0.0;
};

}  // namespace veritrack::checker

// Ball models: polynomials in vectors that run over balls, with a bound on their error.
//
// The promise. A BallModel f represents a set of functions of x and v, each in a closed unit ball, and of s
// and z in
// [-1, 1]: all those that stay within `error()` of its polynomial. An operation on ball models gives one that
// contains the result of the operation on all functions in its operands. The error includes truncation,
// rounding, and the width of interval constants. Where that cannot be bounded the error is NaN, which means
// "nothing is known", and stays NaN.
//
// A homogeneous polynomial p of degree m in x is bounded on the ball by Bombieri's norm, [p]^2 = sum
// |c_alpha|^2 alpha!/m!, and [pq] <= [p][q] (B. Beauzamy, E. Bombieri, P. Enflo, H. Montgomery, 1990; by
// Cauchy and Schwarz, p(x) being the inner product of a symmetric tensor with x^m, and symmetrisation being a
// projection). The same is true with two vectors, a norm for each. The norm depends on |c_alpha| only:
// rounding errors of coefficients are bounded by norms, too. Truncated products go into the error as products
// of norms.
//
// Needs the upward rounding mode.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "analysis/rigor/ball_monomials.hpp"
#include "analysis/rigor/ball_numbers.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor {

/// The monomials that this thread's ball models have, from construction to destruction. Scopes nest.
class BallModelScope {
 public:
  BallModelScope(int balls, int disturbances);
  ~BallModelScope();
  BallModelScope(const BallModelScope&) = delete;
  BallModelScope& operator=(const BallModelScope&) = delete;
  BallModelScope(BallModelScope&&) = delete;
  BallModelScope& operator=(BallModelScope&&) = delete;

  /// The monomials of the innermost scope of this thread. Throws std::logic_error when there is none.
  [[nodiscard]] static const BallMonomials& monomials();

 private:
  const BallMonomials* outer_;
  UpwardRounding upward_;
};

class BallModel {
 public:
  /// Zero; like all others, with the monomials of the scope.
  BallModel();
  /// The constant that this double is.
  explicit BallModel(double constant);
  explicit BallModel(int constant) : BallModel(static_cast<double>(constant)) {}
  /// A function known only by its range; nothing is known about it unless the range is finite.
  explicit BallModel(const Interval& range);

  /// The component number `index` of x, of v, and s and z.
  [[nodiscard]] static BallModel ball(int index);
  [[nodiscard]] static BallModel disturbance(int index);
  [[nodiscard]] static BallModel s();
  [[nodiscard]] static BallModel z();

  [[nodiscard]] const BallMonomials& monomials() const { return *monomials_; }
  [[nodiscard]] std::span<const double> coefficients() const {
    return {numbers_.data(), monomials_->terms()};
  }
  [[nodiscard]] double constant() const { return numbers_.data()[0]; }
  /// An upper bound of the polynomial of a class, by the class's number.
  [[nodiscard]] double norm(std::size_t number) const { return norms()[number]; }
  /// At least 0; NaN when nothing is known.
  [[nodiscard]] double error() const { return error_; }
  /// An upper bound of |f - constant()|; NaN when nothing is known.
  [[nodiscard]] double deviation() const;
  /// Contains all values; empty when nothing is known.
  [[nodiscard]] Interval range() const;
  /// Contains the mean over s of each function, whatever x and v do while s runs, for all z; empty when
  /// nothing is known.
  [[nodiscard]] Interval mean_over_s() const;
  /// The same as a polynomial in z, which can be added up before its range is taken.
  struct MeanInZ {
    std::array<Interval, 5> powers;  ///< coefficients of z^d
    double around = 0.0;             ///< how far the mean may be off; NaN or infinite when nothing is known

    MeanInZ& operator+=(const MeanInZ& other);
    /// Contains its values for all |z| <= 1; empty when nothing is known.
    [[nodiscard]] Interval range() const;
  };
  [[nodiscard]] MeanInZ mean_in_z() const;
  /// The same without the constant: f - constant().
  [[nodiscard]] BallModel without_constant() const;
  /// Adds the double `factor` times the other.
  void add_multiple(const BallModel& other, double factor);
  /// The same functions of s and z among the models of this thread's scope. Throws std::logic_error when
  /// there are terms in x or v.
  [[nodiscard]] BallModel lifted() const;
  /// The polynomial alone: error() is 0. Not known when nothing is known.
  [[nodiscard]] BallModel without_error() const;
  /// Every function that is within `more` of one of these.
  [[nodiscard]] BallModel widened(double more) const;

  BallModel& operator+=(const BallModel& other) {
    add(other, 1.0);
    return *this;
  }
  BallModel& operator-=(const BallModel& other) {
    add(other, -1.0);
    return *this;
  }
  friend BallModel operator+(BallModel a, const BallModel& b) {
    a += b;
    return a;
  }
  friend BallModel operator-(BallModel a, const BallModel& b) {
    a -= b;
    return a;
  }
  friend BallModel operator-(const BallModel& a);
  friend BallModel operator*(const BallModel& a, const BallModel& b);

 private:
  void add(const BallModel& other, double sign);
  void add_terms(const BallModel& other, double factor);
  void find_norm(std::size_t number);
  void multiply_in_plane(const BallModel& a, const BallModel& b);
  void multiply_by_classes(const BallModel& a, const BallModel& b);
  [[nodiscard]] double polynomial_bound() const;
  [[nodiscard]] double* terms() { return numbers_.data(); }
  /// By class; 0 for a class without terms.
  [[nodiscard]] double* norms() { return numbers_.data() + monomials_->terms(); }
  [[nodiscard]] const double* norms() const { return numbers_.data() + monomials_->terms(); }

  const BallMonomials* monomials_;
  BallNumbers numbers_;  ///< coefficients, then norms
  double error_ = 0.0;
};

/// NaN where b can vanish.
[[nodiscard]] BallModel operator/(const BallModel& a, const BallModel& b);
[[nodiscard]] BallModel square(const BallModel& x);

// NaN where the function is not smooth or not defined.
[[nodiscard]] BallModel sqrt(const BallModel& x);
[[nodiscard]] BallModel exp(const BallModel& x);
[[nodiscard]] BallModel log(const BallModel& x);
[[nodiscard]] BallModel sin(const BallModel& x);
[[nodiscard]] BallModel cos(const BallModel& x);
[[nodiscard]] BallModel tan(const BallModel& x);
[[nodiscard]] BallModel asin(const BallModel& x);
[[nodiscard]] BallModel acos(const BallModel& x);
[[nodiscard]] BallModel atan(const BallModel& x);
[[nodiscard]] BallModel atan2(const BallModel& y, const BallModel& x);
/// x; NaN unless low < x < high is shown.
[[nodiscard]] BallModel stays_within(const BallModel& x, const BallModel& low, const BallModel& high);

}  // namespace veritrack::rigor

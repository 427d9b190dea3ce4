// Functions of vectors x, v and w in balls |x| <= 1, |v| <= 1, |w| <= 1, and two places s, z in [-1, 1] of a
// cell: a polynomial of degree at most three in the vectors together and at most four in all, and a bound on
// the distance from it.
//
// The coefficients of all x^a v^b w^c of the same degrees |a|, |b|, |c| that stand with one s^l z^m are a
// form, whose Bombieri norm [p]^2 = sum |p_abc|^2 a!/|a|! b!/|b|! c!/|c|! bounds it on the balls; [pq] <=
// [p][q] (Beauzamy, Bombieri, Enflo, Montgomery), so that norms also bound the truncated part of products.
//
// Coefficients are doubles. In every rounding mode, an operation on doubles is wrong by at most 2^-52 of its
// result or of the subnormal unit: that goes into the bound, generously.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "checker/model/vector_monomials.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// The number of s^l z^m with l + m <= degree. They are numbered by degree, and then by m.
constexpr std::size_t places_up_to(int degree) {
  return static_cast<std::size_t>((degree + 1) * (degree + 2) / 2);
}

class BallPolynomial {
 public:
  static constexpr int kMostDegree = 4;
  static constexpr int kMostOfVectors = VectorMonomials::kMostDegree;

  static constexpr std::size_t kPlaces = places_up_to(kMostDegree);

  /// Zero.
  BallPolynomial() = default;
  BallPolynomial(double constant);  // NOLINT(google-explicit-constructor)
  /// Any number of the ball.
  BallPolynomial(const Ball& constant);  // NOLINT(google-explicit-constructor)
  /// Nothing is known.
  static BallPolynomial everything();
  /// s and z.
  static BallPolynomial phase();
  static BallPolynomial frequency();
  /// A component of one of the vectors. The monomials must outlive everything computed from it.
  static BallPolynomial variable(const VectorMonomials& monomials, std::size_t number);
  /// constant + by_phase s + by_frequency z, up to an error.
  static BallPolynomial affine(double constant, double by_phase, double by_frequency, double error);

  /// With these coefficients of s^l z^m, up to an error.
  static BallPolynomial of_places(std::span<const double, kPlaces> coefficients, double error);

  /// Whether it is bounded at all.
  [[nodiscard]] bool known() const;
  /// A bound on the distance from the polynomial; infinite when nothing is known.
  [[nodiscard]] double error() const { return error_; }
  /// All values.
  [[nodiscard]] Ball range() const;
  /// All values divided by 2 over all s, integrated: their mean, as a polynomial in z, and an error for x.
  [[nodiscard]] BallPolynomial mean_over_phase() const;
  [[nodiscard]] double constant() const { return coefficients_.empty() ? 0.0 : coefficients_[0]; }
  /// The highest degree in the vectors with coefficients; -1 for zero.
  [[nodiscard]] int vector_degree() const { return degree_; }
  /// The coefficients of a monomial of the vectors: places_up_to(4 - degree) of them, or none.
  [[nodiscard]] std::span<const double> block(int degree, std::size_t number) const;
  [[nodiscard]] const VectorMonomials* monomials() const { return monomials_; }
  /// A bound on the polynomial, without its error.
  [[nodiscard]] double norm() const { return norms().all; }
  /// A bound on the part of a degree in the vectors and another in s and z.
  [[nodiscard]] double norm(int vector_degree, int place_degree) const;

  BallPolynomial& operator+=(const BallPolynomial& y) { return add(y, 1.0); }
  BallPolynomial& operator-=(const BallPolynomial& y) { return add(y, -1.0); }
  /// This and factor times y.
  BallPolynomial& add(const BallPolynomial& y, double factor);
  /// Returns the bound on the distance and sets it to zero: the polynomial alone remains. Only for a bounded
  /// one.
  [[nodiscard]] double take_error() { return std::exchange(error_, 0.0); }
  /// All functions within `distance` of these.
  BallPolynomial& widen(double distance);

  friend BallPolynomial operator*(const BallPolynomial& x, const BallPolynomial& y);
  friend BallPolynomial operator*(double factor, const BallPolynomial& x);
  friend BallPolynomial operator-(const BallPolynomial& x);

 private:
  static constexpr std::size_t kGroups = 5 + 4 + 3 + 2;
  /// Norms by the degree in the vectors and the degree in s and z, and their sum.
  struct Norms {
    std::array<double, kGroups> of{};
    double all = 0.0;
  };
  static constexpr std::size_t group(int vector_degree, int place_degree) {
    return static_cast<std::size_t>(vector_degree * 5 - vector_degree * (vector_degree - 1) / 2 +
                                    place_degree);
  }
  [[nodiscard]] const Norms& norms() const;
  [[nodiscard]] std::size_t begin_of(int degree) const;
  /// Makes room for the coefficients of this degree; none are lost.
  void grow(int degree, const VectorMonomials* monomials);
  void set_error(double error);
  [[nodiscard]] bool is_zero() const { return coefficients_.empty() && error_ == 0.0; }
  static BallPolynomial full_product(const BallPolynomial& x, const BallPolynomial& y);
  static double cut_off(const Norms& x, const Norms& y);

  const VectorMonomials* monomials_ = nullptr;
  int degree_ = -1;                   ///< in the vectors
  std::vector<double> coefficients_;  ///< none, one, or by degree in the vectors and number of the monomial
  double error_ = 0.0;
  mutable bool norms_are_known_ = false;
  mutable Norms norms_;
};

inline BallPolynomial operator+(BallPolynomial x, const BallPolynomial& y) {
  return x += y;
}
inline BallPolynomial operator-(BallPolynomial x, const BallPolynomial& y) {
  return x -= y;
}
BallPolynomial reciprocal(const BallPolynomial& x);
inline BallPolynomial operator/(const BallPolynomial& x, const BallPolynomial& y) {
  return x * reciprocal(y);
}

// Nothing is known of the value of a function that is not defined for all arguments.
BallPolynomial sqrt(const BallPolynomial& x);
BallPolynomial exp(const BallPolynomial& x);
BallPolynomial log(const BallPolynomial& x);
BallPolynomial sin(const BallPolynomial& x);
BallPolynomial cos(const BallPolynomial& x);
BallPolynomial tangent(const BallPolynomial& x);
BallPolynomial arcsine(const BallPolynomial& x);
BallPolynomial arccosine(const BallPolynomial& x);
BallPolynomial arctangent(const BallPolynomial& x);
/// The angle of (x, y), off its cut at x < 0, y = 0.
BallPolynomial arctangent2(const BallPolynomial& y, const BallPolynomial& x);
/// x, where certainly low < x < high.
BallPolynomial stays_within(const BallPolynomial& x, const BallPolynomial& low, const BallPolynomial& high);
// Functions with kinks: one branch where that is certain, else a chord and what lies between
// (docs/model-proof.md, section 19). Nothing is known of those that may jump.
BallPolynomial larger(const BallPolynomial& x, const BallPolynomial& y);
BallPolynomial clamped(const BallPolynomial& x, const BallPolynomial& low, const BallPolynomial& high);
/// `a` where `positive` > 0, else `b`.
BallPolynomial chosen(const BallPolynomial& positive, const BallPolynomial& a, const BallPolynomial& b);
BallPolynomial sign_of(const BallPolynomial& x);

/// The number of coefficients of a monomial of the vectors of this degree.
constexpr std::size_t size_of_block(int degree) {
  return places_up_to(BallPolynomial::kMostDegree - degree);
}

}  // namespace veritrack::checker

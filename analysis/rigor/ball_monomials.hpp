// The monomials of ball models, and which product of two of them is which third.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace veritrack::rigor {

/// The monomials x^a v^b s^c z^d of degree at most `kMostOfVectors` in the vectors x and v together and at
/// most `kMost` in all: x runs over a ball of R^balls, v over another of R^disturbances, s and z over [-1,
/// 1]. They are ordered by classes of equal degrees. For one pair of sizes, made once and shared.
class BallMonomials {
 public:
  static constexpr int kMostOfVectors = 3;
  static constexpr int kMost = 4;

  /// The monomials of one set of degrees: the coefficients first, ..., last - 1.
  struct Class {
    int ball = 0;
    int disturbance = 0;
    int s = 0;
    int z = 0;
    std::size_t first = 0;
    std::size_t last = 0;
  };
  /// The product of the coefficients `a` and `b` belongs to the coefficient `c`.
  struct Product {
    std::uint16_t a, b, c;
  };
  /// The products of two classes that are kept.
  struct ClassProduct {
    std::size_t a, b;  ///< numbers of classes
    std::size_t c;     ///< class of the product; the number of classes when it is not kept
    std::size_t first = 0;
    std::size_t last = 0;  ///< in products()
  };

  /// Shared tables; balls from 0 to 16, disturbances from 0 to 3. Throws std::invalid_argument otherwise.
  [[nodiscard]] static const BallMonomials& of(int balls, int disturbances);

  [[nodiscard]] int balls() const { return balls_; }
  [[nodiscard]] int disturbances() const { return disturbances_; }
  [[nodiscard]] std::size_t terms() const { return weights_.size(); }
  [[nodiscard]] const std::vector<Class>& classes() const { return classes_; }
  /// The number of the class with these degrees, which must be kept.
  [[nodiscard]] std::size_t class_of(int ball, int disturbance, int s, int z) const;
  /// alpha! / |alpha|! of the exponents of x, times the same of v: the weights of Bombieri's norm, rounded
  /// up.
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }
  /// For every pair of classes, in the order of the first and then the second.
  [[nodiscard]] const ClassProduct& product(std::size_t a, std::size_t b) const {
    return pairs_[a * classes_.size() + b];
  }
  [[nodiscard]] const std::vector<Product>& products() const { return products_; }

 private:
  BallMonomials(int balls, int disturbances);

  int balls_;
  int disturbances_;
  std::vector<Class> classes_;
  std::vector<double> weights_;
  std::vector<ClassProduct> pairs_;
  std::vector<Product> products_;
};

}  // namespace veritrack::rigor

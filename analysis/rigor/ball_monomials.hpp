// The monomials of ball models, and which product of two of them is which third.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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
  /// The products of two classes whose product is kept.
  struct ClassProduct {
    std::uint16_t a, b;  ///< numbers of classes
    std::uint16_t c;     ///< class of the product
    /// One of the two has s and z alone, a single term: the terms of the other belong to those of the product
    /// in their order.
    bool is_multiple;
    std::uint32_t first;
    std::uint32_t last;  ///< in products()
  };
  /// Degrees in which truncation is decided: in x and v together, and in s and z together. Their number is
  /// kMostOfVectors + 1 times kMost + 1.
  static constexpr std::size_t kGroups = 20;
  [[nodiscard]] static std::size_t group_of(const Class& here) {
    return static_cast<std::size_t>((here.ball + here.disturbance) * (kMost + 1) + here.s + here.z);
  }
  /// Whether the product of two classes of these groups is kept.
  [[nodiscard]] static constexpr bool is_kept(std::size_t group_of_a, std::size_t group_of_b) {
    constexpr std::size_t kOfPlace = kMost + 1;
    const std::size_t vectors = group_of_a / kOfPlace + group_of_b / kOfPlace;
    return vectors <= kMostOfVectors && vectors + group_of_a % kOfPlace + group_of_b % kOfPlace <= kMost;
  }

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
  /// The group of every class.
  [[nodiscard]] const std::vector<std::uint8_t>& groups() const { return groups_; }
  /// Whether every class has one term, of weight 1: models of s and z alone.
  [[nodiscard]] bool is_plane() const { return balls_ == 0 && disturbances_ == 0; }
  /// The pairs of classes with this class first whose product is kept, in the order of the second.
  [[nodiscard]] std::span<const ClassProduct> pairs_of(std::size_t a) const {
    return {pairs_.data() + first_pair_[a], first_pair_[a + 1] - first_pair_[a]};
  }
  /// For all these pairs in their order.
  [[nodiscard]] const std::vector<Product>& products() const { return products_; }

 private:
  BallMonomials(int balls, int disturbances);

  int balls_;
  int disturbances_;
  std::vector<Class> classes_;
  std::vector<double> weights_;
  std::vector<std::uint8_t> groups_;
  std::vector<ClassProduct> pairs_;
  std::vector<std::size_t> first_pair_;
  std::vector<Product> products_;
};

}  // namespace veritrack::rigor

// The monomials of degree at most three in the components of two vectors, x and v.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace veritrack::checker {

/// x in R^balls, v in R^disturbances: variables number 0 to balls - 1, then those of v. The monomials of a
/// degree are numbered from 0.
class VectorMonomials {
 public:
  static constexpr int kMostDegree = 3;

  /// What Bombieri's norm needs of a monomial of exponents a in x and b in v.
  struct Kind {
    int degree_of_v = 0;
    double weight = 1.0;  ///< a!/|a|! b!/|b|!, rounded up
  };

  /// At most 20 variables. Throws std::invalid_argument for more, or none.
  VectorMonomials(std::size_t balls, std::size_t disturbances);

  [[nodiscard]] std::size_t balls() const { return balls_; }
  [[nodiscard]] std::size_t variables() const { return variables_; }
  /// How many monomials of this degree there are.
  [[nodiscard]] std::size_t count(int degree) const {
    return kinds_[static_cast<std::size_t>(degree)].size();
  }
  [[nodiscard]] const std::vector<Kind>& kinds(int degree) const {
    return kinds_[static_cast<std::size_t>(degree)];
  }
  /// The number of the product of two variables.
  [[nodiscard]] std::size_t pair(std::size_t i, std::size_t j) const { return pairs_[i * variables_ + j]; }
  /// The number of the product of a variable and a monomial of degree two.
  [[nodiscard]] std::size_t triple(std::size_t i, std::size_t pair) const {
    return triples_[i * count(2) + pair];
  }

 private:
  std::size_t balls_;
  std::size_t variables_;
  std::vector<std::vector<Kind>> kinds_;
  std::vector<std::uint32_t> pairs_;
  std::vector<std::uint32_t> triples_;
};

}  // namespace veritrack::checker

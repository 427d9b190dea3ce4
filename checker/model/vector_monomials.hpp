// The monomials of degree at most three in the components of three vectors, x, v and w.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace veritrack::checker {

/// x, v and w of these sizes: variables number 0 to x - 1, then those of v, then those of w. The monomials of
/// a degree are numbered from 0.
class VectorMonomials {
 public:
  static constexpr int kMostDegree = 3;

  static constexpr std::size_t kVectors = 3;
  /// The number of pairs of degrees in v and w.
  static constexpr std::size_t kForms = (kMostDegree + 1) * (kMostDegree + 1);

  /// A monomial's data for Bombieri's norm; its exponents are a in x, b in v and c in w.
  struct Kind {
    int degree_of_x = 0;
    std::size_t form = 0;  ///< the same for the same degrees in v and w
    double weight = 1.0;   ///< a!/|a|! b!/|b|! c!/|c|!, rounded up
  };

  /// At most 20 variables. Throws std::invalid_argument for more, or for zero.
  explicit VectorMonomials(std::size_t x, std::size_t v = 0, std::size_t w = 0);

  /// The first variable of x, v and w; of number kVectors: how many variables there are.
  [[nodiscard]] std::size_t first(std::size_t vector) const { return firsts_.at(vector); }
  [[nodiscard]] std::size_t size(std::size_t vector) const {
    return firsts_.at(vector + 1) - firsts_[vector];
  }
  [[nodiscard]] std::size_t variables() const { return variables_; }
  /// The number of monomials of this degree.
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
  std::array<std::size_t, kVectors + 1> firsts_;
  std::size_t variables_;
  std::vector<std::vector<Kind>> kinds_;
  std::vector<std::uint32_t> pairs_;
  std::vector<std::uint32_t> triples_;
};

}  // namespace veritrack::checker

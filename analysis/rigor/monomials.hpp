// The monomials of a few variables up to a degree, numbered by degree: 1; x, y; x^2, x y, y^2; ...
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace veritrack::rigor::detail {

template <int Variables, int Degree>
struct Monomials {
  static_assert(Variables >= 1 && Degree >= 1);
  using Exponents = std::array<int, static_cast<std::size_t>(Variables)>;

  /// The number of monomials of degree at most `degree`: (degree + Variables) choose Variables.
  [[nodiscard]] static constexpr std::size_t count_up_to(int degree) {
    std::size_t count = 1;
    for (int i = 1; i <= Variables; ++i) {
      count = count * static_cast<std::size_t>(degree + i) / static_cast<std::size_t>(i);
    }
    return count;
  }
  static constexpr std::size_t kTerms = count_up_to(Degree);

  /// The exponents of monomial number i. Within a degree the first variable's exponent decreases.
  static constexpr std::array<Exponents, kTerms> kExponents = [] {
    std::array<Exponents, kTerms> all{};
    std::size_t next = 0;
    for (int degree = 0; degree <= Degree; ++degree) {
      Exponents exponents{};
      exponents[0] = degree;
      for (;;) {
        all[next++] = exponents;
        // The successor: one less of the last variable but one that has any, the rest to the next.
        int at = Variables - 2;
        while (at >= 0 && exponents[static_cast<std::size_t>(at)] == 0) {
          --at;
        }
        if (at < 0) {
          break;
        }
        const std::size_t place = static_cast<std::size_t>(at);
        const int rest = exponents[static_cast<std::size_t>(Variables - 1)];
        exponents[static_cast<std::size_t>(Variables - 1)] = 0;
        --exponents[place];
        exponents[place + 1] = rest + 1;
      }
    }
    return all;
  }();

  static constexpr std::array<std::size_t, kTerms> kDegrees = [] {
    std::array<std::size_t, kTerms> degrees{};
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (const int exponent : kExponents[i]) {
        degrees[i] += static_cast<std::size_t>(exponent);
      }
    }
    return degrees;
  }();

  /// Whether every exponent is even, so that the monomial is never negative.
  static constexpr std::array<bool, kTerms> kIsSquare = [] {
    std::array<bool, kTerms> is_square{};
    for (std::size_t i = 0; i < kTerms; ++i) {
      is_square[i] = true;
      for (const int exponent : kExponents[i]) {
        is_square[i] = is_square[i] && exponent % 2 == 0;
      }
    }
    return is_square;
  }();

  /// How many monomials have degree at most d; they are the first ones.
  static constexpr std::array<std::size_t, static_cast<std::size_t>(Degree) + 1> kCountUpTo = [] {
    std::array<std::size_t, static_cast<std::size_t>(Degree) + 1> counts{};
    for (std::size_t d = 0; d < counts.size(); ++d) {
      counts[d] = count_up_to(static_cast<int>(d));
    }
    return counts;
  }();

  /// The number of the product of two monomials, where that is of degree at most Degree (else 0, which must
  /// not be used).
  static constexpr std::array<std::array<std::uint16_t, kTerms>, kTerms> kProducts = [] {
    constexpr auto kVariables = static_cast<std::size_t>(Variables);
    std::array<std::array<std::uint16_t, kTerms>, kTerms> products{};
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) {
        const std::size_t degree = kDegrees[i] + kDegrees[j];
        if (degree > static_cast<std::size_t>(Degree)) {
          continue;
        }
        const std::size_t begin = degree == 0 ? 0 : count_up_to(static_cast<int>(degree) - 1);
        const std::size_t end = count_up_to(static_cast<int>(degree));
        // Few steps: compilers limit how many a constant expression may take.
        for (std::size_t k = begin; k < end; ++k) {
          std::size_t v = 0;
          while (v < kVariables && kExponents[k][v] == kExponents[i][v] + kExponents[j][v]) {
            ++v;
          }
          if (v == kVariables) {
            products[i][j] = static_cast<std::uint16_t>(k);
            break;
          }
        }
      }
    }
    return products;
  }();
};

}  // namespace veritrack::rigor::detail

// Functions of the place (s, z) in a cell alone, in an array. Sums over tubes consist of very many of them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "checker/model/ball_polynomial.hpp"

namespace veritrack::checker {

/// A polynomial of degree at most four in s and z in [-1, 1], and a bound on the distance from it.
struct PlacePolynomial {
  std::array<double, BallPolynomial::kPlaces> coefficients{};  ///< by degree, and then by the power of z
  double error = 0.0;  ///< infinite or "not a number" when nothing is known

  /// A bound on the polynomial.
  [[nodiscard]] double norm() const;
};

/// cos and sin of constant + by_phase s + by_frequency z.
struct CosineSine {
  PlacePolynomial cosine, sine;
  CosineSine(const Ball& constant, const Ball& by_phase, const Ball& by_frequency);
};

/// The first `count` powers y^d, d = 0, 1, ..., where y is within `error` of middle + half_width z.
std::vector<PlacePolynomial> powers_of_place(double middle, double half_width, double error,
                                             std::size_t count);

/// x y, where y is a function of z alone.
PlacePolynomial product_with_power(const PlacePolynomial& x, const PlacePolynomial& y);

/// Each factor of a linear combination may be wrong by this many roundings.
inline constexpr std::size_t kRoundingsOfFactor = 8;

/// The sum of factors times functions; there are as many factors as functions.
BallPolynomial linear_combination(const std::vector<double>& factors,
                                  const std::vector<PlacePolynomial>& functions);

}  // namespace veritrack::checker

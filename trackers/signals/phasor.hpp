// A point that rotates on the unit circle for any number of samples, identical bit for bit on every machine.
//
// The phase is kept in [-pi, pi], so that the millionth sample is as accurate as the first, and its sine
// and cosine are evaluated here with + - * alone: those of libm differ between machines in the last bit.
// Compile without contraction into fused multiply-adds (-ffp-contract=off) where identical bits matter.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace veritrack::trackers {

/// pi/2 as a double, and the next 53 bits.
inline constexpr double kHalfPi = 0x1.921fb54442d18p+0;
inline constexpr double kHalfPiRest = 0x1.1a62633145c07p-54;

namespace detail {

// Taylor coefficients of sin x / x and cos x in x^2, first to last; compile-time constants under all flags.
inline constexpr std::array<double, 8> kSineCoefficients{1.0,
                                                         -1.0 / 6.0,
                                                         1.0 / 120.0,
                                                         -1.0 / 5040.0,
                                                         1.0 / 362880.0,
                                                         -1.0 / 39916800.0,
                                                         1.0 / 6227020800.0,
                                                         -1.0 / 1307674368000.0};
inline constexpr std::array<double, 9> kCosineCoefficients{1.0,
                                                           -1.0 / 2.0,
                                                           1.0 / 24.0,
                                                           -1.0 / 720.0,
                                                           1.0 / 40320.0,
                                                           -1.0 / 3628800.0,
                                                           1.0 / 479001600.0,
                                                           -1.0 / 87178291200.0,
                                                           1.0 / 20922789888000.0};

/// Horner's rule.
template <std::size_t Size>
[[nodiscard]] inline double polynomial(const std::array<double, Size>& coefficients, double x) {
  double value = coefficients[Size - 1];
  for (std::size_t i = Size - 1; i > 0; --i) {
    value = value * x + coefficients[i - 1];
  }
  return value;
}

}  // namespace detail

/// (cos phase, sin phase) to about 2^-52, for |phase| <= 4 rad.
[[nodiscard]] inline std::pair<double, double> unit_phasor(double phase) {
  // |quarter turns| <= 3; their product with kHalfPi and the difference are exact or nearly so.
  constexpr double kQuartersPerRadian = 1.0 / kHalfPi;
  const double quarters = std::floor(phase * kQuartersPerRadian + 0.5);
  const double x = (phase - quarters * kHalfPi) - quarters * kHalfPiRest;
  // |x| <= pi/4 and a little more: the first omitted terms are below 5e-17 and 3e-18.
  const double square = x * x;
  const double sine = x * detail::polynomial(detail::kSineCoefficients, square);
  const double cosine = detail::polynomial(detail::kCosineCoefficients, square);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

/// The same angle in [-pi, pi] up to rounding, for |phase| <= 3 pi: one turn is added or subtracted where
/// needed.
[[nodiscard]] inline double wrapped(double phase) {
  if (phase > 2.0 * kHalfPi) {
    return (phase - 4.0 * kHalfPi) - 4.0 * kHalfPiRest;
  }
  if (phase < -2.0 * kHalfPi) {
    return (phase + 4.0 * kHalfPi) + 4.0 * kHalfPiRest;
  }
  return phase;
}

}  // namespace veritrack::trackers

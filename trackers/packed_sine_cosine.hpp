// Sine and cosine of several angles side by side, for packed.hpp.
//
// They are within one unit in the last place, as docs/rounding.md asks (a test compares them with MPFR), and
// so are those of a C library, but the two may choose different neighbours.
#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "trackers/packed.hpp"

namespace veritrack::trackers {

namespace detail {

/// The largest |x| whose sine and cosine are computed side by side.
inline constexpr double kLargestPackedAngle = 64.0;

/// Constants and series of the two scalars, for x = n pi/2 + r with |r| <= pi/4 and a little.
///
/// pi/2 is in three parts, of which the products of the first two with n are exact. With z = r^2,
///     sin r = r - r^3 (1/6 - z sine(z)),   cos r = 1 - z/2 + z^2 cosine(z),
/// the two polynomials by Remez's algorithm for the smallest error of z^2 sine(z) and z^2 cosine(z).
template <typename Scalar>
struct AngleSeries;

/// Errors below 2^-68 and 2^-64.
template <>
struct AngleSeries<double> {
  static constexpr double kHalfPi1 = 0x1.921fb544p+0;  // 33 bits
  static constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
  static constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
  static constexpr double kToInteger = 0x1.8p+52;  // adding it leaves the nearest integer in the lowest bits

  template <typename Numbers>
  static Numbers sine(const Numbers& z, const Numbers& z2) {
    return ((0x1.111111111110fp-7 - z * 0x1.a01a01a019377p-13) +
            z2 * (0x1.71de3a53cec30p-19 - z * 0x1.ae64534065166p-26)) +
           (z2 * z2) * (0x1.6120f14472d03p-33 - z * 0x1.aacf524e3b30fp-41);
  }
  template <typename Numbers>
  static Numbers cosine(const Numbers& z, const Numbers& z2) {
    return ((0x1.555555555554cp-5 - z * 0x1.6c16c16c15142p-10) +
            z2 * (0x1.a01a019cab9e0p-16 - z * 0x1.27e4f80553406p-22)) +
           (z2 * z2) * (0x1.1ee9e8a6f8075p-29 - z * 0x1.8facdd4478d3bp-37);
  }
};

/// Errors below 2^-26 and 2^-33.
template <>
struct AngleSeries<float> {
  static constexpr float kHalfPi1 = 0x1.921f8p+0F;  // 18 bits, as the next
  static constexpr float kHalfPi2 = 0x1.aa22p-19F;
  static constexpr float kHalfPi3 = 0x1.68c234p-39F;
  static constexpr float kToInteger = 0x1.8p+23F;

  template <typename Numbers>
  static Numbers sine(const Numbers& z, const Numbers& /*z2*/) {
    return 0x1.110c04p-7F - z * 0x1.9a92b0p-13F;
  }
  template <typename Numbers>
  static Numbers cosine(const Numbers& z, const Numbers& z2) {
    return (0x1.55554ap-5F - z * 0x1.6c0c82p-10F) + z2 * 0x1.99ff54p-16F;
  }
};

/// Sine and cosine, valid in the lanes with |x| <= kLargestPackedAngle, and NaN where x is.
template <typename Number>
struct NearSineCosine {
  Number sine;
  Number cosine;
};

/// Reduces the angle, keeping r as the sum of two numbers for cancellation; sums the series; and turns by the
/// quadrant of n.
template <typename Scalar, int Lanes>
[[nodiscard]] inline NearSineCosine<Packed<Scalar, Lanes>> near_sin_cos(const Packed<Scalar, Lanes>& x) {
  using Number = Packed<Scalar, Lanes>;
  using Numbers = typename Number::Numbers;
  using Bits = typename Number::Bits;
  using Integer = typename Number::Integer;
  using Series = AngleSeries<Scalar>;
  constexpr auto kTwoOverPi = static_cast<Scalar>(0x1.45f306dc9c883p-1);
  constexpr auto kSixth = static_cast<Scalar>(1.0 / 6);
  constexpr auto kHalf = static_cast<Scalar>(0.5);
  constexpr auto kOne = static_cast<Scalar>(1.0);

  const Numbers& angle = x.numbers();
  const Numbers shifted = angle * kTwoOverPi + Series::kToInteger;
  const Numbers n = shifted - Series::kToInteger;
  const Numbers far = angle - n * Series::kHalfPi1;
  const Numbers middle = n * Series::kHalfPi2;
  const Numbers near = far - middle;
  const Numbers rest = n * Series::kHalfPi3 - ((far - near) - middle);
  const Numbers r = near - rest;
  const Numbers low = (near - r) - rest;

  const Numbers z = r * r;
  const Numbers z2 = z * z;
  const Numbers cube = z * r;
  // cos r low more for r + low.
  const Numbers sine = r - ((z * (kHalf * low - cube * Series::sine(z, z2)) - low) + cube * kSixth);
  // -r low more; the rounding of 1 - z/2 is kept.
  const Numbers half = kHalf * z;
  const Numbers one_less_half = kOne - half;
  const Numbers cosine =
      one_less_half + (((kOne - one_less_half) - half) + (z2 * Series::cosine(z, z2) - r * low));

  // Turned by n quarters: odd ones exchange the two, and the signs are those of the quadrant.
  constexpr Integer kSign = std::numeric_limits<Integer>::min();
  constexpr int kToSign = 8 * sizeof(Scalar) - 2;
  const Bits quadrant = std::bit_cast<Bits>(shifted);
  const Bits odd = -(quadrant & Integer{1});
  const Bits above = quadrant << kToSign;
  const Number first = select(odd, Number(cosine), Number(sine));
  const Number second = select(odd, Number(sine), Number(cosine));
  return {Number(std::bit_cast<Numbers>(std::bit_cast<Bits>(first.numbers()) ^ (above & kSign))),
          Number(std::bit_cast<Numbers>(std::bit_cast<Bits>(second.numbers()) ^
                                        ((above + (Integer{1} << kToSign)) & kSign)))};
}

/// |x| in every lane.
template <typename Scalar, int Lanes>
[[nodiscard]] inline typename Packed<Scalar, Lanes>::Numbers magnitude(const Packed<Scalar, Lanes>& x) {
  using Number = Packed<Scalar, Lanes>;
  constexpr auto kAllButSign = std::numeric_limits<typename Number::Integer>::max();
  return std::bit_cast<typename Number::Numbers>(std::bit_cast<typename Number::Bits>(x.numbers()) &
                                                 kAllButSign);
}

/// Lanes in which near_sin_cos is invalid.
template <typename Scalar, int Lanes>
[[nodiscard]] inline typename Packed<Scalar, Lanes>::Bits is_far(const Packed<Scalar, Lanes>& x) {
  return magnitude(x) > static_cast<Scalar>(kLargestPackedAngle);
}

}  // namespace detail

/// (sin x, cos x) in every lane, rad. Those of large angles are the C library's, one by one, so that no lane
/// depends on its neighbours.
template <typename Scalar, int Lanes>
[[nodiscard]] inline std::pair<Packed<Scalar, Lanes>, Packed<Scalar, Lanes>> sin_cos(
    const Packed<Scalar, Lanes>& x) {
  using Number = Packed<Scalar, Lanes>;
  const detail::NearSineCosine<Number> near = detail::near_sin_cos(x);
  const typename Number::Bits far = detail::is_far(x);
  if (!detail::any(far)) {
    return {near.sine, near.cosine};
  }
  return {Number::of([&](int i) { return far[i] != 0 ? std::sin(x.lane(i)) : near.sine.lane(i); }),
          Number::of([&](int i) { return far[i] != 0 ? std::cos(x.lane(i)) : near.cosine.lane(i); })};
}

}  // namespace veritrack::trackers

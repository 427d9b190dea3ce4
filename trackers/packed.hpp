// Several numbers side by side, as the scalar of a tracker: its step is then one of as many trackers.
//
// Every operation is that of double in each lane, rounded to nearest, so a lane has the bits of a tracker
// over double, with one exception: sine and cosine. They are within one unit in the last place, as
// docs/rounding.md asks (a test compares them with MPFR), and so are those of a C library, but the two may
// choose different neighbours. Compile with -ffp-contract=off, so that each set of instructions gives the
// same bits.
#pragma once

#include <immintrin.h>

#include <bit>
#include <cmath>
#include <utility>

namespace veritrack::trackers {

namespace detail {
template <int Lanes>
struct Registers;
template <>
struct Registers<2> {
  typedef double Numbers __attribute__((vector_size(16)));  // NOLINT: an alias has no such attribute
  typedef long long Bits __attribute__((vector_size(16)));  // NOLINT
};
template <>
struct Registers<4> {
  typedef double Numbers __attribute__((vector_size(32)));  // NOLINT
  typedef long long Bits __attribute__((vector_size(32)));  // NOLINT
};
template <>
struct Registers<8> {
  typedef double Numbers __attribute__((vector_size(64)));  // NOLINT
  typedef long long Bits __attribute__((vector_size(64)));  // NOLINT
};
}  // namespace detail

/// `Lanes` doubles: 2, 4 or 8, as many as a register of the unit's set of instructions holds.
template <int Lanes>
class Packed {
 public:
  using Numbers = typename detail::Registers<Lanes>::Numbers;
  using Bits = typename detail::Registers<Lanes>::Bits;
  static constexpr int kLanes = Lanes;

  /// Must be assigned before use.
  Packed() = default;
  explicit Packed(double all) : numbers_(all - Numbers{}) {}
  explicit Packed(const Numbers& numbers) : numbers_(numbers) {}

  /// Lane i is number(i).
  template <typename Function>
  [[nodiscard]] static Packed of(const Function& number) {
    return of(number, std::make_integer_sequence<int, Lanes>());
  }

  [[nodiscard]] const Numbers& numbers() const { return numbers_; }
  [[nodiscard]] double lane(int i) const { return numbers_[i]; }

  Packed operator-() const { return Packed(-numbers_); }
  friend Packed operator+(const Packed& a, const Packed& b) { return Packed(a.numbers_ + b.numbers_); }
  friend Packed operator-(const Packed& a, const Packed& b) { return Packed(a.numbers_ - b.numbers_); }
  friend Packed operator*(const Packed& a, const Packed& b) { return Packed(a.numbers_ * b.numbers_); }
  friend Packed operator/(const Packed& a, const Packed& b) { return Packed(a.numbers_ / b.numbers_); }

  friend Packed sqrt(const Packed& x) {
    return of([&](int i) { return std::sqrt(x.numbers_[i]); });
  }

  /// Lanes in which x is NaN, all bits set.
  friend Bits is_nan(const Packed& x) { return x.numbers_ != x.numbers_; }
  /// a where the bits are set, b elsewhere.
  friend Packed select(const Bits& where, const Packed& a, const Packed& b) {
    return Packed(std::bit_cast<Numbers>((std::bit_cast<Bits>(a.numbers_) & where) |
                                         (std::bit_cast<Bits>(b.numbers_) & ~where)));
  }

 private:
  template <typename Function, int... kIndices>
  static Packed of(const Function& number, std::integer_sequence<int, kIndices...>) {
    return Packed(Numbers{number(kIndices)...});
  }
  Numbers numbers_;
};

namespace detail {

/// True when a lane has its highest bit set.
template <typename Bits>
[[nodiscard]] inline bool any(const Bits& bits) {
#if defined(__AVX512F__)
  if constexpr (sizeof(Bits) == sizeof(__m512i)) {
    return _mm512_cmplt_epi64_mask(reinterpret_cast<const __m512i&>(bits), _mm512_setzero_si512()) != 0;
  }
#endif
#if defined(__AVX__)
  if constexpr (sizeof(Bits) == sizeof(__m256d)) {
    return _mm256_movemask_pd(reinterpret_cast<const __m256d&>(bits)) != 0;
  }
#endif
  if constexpr (sizeof(Bits) == sizeof(__m128d)) {
    return _mm_movemask_pd(reinterpret_cast<const __m128d&>(bits)) != 0;
  }
  bool found = false;
  for (std::size_t i = 0; i < sizeof(Bits) / sizeof(double); ++i) {
    found = found || bits[i] < 0;
  }
  return found;
}

/// The largest |x| whose sine and cosine are computed side by side.
inline constexpr double kLargestPackedAngle = 64.0;

}  // namespace detail

/// (sin x, cos x) in every lane, rad.
///
/// x = n pi/2 + r, |r| <= pi/4 and a little, pi/2 in three parts of which the first two have 33 bits, so that
/// their products with n are exact; r is kept as the sum of two doubles, for cancellation. Then the Taylor
/// series, whose remainders are below 2^-63 for such r, and the quadrant of n.
template <int Lanes>
[[nodiscard]] inline std::pair<Packed<Lanes>, Packed<Lanes>> sin_cos(const Packed<Lanes>& x) {
  using Number = Packed<Lanes>;
  using Numbers = typename Number::Numbers;
  using Bits = typename Number::Bits;
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kHalfPi1 = 0x1.921fb544p+0;
  constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
  constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
  constexpr double kToInteger = 0x1.8p+52;  // adding it leaves the nearest integer in the lowest bits

  const Numbers& angle = x.numbers();
  const Numbers shifted = angle * kTwoOverPi + kToInteger;
  const Bits quadrant = std::bit_cast<Bits>(shifted);
  const Numbers n = shifted - kToInteger;
  const Numbers far = angle - n * kHalfPi1;
  const Numbers middle = n * kHalfPi2;
  const Numbers near = far - middle;
  const Numbers rest = n * kHalfPi3 - ((far - near) - middle);
  const Numbers r = near - rest;
  const Numbers low = (near - r) - rest;

  const Numbers z = r * r;
  const Numbers z2 = z * z;
  const Numbers z4 = z2 * z2;
  // sin r = r + r^3 (-1/3! + z S(z)), and cos r low more for r + low.
  const Numbers s = ((1.0 / 120 - z * (1.0 / 5040)) + z2 * (1.0 / 362880 - z * (1.0 / 39916800))) +
                    z4 * (1.0 / 6227020800.0 - z * (1.0 / 1307674368000.0) + z2 * (1.0 / 355687428096000.0));
  const Numbers cube = z * r;
  const Numbers sine = r - ((z * (0.5 * low - cube * s) - low) + cube * (1.0 / 6));
  // cos r = 1 - z/2 + z^2 C(z), and -r low more; the rounding of 1 - z/2 is kept.
  const Numbers c = ((1.0 / 24 - z * (1.0 / 720)) + z2 * (1.0 / 40320 - z * (1.0 / 3628800))) +
                    z4 * ((1.0 / 479001600.0 - z * (1.0 / 87178291200.0)) + z2 * (1.0 / 20922789888000.0));
  const Numbers half = 0.5 * z;
  const Numbers one_less_half = 1.0 - half;
  const Numbers cosine = one_less_half + (((1.0 - one_less_half) - half) + (z2 * c - r * low));

  // Turned by n quarters: odd ones exchange the two, and the signs are those of the quadrant.
  const Bits odd = -(quadrant & 1LL);
  const Bits sine_sign = (quadrant & 2LL) << 62;
  const Bits cosine_sign = ((quadrant + 1LL) & 2LL) << 62;
  const Number first = select(odd, Number(cosine), Number(sine));
  const Number second = select(odd, Number(sine), Number(cosine));
  const std::pair<Number, Number> found{
      Number(std::bit_cast<Numbers>(std::bit_cast<Bits>(first.numbers()) ^ sine_sign)),
      Number(std::bit_cast<Numbers>(std::bit_cast<Bits>(second.numbers()) ^ cosine_sign))};

  // Large angles, and NaN: lane by lane, so that no lane depends on its neighbours.
  const Bits magnitude = std::bit_cast<Bits>(angle) & 0x7fffffffffffffffLL;
  const Bits outside = ~(std::bit_cast<Numbers>(magnitude) <= detail::kLargestPackedAngle);
  if (!detail::any(outside)) {
    return found;
  }
  return {Number::of([&](int i) { return outside[i] != 0 ? std::sin(x.lane(i)) : found.first.lane(i); }),
          Number::of([&](int i) { return outside[i] != 0 ? std::cos(x.lane(i)) : found.second.lane(i); })};
}

}  // namespace veritrack::trackers

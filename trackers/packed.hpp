// Several numbers side by side, as the scalar of a tracker: its step is then one of as many trackers.
//
// Every operation is that of double or float in each lane, rounded to nearest, so a lane has the bits of a
// tracker over that scalar, with one exception: sine and cosine (packed_sine_cosine.hpp). Compile with
// -ffp-contract=off, so that each set of instructions gives the same bits.
#pragma once

#include <immintrin.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace veritrack::trackers {

/// `Lanes` doubles or floats, as many as a register of the unit's set of instructions holds: 16, 32 or 64
/// bytes.
template <typename Scalar, int Lanes>
class Packed {
 public:
  /// An integer with as many bits as a number.
  using Integer = std::conditional_t<sizeof(Scalar) == sizeof(float), std::int32_t, std::int64_t>;
  typedef Scalar Numbers __attribute__((vector_size(Lanes * sizeof(Scalar))));  // NOLINT: no alias can
  typedef Integer Bits __attribute__((vector_size(Lanes * sizeof(Scalar))));    // NOLINT
  static constexpr int kLanes = Lanes;

  /// Must be assigned before use.
  Packed() = default;
  explicit Packed(Scalar all) : numbers_(all - Numbers{}) {}
  explicit Packed(const Numbers& numbers) : numbers_(numbers) {}

  /// Lane i is number(i).
  template <typename Function>
  [[nodiscard]] static Packed of(const Function& number) {
    return of(number, std::make_integer_sequence<int, Lanes>());
  }

  [[nodiscard]] const Numbers& numbers() const { return numbers_; }
  [[nodiscard]] Scalar lane(int i) const { return numbers_[i]; }

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

/// True when a lane has its bits set, all of which are equal.
template <typename Bits>
[[nodiscard]] inline bool any(const Bits& bits) {
#if defined(__AVX512F__)
  if constexpr (sizeof(Bits) == sizeof(__m512i)) {
    const auto all = std::bit_cast<__m512i>(bits);
    return _mm512_test_epi32_mask(all, all) != 0;
  }
#endif
#if defined(__AVX2__)
  if constexpr (sizeof(Bits) == sizeof(__m256i)) {
    return _mm256_movemask_epi8(std::bit_cast<__m256i>(bits)) != 0;
  }
#endif
  if constexpr (sizeof(Bits) == sizeof(__m128i)) {
    return _mm_movemask_epi8(std::bit_cast<__m128i>(bits)) != 0;
  }
  bool found = false;
  for (std::size_t i = 0; i < sizeof(Bits) / sizeof(bits[0]); ++i) {
    found = found || bits[i] != 0;
  }
  return found;
}

}  // namespace detail

}  // namespace veritrack::trackers

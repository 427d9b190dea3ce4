// Registers of two, four or eight doubles, and the instructions of each width under the same names: what
// interval_lanes.hpp is written with.
//
// Results go through `opaque`, for the reasons that rounding.hpp has. A width is there where the unit is
// compiled for its set of instructions: SSE2, AVX2, AVX-512.
#pragma once

#include <cstddef>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor {

// Everything is always inlined: an out-of-line function could also serve units for other sets of
// instructions.
#define VERITRACK_INLINED [[nodiscard, gnu::always_inline]] static inline  // NOLINT: an attribute

template <int Lanes>
struct Registers;

template <>
struct Registers<2> {
  using Numbers = __m128d;
  using Mask = __m128d;  ///< all bits of a lane, or none

  VERITRACK_INLINED Numbers all(double x) noexcept { return _mm_set1_pd(x); }
  VERITRACK_INLINED Numbers load(const double* x) noexcept { return _mm_loadu_pd(x); }
  VERITRACK_INLINED Numbers opaque(Numbers x) noexcept { return detail::opaque(x); }
  VERITRACK_INLINED Numbers negative(Numbers x) noexcept { return _mm_xor_pd(x, _mm_set1_pd(-0.0)); }
  VERITRACK_INLINED Numbers absolute(Numbers x) noexcept { return _mm_andnot_pd(_mm_set1_pd(-0.0), x); }
  VERITRACK_INLINED Numbers max(Numbers a, Numbers b) noexcept { return _mm_max_pd(a, b); }
  VERITRACK_INLINED Numbers min(Numbers a, Numbers b) noexcept { return _mm_min_pd(a, b); }
  VERITRACK_INLINED Numbers sqrt(Numbers x) noexcept { return opaque(_mm_sqrt_pd(opaque(x))); }
  VERITRACK_INLINED Numbers predecessor(Numbers x) noexcept {
    return _mm_castsi128_pd(_mm_sub_epi64(_mm_castpd_si128(x), _mm_set1_epi64x(1)));
  }
  /// Towards zero, for |x| < 2^31.
  VERITRACK_INLINED Numbers truncated(Numbers x) noexcept {
    return _mm_cvtepi32_pd(_mm_cvttpd_epi32(opaque(x)));
  }
  VERITRACK_INLINED Mask less(Numbers a, Numbers b) noexcept { return _mm_cmplt_pd(a, b); }
  VERITRACK_INLINED Mask less_equal(Numbers a, Numbers b) noexcept { return _mm_cmple_pd(a, b); }
  VERITRACK_INLINED Mask equal(Numbers a, Numbers b) noexcept { return _mm_cmpeq_pd(a, b); }
  VERITRACK_INLINED Mask unordered(Numbers a, Numbers b) noexcept { return _mm_cmpunord_pd(a, b); }
  VERITRACK_INLINED Mask both(Mask a, Mask b) noexcept { return _mm_and_pd(a, b); }
  VERITRACK_INLINED Mask either(Mask a, Mask b) noexcept { return _mm_or_pd(a, b); }
  VERITRACK_INLINED Mask without(Mask a, Mask b) noexcept { return _mm_andnot_pd(b, a); }
  VERITRACK_INLINED bool any(Mask mask) noexcept { return _mm_movemask_pd(mask) != 0; }
  VERITRACK_INLINED unsigned bits(Mask mask) noexcept { return static_cast<unsigned>(_mm_movemask_pd(mask)); }
  VERITRACK_INLINED Numbers select(Mask where, Numbers a, Numbers b) noexcept {
    return _mm_or_pd(_mm_and_pd(where, a), _mm_andnot_pd(where, b));
  }
  [[gnu::always_inline]] static inline void store(double* to, Numbers x) noexcept { _mm_storeu_pd(to, x); }
};

#if defined(__AVX2__)
template <>
struct Registers<4> {
  using Numbers = __m256d;
  using Mask = __m256d;

  VERITRACK_INLINED Numbers all(double x) noexcept { return _mm256_set1_pd(x); }
  VERITRACK_INLINED Numbers load(const double* x) noexcept { return _mm256_loadu_pd(x); }
  VERITRACK_INLINED Numbers opaque(Numbers x) noexcept {
    asm volatile("" : "+x"(x));
    return x;
  }
  VERITRACK_INLINED Numbers negative(Numbers x) noexcept { return _mm256_xor_pd(x, _mm256_set1_pd(-0.0)); }
  VERITRACK_INLINED Numbers absolute(Numbers x) noexcept { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x); }
  VERITRACK_INLINED Numbers max(Numbers a, Numbers b) noexcept { return _mm256_max_pd(a, b); }
  VERITRACK_INLINED Numbers min(Numbers a, Numbers b) noexcept { return _mm256_min_pd(a, b); }
  VERITRACK_INLINED Numbers sqrt(Numbers x) noexcept { return opaque(_mm256_sqrt_pd(opaque(x))); }
  VERITRACK_INLINED Numbers predecessor(Numbers x) noexcept {
    return _mm256_castsi256_pd(_mm256_sub_epi64(_mm256_castpd_si256(x), _mm256_set1_epi64x(1)));
  }
  VERITRACK_INLINED Numbers truncated(Numbers x) noexcept {
    return _mm256_cvtepi32_pd(_mm256_cvttpd_epi32(opaque(x)));
  }
  VERITRACK_INLINED Mask less(Numbers a, Numbers b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LT_OS); }
  VERITRACK_INLINED Mask less_equal(Numbers a, Numbers b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LE_OS); }
  VERITRACK_INLINED Mask equal(Numbers a, Numbers b) noexcept { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
  VERITRACK_INLINED Mask unordered(Numbers a, Numbers b) noexcept {
    return _mm256_cmp_pd(a, b, _CMP_UNORD_Q);
  }
  VERITRACK_INLINED Mask both(Mask a, Mask b) noexcept { return _mm256_and_pd(a, b); }
  VERITRACK_INLINED Mask either(Mask a, Mask b) noexcept { return _mm256_or_pd(a, b); }
  VERITRACK_INLINED Mask without(Mask a, Mask b) noexcept { return _mm256_andnot_pd(b, a); }
  VERITRACK_INLINED bool any(Mask mask) noexcept { return _mm256_movemask_pd(mask) != 0; }
  VERITRACK_INLINED unsigned bits(Mask mask) noexcept {
    return static_cast<unsigned>(_mm256_movemask_pd(mask));
  }
  VERITRACK_INLINED Numbers select(Mask where, Numbers a, Numbers b) noexcept {
    return _mm256_blendv_pd(b, a, where);
  }
  [[gnu::always_inline]] static inline void store(double* to, Numbers x) noexcept { _mm256_storeu_pd(to, x); }
};
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
template <>
struct Registers<8> {
  using Numbers = __m512d;
  using Mask = __mmask8;  ///< a bit for each lane
  /// Operations with a mask, since those without make g++ 12 warn of numbers that are not initialised.
  static constexpr Mask kAll = 0xff;

  VERITRACK_INLINED Numbers all(double x) noexcept { return _mm512_set1_pd(x); }
  VERITRACK_INLINED Numbers load(const double* x) noexcept { return _mm512_loadu_pd(x); }
  VERITRACK_INLINED Numbers opaque(Numbers x) noexcept {
    asm volatile("" : "+v"(x));
    return x;
  }
  VERITRACK_INLINED Numbers negative(Numbers x) noexcept { return _mm512_xor_pd(x, _mm512_set1_pd(-0.0)); }
  VERITRACK_INLINED Numbers absolute(Numbers x) noexcept { return _mm512_abs_pd(x); }
  VERITRACK_INLINED Numbers max(Numbers a, Numbers b) noexcept { return _mm512_mask_max_pd(a, kAll, a, b); }
  VERITRACK_INLINED Numbers min(Numbers a, Numbers b) noexcept { return _mm512_mask_min_pd(a, kAll, a, b); }
  VERITRACK_INLINED Numbers sqrt(Numbers x) noexcept {
    return opaque(_mm512_mask_sqrt_pd(x, kAll, opaque(x)));
  }
  VERITRACK_INLINED Numbers predecessor(Numbers x) noexcept {
    return _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_castpd_si512(x), _mm512_set1_epi64(1)));
  }
  VERITRACK_INLINED Numbers truncated(Numbers x) noexcept {
    return _mm512_maskz_cvtepi32_pd(kAll, _mm512_maskz_cvttpd_epi32(kAll, opaque(x)));
  }
  VERITRACK_INLINED Mask less(Numbers a, Numbers b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OS); }
  VERITRACK_INLINED Mask less_equal(Numbers a, Numbers b) noexcept {
    return _mm512_cmp_pd_mask(a, b, _CMP_LE_OS);
  }
  VERITRACK_INLINED Mask equal(Numbers a, Numbers b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  VERITRACK_INLINED Mask unordered(Numbers a, Numbers b) noexcept {
    return _mm512_cmp_pd_mask(a, b, _CMP_UNORD_Q);
  }
  VERITRACK_INLINED Mask both(Mask a, Mask b) noexcept { return static_cast<Mask>(a & b); }
  VERITRACK_INLINED Mask either(Mask a, Mask b) noexcept { return static_cast<Mask>(a | b); }
  VERITRACK_INLINED Mask without(Mask a, Mask b) noexcept { return static_cast<Mask>(a & ~b); }
  VERITRACK_INLINED bool any(Mask mask) noexcept { return mask != 0; }
  VERITRACK_INLINED unsigned bits(Mask mask) noexcept { return mask; }
  VERITRACK_INLINED Numbers select(Mask where, Numbers a, Numbers b) noexcept {
    return _mm512_mask_blend_pd(where, b, a);
  }
  [[gnu::always_inline]] static inline void store(double* to, Numbers x) noexcept { _mm512_storeu_pd(to, x); }
};
#endif

#undef VERITRACK_INLINED

/// A number in each lane, as the element of an array (the types of registers lose their attributes there).
template <int Lanes>
struct LaneNumbers {
  typename Registers<Lanes>::Numbers at;
};

}  // namespace veritrack::rigor

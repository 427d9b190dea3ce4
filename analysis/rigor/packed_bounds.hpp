// The two bounds of an interval in one register, and the operations on them without branches on signs.
//
// [a, b] is the pair (-a, b). Both are rounded upward, so that one addition is the sum of two intervals, and
// one of the two passes of a product serves both bounds (B. Lambov, Interval Arithmetic Using SSE-2, 2008).
// For a nonempty set neither number is NaN or -infinity; for the empty set both are NaN.
//
// Every operation takes its operands and gives its result through `opaque` (rounding.hpp).
#pragma once

#include <limits>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor::packed {

inline __m128d pack(double lower, double upper) noexcept {
  return _mm_set_pd(upper, -lower);
}
inline __m128d nothing() noexcept {
  return _mm_set1_pd(std::numeric_limits<double>::quiet_NaN());
}
inline double lower(__m128d x) noexcept {
  return -_mm_cvtsd_f64(x);
}
inline double upper(__m128d x) noexcept {
  return _mm_cvtsd_f64(_mm_unpackhi_pd(x, x));
}
/// -[a, b] = [-b, -a].
inline __m128d negated(__m128d x) noexcept {
  return _mm_shuffle_pd(x, x, 1);
}

inline __m128d sum(__m128d x, __m128d y) {
  rigor::detail::debug_require_upward();
  return rigor::detail::opaque(_mm_add_pd(rigor::detail::opaque(x), rigor::detail::opaque(y)));
}

namespace detail {

using rigor::detail::opaque;

/// The four products of an end of x and an end of y, each as a candidate for (-lower, upper).
struct Candidates {
  __m128d ad_bd, bc_ac, ac_bc, bd_ad;  // the first is -(a d), the second b d, and so on
};
inline Candidates candidates(__m128d x, __m128d y) {
  const __m128d sign = _mm_set1_pd(-0.0);
  const __m128d minus_c = _mm_unpacklo_pd(y, y);
  const __m128d d = _mm_unpackhi_pd(y, y);
  const __m128d turned = _mm_shuffle_pd(x, x, 1);  // (b, -a)
  return {_mm_mul_pd(x, d), _mm_mul_pd(turned, minus_c), _mm_mul_pd(_mm_xor_pd(x, sign), minus_c),
          _mm_mul_pd(_mm_xor_pd(turned, sign), d)};
}

/// True when one of the numbers is NaN.
inline bool any_unordered(__m128d x, __m128d y) noexcept {
  return _mm_movemask_pd(_mm_cmpunord_pd(x, y)) != 0;
}

/// The product of operands that are empty, or unbounded: there zero times infinity, which is NaN, represents
/// zero times large numbers, which is zero.
[[gnu::noinline, gnu::cold]] inline __m128d product_with_infinities(__m128d x, __m128d y) {
  if (any_unordered(x, y)) {
    return nothing();
  }
  const auto zero_for_nan = [](__m128d p) { return _mm_and_pd(p, _mm_cmpord_pd(p, p)); };
  const Candidates all = candidates(opaque(x), opaque(y));
  return opaque(_mm_max_pd(_mm_max_pd(zero_for_nan(all.ad_bd), zero_for_nan(all.bc_ac)),
                           _mm_max_pd(zero_for_nan(all.ac_bc), zero_for_nan(all.bd_ad))));
}

}  // namespace detail

/// The least and the largest of all four products of ends.
inline __m128d product(__m128d x, __m128d y) {
  rigor::detail::debug_require_upward();
  const detail::Candidates all = detail::candidates(detail::opaque(x), detail::opaque(y));
  // A maximum with NaN is its second operand. So a NaN among the other two loses nothing: it represents zero,
  // and among four products that are not all NaN one is then at least zero.
  if (detail::any_unordered(all.ad_bd, all.ac_bc)) [[unlikely]] {
    return detail::product_with_infinities(x, y);
  }
  return detail::opaque(_mm_max_pd(_mm_max_pd(all.bc_ac, all.ad_bd), _mm_max_pd(all.bd_ad, all.ac_bc)));
}

/// Empty when y contains zero.
inline __m128d quotient(__m128d x, __m128d y) {
  rigor::detail::debug_require_upward();
  const bool positive = lower(y) > 0.0;
  if (!positive) {
    const bool negative = upper(y) < 0.0;
    if (!negative) {
      return nothing();
    }
    x = negated(x);
    y = negated(y);
  }
  x = detail::opaque(x);
  y = detail::opaque(y);
  // A bound that is not negative is largest over the smallest divisor, a negative one over the largest.
  const __m128d smallest = _mm_xor_pd(_mm_unpacklo_pd(y, y), _mm_set1_pd(-0.0));
  const __m128d largest = _mm_unpackhi_pd(y, y);
  const __m128d not_negative = _mm_cmpge_pd(x, _mm_setzero_pd());
  const __m128d divisor = _mm_or_pd(_mm_and_pd(not_negative, smallest), _mm_andnot_pd(not_negative, largest));
  return detail::opaque(_mm_div_pd(x, divisor));
}

/// {t^2 : t in x}.
inline __m128d square(__m128d x) {
  rigor::detail::debug_require_upward();
  x = detail::opaque(x);
  const __m128d turned = negated(x);
  const __m128d sign = _mm_set1_pd(-0.0);
  // max(-a, b) is the largest |t|, and max(a, -b, 0) the smallest; of NaN both are NaN.
  const __m128d largest = _mm_max_pd(x, turned);
  const __m128d smallest = _mm_max_pd(_mm_setzero_pd(), _mm_xor_pd(_mm_min_pd(x, turned), sign));
  const __m128d ends = _mm_shuffle_pd(smallest, largest, 2);
  const __m128d minus_and_plus = _mm_xor_pd(ends, _mm_set_pd(0.0, -0.0));
  return detail::opaque(_mm_mul_pd(minus_and_plus, ends));
}

/// The smallest interval that contains both; empty when either is.
inline __m128d hull(__m128d x, __m128d y) noexcept {
  return _mm_or_pd(_mm_max_pd(x, y), _mm_cmpunord_pd(x, y));
}

}  // namespace veritrack::rigor::packed

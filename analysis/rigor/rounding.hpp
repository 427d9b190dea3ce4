// Directed rounding: the mode, the objects that set it, and the scalar operations that rely on it.
//
// The whole of analysis/ computes with the processor rounding towards +infinity. An UpwardRounding object
// sets the mode for a whole computation, not for each operation; lower bounds are computed by negation,
//     down(a + b) = -up(-a - b),
// which is exact because negation is.
//
// A compiler does not know that the rounding mode is an operand of every operation. Each operation below
// therefore passes its operands and its result through `opaque`, an empty assembly statement that the
// optimiser cannot look through: it can neither fold the operation, nor reuse a result from another mode, nor
// contract it into a fused multiply-add, nor move it across the instruction that changes the mode. This is
// true under every flag; the flags on the CMake target (-frounding-math -ffp-contract=off) are a second line
// of defence.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error \
    "veritrack: interval arithmetic is meaningless under -ffast-math or -ffinite-math-only; remove the flag"
#endif
#if defined(__GNUC__) && !defined(__clang__) && !defined(__ROUNDING_MATH__)
#error \
    "veritrack: compile with -frounding-math (link the CMake target veritrack_rigor, which carries the flag)"
#endif
#if !defined(__x86_64__) || !defined(__SSE2_MATH__)
#error \
    "veritrack: the rounding-mode guard is written for x86-64 with SSE2 arithmetic; port rounding.hpp first"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "veritrack: double operations must be evaluated in double"
#endif

#include <immintrin.h>

namespace veritrack::rigor {

/// Thrown where a result that depends on the rounding mode is used while the mode is not set: a programming
/// error.
class RoundingModeError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

namespace detail {

inline constexpr unsigned int kRoundingMask = 0x6000;  // MXCSR: rounding control
inline constexpr unsigned int kRoundUpward = 0x4000;   // MXCSR: towards +infinity
inline constexpr unsigned int kFlushMask = 0x8040;     // MXCSR: flush-to-zero and denormals-are-zero
inline constexpr unsigned int kExceptionFlags =
    0x003F;  // MXCSR: sticky flags, which must survive a mode change

[[noreturn]] void throw_rounding_mode_error();

/// The control register, read so that the compiler cannot move the read.
inline unsigned int read_control() noexcept {
  unsigned int control = 0;
  asm volatile("stmxcsr %0" : "=m"(control) : : "memory");
  return control;
}

inline void write_control(unsigned int control) noexcept {
  asm volatile("ldmxcsr %0" : : "m"(control) : "memory");
}

/// The same value, made opaque to the optimiser at this point of the program.
inline double opaque(double value) noexcept {
  asm volatile("" : "+x"(value));
  return value;
}
inline __m128d opaque(__m128d values) noexcept {
  asm volatile("" : "+x"(values));
  return values;
}

}  // namespace detail

/// True when this thread rounds towards +infinity and neither flushes nor ignores denormal numbers.
[[nodiscard]] inline bool rounding_is_upward() noexcept {
  return (detail::read_control() & (detail::kRoundingMask | detail::kFlushMask)) == detail::kRoundUpward;
}

/// Throws RoundingModeError unless this thread's arithmetic is fit for interval results.
inline void require_upward_rounding() {
  if (!rounding_is_upward()) [[unlikely]] {
    detail::throw_rounding_mode_error();
  }
}

/// Sets a rounding mode for this thread from construction to destruction, then restores the previous one.
/// Clears flush-to-zero and denormals-are-zero during its lifetime. May be nested. Threads started inside do
/// not reliably inherit the mode: every task makes its own object.
template <unsigned int Mode>
class HeldRounding {
 public:
  HeldRounding() noexcept : previous_(detail::read_control()) {
    detail::write_control((previous_ & ~(detail::kRoundingMask | detail::kFlushMask)) | Mode);
  }
  ~HeldRounding() {
    const unsigned int flags = detail::read_control() & detail::kExceptionFlags;
    detail::write_control(previous_ | flags);
  }
  HeldRounding(const HeldRounding&) = delete;
  HeldRounding& operator=(const HeldRounding&) = delete;
  HeldRounding(HeldRounding&&) = delete;
  HeldRounding& operator=(HeldRounding&&) = delete;

 private:
  unsigned int previous_;
};

/// For interval computations.
using UpwardRounding = HeldRounding<detail::kRoundUpward>;
/// For floating-point proposals and simulations inside an interval computation: the mode that the filter
/// itself runs in.
using NearestRounding = HeldRounding<0>;

// The operations. All require the upward mode; builds without NDEBUG check it in each of them.

namespace detail {
inline void debug_require_upward() {
#ifndef NDEBUG
  require_upward_rounding();
#endif
}
}  // namespace detail

inline double add_up(double a, double b) {
  detail::debug_require_upward();
  return detail::opaque(detail::opaque(a) + detail::opaque(b));
}
inline double add_down(double a, double b) {
  detail::debug_require_upward();
  return -detail::opaque(detail::opaque(-a) - detail::opaque(b));
}
inline double sub_up(double a, double b) {
  return add_up(a, -b);
}
inline double sub_down(double a, double b) {
  return add_down(a, -b);
}
inline double mul_up(double a, double b) {
  detail::debug_require_upward();
  return detail::opaque(detail::opaque(a) * detail::opaque(b));
}
inline double mul_down(double a, double b) {
  detail::debug_require_upward();
  return -detail::opaque(detail::opaque(-a) * detail::opaque(b));
}
inline double div_up(double a, double b) {
  detail::debug_require_upward();
  return detail::opaque(detail::opaque(a) / detail::opaque(b));
}
inline double div_down(double a, double b) {
  detail::debug_require_upward();
  return -detail::opaque(detail::opaque(-a) / detail::opaque(b));
}
inline double sqrt_up(double a) {
  detail::debug_require_upward();
  return detail::opaque(std::sqrt(detail::opaque(a)));
}
/// The upward root s satisfies s^2 >= a; it is exact if and only if s^2 rounded up is a itself, and otherwise
/// the true root lies strictly between s and its predecessor.
inline double sqrt_down(double a) {
  const double up = sqrt_up(a);
  const bool exact = mul_up(up, up) == a;
  return exact ? up : std::bit_cast<double>(std::bit_cast<std::uint64_t>(up) - 1);
}

}  // namespace veritrack::rigor

#include "analysis/rigor/mpfr_reference.hpp"

#include <mpfr.h>

namespace veritrack::rigor::detail {

namespace {

constexpr int kDoublePrecision = 53;

/// MPFR keeps constants such as pi in a cache for each thread; this frees it when the thread ends.
struct ThreadCache {
  ThreadCache() = default;
  ~ThreadCache() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  ThreadCache(const ThreadCache&) = delete;
  ThreadCache& operator=(const ThreadCache&) = delete;
  ThreadCache(ThreadCache&&) = delete;
  ThreadCache& operator=(ThreadCache&&) = delete;
  void use() const {}
};
thread_local const ThreadCache thread_cache;

/// `operation(result, rounding)` computes a correctly rounded result of 53 bits with MPFR's own, practically
/// unbounded, exponent. Where that is below or above the normal range of double, mpfr_get_d rounds a second
/// time, in the same direction onto a coarser grid, which is the same as rounding once. MPFR computes with
/// integers; the nearest mode is set for the few floating-point instructions of its conversions.
template <typename Operation>
double rounded(Direction direction, Operation operation) {
  const NearestRounding mode;
  thread_cache.use();
  MPFR_DECL_INIT(result, kDoublePrecision);
  const mpfr_rnd_t rounding = direction == Direction::down ? MPFR_RNDD : MPFR_RNDU;
  operation(result, rounding);
  return mpfr_get_d(result, rounding);
}

using UnaryFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

double unary(UnaryFunction function, double x, Direction direction) {
  return rounded(direction, [&](mpfr_ptr result, mpfr_rnd_t rounding) {
    MPFR_DECL_INIT(argument, kDoublePrecision);
    mpfr_set_d(argument, x, MPFR_RNDN);  // exact
    function(result, argument, rounding);
  });
}

}  // namespace

double reference_sin(double x, Direction direction) {
  return unary(mpfr_sin, x, direction);
}
double reference_cos(double x, Direction direction) {
  return unary(mpfr_cos, x, direction);
}
double reference_tan(double x, Direction direction) {
  return unary(mpfr_tan, x, direction);
}
double reference_atan(double x, Direction direction) {
  return unary(mpfr_atan, x, direction);
}
double reference_exp(double x, Direction direction) {
  return unary(mpfr_exp, x, direction);
}
double reference_log(double x, Direction direction) {
  return unary(mpfr_log, x, direction);
}

double reference_atan2(double y, double x, Direction direction) {
  return rounded(direction, [&](mpfr_ptr result, mpfr_rnd_t rounding) {
    MPFR_DECL_INIT(ordinate, kDoublePrecision);
    MPFR_DECL_INIT(abscissa, kDoublePrecision);
    mpfr_set_d(ordinate, y, MPFR_RNDN);  // exact
    mpfr_set_d(abscissa, x, MPFR_RNDN);  // exact
    mpfr_atan2(result, ordinate, abscissa, rounding);
  });
}

}  // namespace veritrack::rigor::detail

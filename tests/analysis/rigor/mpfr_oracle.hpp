// A real number known exactly enough to decide every comparison with a double: MPFR rounds it to nearest at a
// precision above that of double and says on which side of the true value it came out.
#pragma once

#include <mpfr.h>

#include <cmath>
#include <limits>

#include "analysis/rigor/interval.hpp"

namespace veritrack::test {

class Oracle {
 public:
  explicit Oracle(mpfr_prec_t precision = 256) { mpfr_init2(value_, precision); }
  ~Oracle() { mpfr_clear(value_); }
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;
  Oracle(Oracle&&) = delete;
  Oracle& operator=(Oracle&&) = delete;

  Oracle& operator=(double value) {
    ternary_ = mpfr_set_d(value_, value, MPFR_RNDN);
    return *this;
  }

  /// `function(result, operands..., rounding)` is one of MPFR's, applied to exact operands.
  template <typename Function, typename... Operands>
  void evaluate(Function function, Operands... operands) {
    ternary_ = function(value_, operands..., MPFR_RNDN);
  }

  [[nodiscard]] mpfr_srcptr value() const { return value_; }

  [[nodiscard]] bool is_at_least(double bound) const {
    const int order = compare(bound);
    return order > 0 || (order == 0 && ternary_ <= 0);
  }
  [[nodiscard]] bool is_at_most(double bound) const {
    const int order = compare(bound);
    return order < 0 || (order == 0 && ternary_ >= 0);
  }
  [[nodiscard]] bool is_exactly(double bound) const { return is_at_least(bound) && is_at_most(bound); }

  /// Is the real number certain to lie in x? False for an empty x and for a NaN.
  [[nodiscard]] bool lies_in(const rigor::Interval& x) const {
    const bool ordered = x.lower() <= x.upper();
    return ordered && mpfr_nan_p(value_) == 0 && is_at_least(x.lower()) && is_at_most(x.upper());
  }

  /// The largest double that is not above the real number.
  [[nodiscard]] double rounded_down() const {
    const double candidate = mpfr_get_d(value_, MPFR_RNDD);
    return is_at_least(candidate) ? candidate
                                  : std::nextafter(candidate, -std::numeric_limits<double>::infinity());
  }
  /// The smallest double that is not below the real number.
  [[nodiscard]] double rounded_up() const {
    const double candidate = mpfr_get_d(value_, MPFR_RNDU);
    return is_at_most(candidate) ? candidate
                                 : std::nextafter(candidate, std::numeric_limits<double>::infinity());
  }
  [[nodiscard]] double nearest() const { return mpfr_get_d(value_, MPFR_RNDN); }

 private:
  [[nodiscard]] int compare(double bound) const { return mpfr_cmp_d(value_, bound); }

  mpfr_t value_{};
  int ternary_ = 0;
};

}  // namespace veritrack::test

// The bound that distinguishes the lock of a set from every other one that the formulas imply.
#pragma once

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::sets {

/// Whether frequency errors up to that bound, rad/sample, are certainly below 3.14: the frequency acts
/// through its sine and cosine, so that the next lock is 2 pi off. True only when certain, as the next one.
[[nodiscard]] inline bool excludes_other_locks(const rigor::Interval& frequency_error) {
  constexpr double kBelow = 3.125;
  return rigor::certainly_less(frequency_error, rigor::Interval(kBelow));
}

/// Likewise where one channel is seen, which shows a tone of the frequency w as one of -w or 2 pi - w:
/// whether the errors are below the distance of the band from 0 and from pi, rounded down to three digits.
/// Needs the upward mode.
[[nodiscard]] inline bool excludes_other_locks(const rigor::Interval& frequency_error,
                                               const rigor::Interval& band) {
  constexpr double kRounded = 0.99;  // three digits are at least that of a number
  const rigor::Interval low(band.lower());
  const rigor::Interval high(band.upper());
  return rigor::certainly_less(frequency_error, rigor::Interval(kRounded) * low) &&
         rigor::certainly_less(frequency_error, rigor::Interval(kRounded) * (rigor::pi() - high));
}

}  // namespace veritrack::sets

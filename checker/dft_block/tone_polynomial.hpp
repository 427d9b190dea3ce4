// The sums over the bins of a block of a tone and an estimate of it, as polynomials in the distances of both
// offsets from a middle: the checker's own derivation, from the differential equation of sinc.
#pragma once

#include <array>
#include <cstddef>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// Sums over m = -L ... L of products of s_m(x) = (-1)^m sinc(m + x), at the estimate x and the true offset
/// d.
struct MeetingSums {
  Ball aa;  ///< s(x) s(x)
  Ball ab;  ///< s(x) s'(x)
  Ball bb;  ///< s'(x) s'(x)
  Ball at;  ///< s(x) s(d)
  Ball bt;  ///< s'(x) s(d)
  Ball ac;  ///< s(x) (s(x) - s(d))/(x - d)
  Ball bc;  ///< s'(x) (s(x) - s(d))/(x - d)
};

/// The sums for all offsets near a middle.
class TonePolynomial {
 public:
  TonePolynomial(const Ball& middle, int half_width);

  /// For x = middle + `estimate`, d = middle + `truth`. Balls of everything beyond half a bin.
  [[nodiscard]] MeetingSums at(const Ball& estimate, const Ball& truth) const;

 private:
  static constexpr std::size_t kTerms = 16;
  /// The coefficient of x^i d^k in the sum over m of s(x) s(d).
  std::array<std::array<Ball, kTerms>, kTerms> products_;
  /// The sums in which both are x, by powers of x.
  std::array<Ball, kTerms> aa_, ab_, bb_;
  Ball rest_;  ///< the remainder of any sum is at most this times reach^(kTerms - 2)
};

}  // namespace veritrack::checker

// The operations of packed_bounds.hpp by Boost.Interval, which distinguishes the signs of all ends: the same
// bounds to the bit, slower. A build with VERITRACK_INTERVALS=boost has them behind Interval.
#pragma once

#include <boost/numeric/interval/arith.hpp>
#include <boost/numeric/interval/arith2.hpp>
#include <boost/numeric/interval/checking.hpp>
#include <boost/numeric/interval/interval.hpp>
#include <boost/numeric/interval/policies.hpp>
#include <boost/numeric/interval/utility.hpp>

#include "analysis/rigor/packed_bounds.hpp"

namespace veritrack::rigor::boosted {

/// Boost's rounding policy over the scalar operations: the caller holds the mode.
struct HeldUpwardPolicy {
  using unprotected_rounding = HeldUpwardPolicy;
  static double conv_down(double x) { return x; }
  static double conv_up(double x) { return x; }
  static double add_down(double x, double y) { return rigor::add_down(x, y); }
  static double add_up(double x, double y) { return rigor::add_up(x, y); }
  static double sub_down(double x, double y) { return rigor::sub_down(x, y); }
  static double sub_up(double x, double y) { return rigor::sub_up(x, y); }
  static double mul_down(double x, double y) { return rigor::mul_down(x, y); }
  static double mul_up(double x, double y) { return rigor::mul_up(x, y); }
  static double div_down(double x, double y) { return rigor::div_down(x, y); }
  static double div_up(double x, double y) { return rigor::div_up(x, y); }
  static double sqrt_down(double x) { return rigor::sqrt_down(x); }
  static double sqrt_up(double x) { return rigor::sqrt_up(x); }
};
using Bounds = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<HeldUpwardPolicy,
                                                   boost::numeric::interval_lib::checking_base<double>>>;

inline Bounds unpacked(__m128d x) {
  return {packed::lower(x), packed::upper(x), true};
}
/// The empty set where Boost has bounds that are no numbers, or the wrong way round.
inline __m128d packed_again(const Bounds& x) {
  const bool is_set = x.lower() <= x.upper();
  return is_set ? packed::pack(x.lower(), x.upper()) : packed::nothing();
}

inline __m128d sum(__m128d x, __m128d y) {
  return packed_again(unpacked(x) + unpacked(y));
}
inline __m128d product(__m128d x, __m128d y) {
  return packed_again(unpacked(x) * unpacked(y));
}
/// Empty when y contains zero, where Boost's is the quotients by its other points.
inline __m128d quotient(__m128d x, __m128d y) {
  const bool is_nonzero = packed::lower(y) > 0.0 || packed::upper(y) < 0.0;
  return is_nonzero ? packed_again(unpacked(x) / unpacked(y)) : packed::nothing();
}
inline __m128d square(__m128d x) {
  const bool is_set = packed::lower(x) <= packed::upper(x);
  return is_set ? packed_again(boost::numeric::square(unpacked(x))) : packed::nothing();
}

}  // namespace veritrack::rigor::boosted

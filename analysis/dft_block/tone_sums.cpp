#include "analysis/dft_block/tone_sums.hpp"

#include <cmath>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::symmetric;

/// sinc, or one s_m, and its first two derivatives.
struct SincDerivatives {
  Interval value, slope, bend;
};

/// sinc and its first two derivatives near 0: sum (-1)^k pi^2k d^2k / (2k+1)!, whose terms alternate and
/// fall.
SincDerivatives sinc_near_zero(const Interval& d) {
  constexpr int kTerms = 14;
  const Interval square_of_pi = square(rigor::pi());
  Interval value(0.0);
  Interval slope(0.0);
  Interval bend(0.0);
  Interval coefficient(1.0);  // (-1)^k pi^2k / (2k+1)!
  for (int k = 0; k < kTerms; ++k) {
    const int power = 2 * k;
    value += coefficient * rigor::pow(d, power);
    if (k > 0) {
      slope += Interval(power) * coefficient * rigor::pow(d, power - 1);
      bend += Interval(power * (power - 1)) * coefficient * rigor::pow(d, power - 2);
    }
    coefficient = -coefficient * square_of_pi / Interval((power + 2) * (power + 3));
  }
  // The remainder is at most the next term, and for |d| < 1/2 that is below 1e-20 in all three.
  const Interval rest = symmetric(1e-20);
  return {value + rest, slope + rest, bend + rest};
}

/// (-1)^m of it is s_m: with sine and cosine of pi x, s = sine/(pi d), s' = (cosine - s)/d, and d s'' + 2 s'
/// + pi^2 d s = 0.
SincDerivatives sinc_from(const Interval& d, const Interval& sine, const Interval& cosine) {
  const Interval value = sine / (rigor::pi() * d);
  const Interval slope = (cosine - value) / d;
  return {value, slope, -(square(rigor::pi()) * value) - Interval(2.0) * slope / d};
}

Interval dot(const TapValues& a, const TapValues& b, std::size_t count) {
  Interval sum(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// A family of functions of offset + share error: at the middle of the cell, and over it with derivatives.
struct Family {
  const TapValues &at_middle, &value, &slope;
  double share;
};

/// The distances of offset and error from their middles.
struct FromMiddle {
  Interval offset, error;
};

/// The sum of f g by the mean value theorem about the middle.
Interval sum_of_products(const Family& f, const Family& g, const FromMiddle& from, std::size_t count) {
  const Interval by_f = dot(f.slope, g.value, count);
  const Interval by_g = dot(f.value, g.slope, count);
  return dot(f.at_middle, g.at_middle, count) + from.offset * (by_f + by_g) +
         from.error * (Interval(f.share) * by_f + Interval(g.share) * by_g);
}

}  // namespace

Taps enclose_taps(const Interval& offset, int half_width) {
  const Interval middle(midpoint(offset));
  const Interval t = offset - middle;
  const double h = magnitude(t);
  const Interval pi = rigor::pi();
  const Interval third = pi * square(pi) / Interval(4.0);  // at most the size of a third derivative
  const Interval radius(h);
  const Interval half_square = square(t) / Interval(2.0);
  const Interval unit = symmetric(1.0);
  const Interval rest_value = third * radius * square(radius) / Interval(6.0) * unit;
  const Interval rest_slope = third * square(radius) / Interval(2.0) * unit;
  const Interval rest_bend = third * radius * unit;
  const auto [sine, cosine] = sin_cos(pi * middle);
  Taps taps;
  for (int m = -half_width; m <= half_width; ++m) {
    const auto i = static_cast<std::size_t>(m + half_width);
    const Interval d = middle + Interval(m);
    constexpr double kNear = 0.25;
    SincDerivatives sinc;
    if (magnitude(d) < kNear) {
      sinc = sinc_near_zero(d);
      if (m % 2 != 0) {
        sinc = {-sinc.value, -sinc.slope, -sinc.bend};
      }
    } else {
      sinc = sinc_from(d, sine, cosine);
    }
    taps.value[i] = sinc.value + sinc.slope * t + sinc.bend * half_square + rest_value;
    taps.slope[i] = sinc.slope + sinc.bend * t + rest_slope;
    taps.bend[i] = sinc.bend + rest_bend;
  }
  return taps;
}

ToneSums enclose_tone_sums(const Interval& offset, const Interval& error, int half_width) {
  const auto count = static_cast<std::size_t>(2 * half_width + 1);
  const Interval offset_middle(midpoint(offset));
  const Interval error_middle(midpoint(error));
  const FromMiddle from{offset - offset_middle, error - error_middle};
  const Interval half(0.5);
  const Taps x = enclose_taps(offset + error, half_width);
  const Taps d = enclose_taps(offset, half_width);
  const Taps b = enclose_taps(offset + half * error, half_width);
  const Taps x0 = enclose_taps(offset_middle + error_middle, half_width);
  const Taps d0 = enclose_taps(offset_middle, half_width);
  const Taps b0 = enclose_taps(offset_middle + half * error_middle, half_width);
  const Family value{x0.value, x.value, x.slope, 1.0};
  const Family slope{x0.slope, x.slope, x.bend, 1.0};
  const Family at_true{d0.value, d.value, d.slope, 0.0};
  const Family slope_between{b0.slope, b.slope, b.bend, 0.5};
  // (s(x) - s(d))/(x - d) = s'((x + d)/2) + (x - d)^2/24 s''' somewhere between.
  const Interval bend =
      square(error) / Interval(24.0) * (rigor::pi() * square(rigor::pi()) / Interval(4.0)) * symmetric(1.0);
  Interval sizes(0.0);
  Interval slope_sizes(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    sizes += abs(x.value[i]);
    slope_sizes += abs(x.slope[i]);
  }
  return {sum_of_products(value, value, from, count),
          sum_of_products(value, slope, from, count),
          sum_of_products(slope, slope, from, count),
          sum_of_products(value, at_true, from, count),
          sum_of_products(slope, at_true, from, count),
          sum_of_products(value, slope_between, from, count) + bend * sizes,
          sum_of_products(slope, slope_between, from, count) + bend * slope_sizes};
}

}  // namespace veritrack::dft_block

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

namespace {

/// |base|^exponent rounded up, for base >= 0.
double power_up(double base, unsigned int exponent) {
  double result = 1.0;
  for (double factor = base; exponent != 0; exponent >>= 1) {
    if ((exponent & 1U) != 0) {
      result = mul_up(result, factor);
    }
    factor = mul_up(factor, factor);
  }
  return result;
}

/// |base|^exponent rounded down, for base >= 0.
double power_down(double base, unsigned int exponent) {
  double result = 1.0;
  for (double factor = base; exponent != 0; exponent >>= 1) {
    if ((exponent & 1U) != 0) {
      result = mul_down(result, factor);
    }
    factor = mul_down(factor, factor);
  }
  return result;
}

/// t -> t^exponent is increasing on the whole line for odd exponents.
Interval odd_power(const Interval& x, unsigned int exponent) {
  const double low = x.lower() >= 0.0 ? power_down(x.lower(), exponent) : -power_up(-x.lower(), exponent);
  const double high = x.upper() >= 0.0 ? power_up(x.upper(), exponent) : -power_down(-x.upper(), exponent);
  return Interval::from_bounds(low, high);
}

Interval even_power(const Interval& x, unsigned int exponent) {
  return Interval::from_bounds(power_down(mignitude(x), exponent), power_up(magnitude(x), exponent));
}

}  // namespace

Interval pow(const Interval& x, int exponent) {
  if (is_empty(x)) {
    return x;
  }
  const unsigned int absolute =
      exponent < 0 ? 0U - static_cast<unsigned int>(exponent) : static_cast<unsigned int>(exponent);
  const Interval power = absolute % 2 == 1 ? odd_power(x, absolute) : even_power(x, absolute);
  return exponent < 0 ? Interval(1.0) / power : power;
}

}  // namespace veritrack::rigor

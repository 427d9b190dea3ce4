// A number with the slopes of its chords from a point c of a box: for every x of the box f(x) - f(c) is the
// sum of slope_k (x_k - c_k) for some slopes in `by`, whose balls are about half as wide as those of
// derivatives over the box.
#pragma once

#include <array>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

constexpr std::size_t kSides = 3;

struct Chord {
  Ball centre;  ///< f(c)
  Ball range;   ///< f over the box
  std::array<Ball, kSides> by;

  Chord() = default;
  Chord(const Ball& constant) : centre(constant), range(constant) {}  // NOLINT(google-explicit-constructor)
  /// centre + slope (x - c) for the variable x of this index.
  Chord(Ball at_centre, Ball over_box, std::size_t index, const Ball& slope)
      : centre(std::move(at_centre)), range(std::move(over_box)) {
    by[index] = slope;
  }
  /// A function of this one with these values and this secant slope.
  [[nodiscard]] Chord chain(Ball at_centre, Ball over_box, const Ball& slope) const {
    Chord z;
    z.centre = std::move(at_centre);
    z.range = std::move(over_box);
    for (std::size_t i = 0; i < kSides; ++i) {
      if (arb_is_zero(by[i].raw()) == 0) {
        arb_mul(z.by[i].raw(), slope.raw(), by[i].raw(), precision());
      }
    }
    return z;
  }
  /// Contains (f(x) + f(c))/2.
  [[nodiscard]] Ball mean() const { return half * (centre + range); }
};

inline Chord operator+(const Chord& x, const Chord& y) {
  Chord z;
  z.centre = x.centre + y.centre;
  z.range = x.range + y.range;
  for (std::size_t i = 0; i < kSides; ++i) {
    arb_add(z.by[i].raw(), x.by[i].raw(), y.by[i].raw(), precision());
  }
  return z;
}
inline Chord operator-(const Chord& x) {
  return x.chain(-x.centre, -x.range, Ball(-1.0));
}
inline Chord operator-(const Chord& x, const Chord& y) {
  Chord z;
  z.centre = x.centre - y.centre;
  z.range = x.range - y.range;
  for (std::size_t i = 0; i < kSides; ++i) {
    arb_sub(z.by[i].raw(), x.by[i].raw(), y.by[i].raw(), precision());
  }
  return z;
}
/// f g - f(c) g(c) = (f + f(c))/2 (g - g(c)) + (g + g(c))/2 (f - f(c)).
inline Chord operator*(const Chord& x, const Chord& y) {
  Chord z = x.chain(x.centre * y.centre, x.range * y.range, y.mean());
  const Ball mean = x.mean();
  for (std::size_t i = 0; i < kSides; ++i) {
    if (arb_is_zero(y.by[i].raw()) == 0) {
      arb_addmul(z.by[i].raw(), mean.raw(), y.by[i].raw(), precision());
    }
  }
  return z;
}
inline Chord operator*(const Ball& x, const Chord& y) {
  return y.chain(x * y.centre, x * y.range, x);
}
/// f/g - f(c)/g(c) = (f - f(c) - (f(c)/g(c)) (g - g(c)))/g.
inline Chord operator/(const Chord& x, const Chord& y) {
  const Ball quotient = x.centre / y.centre;
  const Ball over = one / y.range;
  Chord z = x.chain(quotient, x.range * over, over);
  const Ball factor = quotient * over;
  for (std::size_t i = 0; i < kSides; ++i) {
    arb_submul(z.by[i].raw(), factor.raw(), y.by[i].raw(), precision());
  }
  return z;
}
inline Chord reciprocal(const Chord& x) {
  const Ball at_centre = one / x.centre;
  const Ball over_box = one / x.range;
  return x.chain(at_centre, over_box, -(at_centre * over_box));
}
inline Chord square(const Chord& x) {
  return x.chain(square(x.centre), square(x.range), x.centre + x.range);
}
inline Chord sqrt(const Chord& x) {
  const Ball at_centre = sqrt(x.centre);
  const Ball over_box = sqrt(x.range);
  return x.chain(at_centre, over_box, one / (at_centre + over_box));
}
/// sin x - sin c = 2 cos((x + c)/2) sin((x - c)/2), and the same for the cosine.
inline Ball sine_of_half_difference(const Chord& x) {
  return sine_ratio(half * (x.range - x.centre)).value;
}
inline Chord sin(const Chord& x) {
  return x.chain(sin(x.centre), sin(x.range), cos(x.mean()) * sine_of_half_difference(x));
}
inline Chord cos(const Chord& x) {
  return x.chain(cos(x.centre), cos(x.range), -(sin(x.mean()) * sine_of_half_difference(x)));
}
/// sin(x)/x and atan(x)/x: even functions f with f' = x g, so that f(x) - f(c) = (x + c)/2 g (x - c), g
/// somewhere between c and x.
inline Chord even(const Chord& x, const Ratio& at_centre, const Ratio& over_box) {
  return x.chain(at_centre.value, over_box.value, x.mean() * over_box.slope);
}
inline Chord sine_over(const Chord& x) {
  return even(x, sine_ratio(x.centre), sine_ratio(Ball::hull(x.centre, x.range)));
}
inline Chord arctangent_over(const Chord& t) {
  return even(t, arctangent_ratio(t.centre), arctangent_ratio(Ball::hull(t.centre, t.range)));
}
inline const Ball& value_of(const Chord& x) {
  return x.range;
}

}  // namespace veritrack::checker

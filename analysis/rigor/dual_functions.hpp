// Functions of dual numbers that only the recursions of users need, beside those of dual.hpp.
#pragma once

#include <cmath>

#include "analysis/rigor/dual.hpp"

namespace veritrack::rigor {

/// Over intervals: empty unless x lies in [-1, 1], the derivatives unless it lies inside.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> asin(const Dual<Scalar, N>& x) {
  using detail::square;
  using std::asin, std::sqrt;
  return x.chain(asin(x.value()), Scalar(1.0) / sqrt(Scalar(1.0) - square(x.value())));
}

/// As asin.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> acos(const Dual<Scalar, N>& x) {
  using detail::square;
  using std::acos, std::sqrt;
  return x.chain(acos(x.value()), Scalar(-1.0) / sqrt(Scalar(1.0) - square(x.value())));
}

/// x: unknown, derivatives included, unless it is shown that low < x < high.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> stays_within(const Dual<Scalar, N>& x, const Dual<Scalar, N>& low,
                                           const Dual<Scalar, N>& high) {
  const Scalar shown = stays_within(x.value(), low.value(), high.value());
  return x.chain(shown, Scalar(1.0) + Scalar(0.0) * shown);  // unknown where that is
}

}  // namespace veritrack::rigor

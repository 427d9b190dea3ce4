// A share of noise seeds, and how sure one may be of it.
#pragma once

#include <array>
#include <cmath>

namespace veritrack::reports {

/// Wilson's score interval for a share observed in this many seeds, at two standard errors: E. B. Wilson, J.
/// American Statistical Association 22 (1927), 209. It is also informative where none, or all, were observed.
[[nodiscard]] inline std::array<double, 2> share_interval(double share, int seeds) {
  constexpr double kErrors = 2.0;
  const double n = seeds;
  const double square = kErrors * kErrors / n;
  const double middle = (share + 0.5 * square) / (1.0 + square);
  const double half = kErrors / (1.0 + square) * std::sqrt(share * (1.0 - share) / n + 0.25 * square / n);
  return {middle - half, middle + half};
}

}  // namespace veritrack::reports

// Confidence limits of a frequency, for tests that count.
#pragma once

#include <cmath>
#include <cstdint>

namespace veritrack::test {

/// The probability of at least `count` of `trials`, each with probability p.
inline double at_least(std::int64_t count, std::int64_t trials, double p) {
  if (count <= 0) {
    return 1.0;
  }
  const auto n = static_cast<double>(trials);
  double below = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const auto x = static_cast<double>(k);
    below += std::exp(std::lgamma(n + 1.0) - std::lgamma(x + 1.0) - std::lgamma(n - x + 1.0) +
                      x * std::log(p) + (n - x) * std::log1p(-p));
  }
  return 1.0 - below;
}

/// The interval of C. J. Clopper and E. S. Pearson (Biometrika 26, 1934) for the probability of what happened
/// `count` times: each side misses it with a probability of at most `risk`.
struct ConfidenceInterval {
  double lower = 0.0, upper = 1.0;
};
inline ConfidenceInterval clopper_pearson(std::int64_t count, std::int64_t trials, double risk) {
  const auto solve = [&](std::int64_t least, double value) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (at_least(least, trials, middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  return {count == 0 ? 0.0 : solve(count, risk), count == trials ? 1.0 : solve(count + 1, 1.0 - risk)};
}

}  // namespace veritrack::test

#include "certificates/sets/counted_share.hpp"

#include <cmath>

namespace veritrack::certificates {

namespace {

constexpr double kRisk = 0.005;

/// The probability of fewer than `count` of `trials`, each with probability p, 0 < p < 1.
double fewer_than(std::int64_t count, std::int64_t trials, double p) {
  const double odds = std::log(p) - std::log1p(-p);
  double logarithm = static_cast<double>(trials) * std::log1p(-p);
  double sum = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    sum += std::exp(logarithm);
    logarithm += odds + std::log(static_cast<double>(trials - k) / static_cast<double>(k + 1));
  }
  return sum;
}

/// The p with which fewer than `count` have this probability, which falls with p. 1 <= count <= trials.
double solve(std::int64_t count, std::int64_t trials, double probability) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (fewer_than(count, trials, middle) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

CountedShare counted_share(std::int64_t count, std::int64_t trials) {
  return {count, count == 0 ? 0.0 : solve(count, trials, 1.0 - kRisk),
          count == trials ? 1.0 : solve(count + 1, trials, kRisk)};
}

}  // namespace veritrack::certificates

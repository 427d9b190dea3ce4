#include "checker/model/gain/stability.hpp"

namespace veritrack::checker {

namespace {

enum class Roots { all_inside, one_outside, unknown };

/// The roots of p(radius z), about the unit circle: step by step to (p_n p(z) - p_0 z^n p(1/z)) / z, which
/// has one root fewer inside and as many outside, while |p_0| < |p_n|. Where |p_0| > |p_n| the product of the
/// roots is larger than 1.
Roots roots_about(const BallRows& matrix, const Ball& radius) {
  std::vector<Ball> p = characteristic_polynomial(matrix);
  Ball power = one;
  for (Ball& coefficient : p) {
    coefficient = coefficient * power;
    power = power * radius;
  }
  while (p.size() > 1) {
    const Ball first = abs(p.front());
    const Ball last = abs(p.back());
    if (certainly_less(last, first)) {
      return Roots::one_outside;
    }
    if (!certainly_less(first, last)) {
      return Roots::unknown;
    }
    std::vector<Ball> reduced;
    for (std::size_t i = 1; i < p.size(); ++i) {
      reduced.push_back(p.back() * p[i] - p.front() * p[p.size() - 1 - i]);
    }
    p = reduced;
  }
  return Roots::all_inside;
}

}  // namespace

bool all_eigenvalues_within(const BallRows& matrix, const Ball& radius) {
  return !matrix.empty() && certainly_positive(radius) && roots_about(matrix, radius) == Roots::all_inside;
}

bool an_eigenvalue_beyond(const BallRows& matrix, const Ball& radius) {
  return !matrix.empty() && certainly_positive(radius) && roots_about(matrix, radius) == Roots::one_outside;
}

}  // namespace veritrack::checker

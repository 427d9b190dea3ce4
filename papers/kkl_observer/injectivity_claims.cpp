#include "papers/kkl_observer/injectivity_claims.hpp"

#include <array>
#include <cmath>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using theorems::decide;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

using PaperState = std::array<Interval, 3>;
using Rates = std::array<Interval, 4>;

/// (6).
Interval transformed_by(const Interval& rate, const PaperState& x) {
  return (rate * x[0] + x[1]) / (square(rate) + x[2]);
}

/// |T(a) - T(b)|.
Interval image_distance(const Rates& rates, const PaperState& a, const PaperState& b) {
  Interval sum(0.0);
  for (const Interval& rate : rates) {
    sum += square(transformed_by(rate, a) - transformed_by(rate, b));
  }
  return sqrt(sum);
}

/// The largest of 1/sqrt(smallest), sqrt(smallest) and sqrt(largest), eigenvalues of the Vandermonde matrix
/// times its transpose: what the printed denominator, the root of lambda_min(V'V)^-1, may stand for. Empty
/// when the eigenvalues were not enclosed.
Interval largest_reading(const Rates& rates) {
  rigor::IntervalMatrix<4> vandermonde;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      vandermonde(i, k) = pow(rates.at(static_cast<std::size_t>(i)), 3 - k);
    }
  }
  const rigor::IntervalMatrix<4> gram = vandermonde.transpose() * vandermonde;
  const auto eigenvalues = rigor::symmetric_eigenvalues(gram);
  if (!eigenvalues) {
    return Interval::empty();
  }
  Interval smallest = (*eigenvalues)(0);
  Interval largest = (*eigenvalues)(0);
  for (int i = 1; i < 4; ++i) {
    smallest = min(smallest, (*eigenvalues)(i));
    largest = max(largest, (*eigenvalues)(i));
  }
  return max(Interval(1.0) / sqrt(smallest), max(sqrt(smallest), sqrt(largest)));
}

Statement printed_constant() {
  const Rates rates{parse_decimal("0.1"), parse_decimal("0.2"), parse_decimal("0.3"), Interval(1.0)};
  const PaperState a{parse_decimal("99.5743"), parse_decimal("-139.3188"), Interval(100.0)};
  const PaperState b{parse_decimal("98.5743"), parse_decimal("-137.9253"), Interval(99.0)};
  const Interval half(0.5);
  const Interval mean = half * (a[2] + b[2]);
  const Interval weight = half * (abs(a[0]) + abs(a[1]) + abs(b[0]) + abs(b[1]));
  const Interval left = abs(a[0] - b[0]) + abs(a[1] - b[1]) + weight * abs(a[2] - b[2]);
  const Interval one(1.0);  // the largest rate, too
  const Interval right =
      square(one + mean) * (one + mean) * largest_reading(rates) * image_distance(rates, a, b);
  return make_statement(
      "kkl-paper/injectivity-constant",
      "|Δx1| + |Δx2| + c |Δx3| is at most d |ΔT| with d as printed in section IV.",
      decide(left, right, Strictness::weak),
      "λ = (0.1, 0.2, 0.3, 1), xᵃ = (99.5743, -139.3188, 100), xᵇ = (98.5743, -137.9253, 99): the left side "
      "is " +
          enclosed(left) + ", the right side " + enclosed(right) +
          ", whichever way the root of λ_min(V'V)^-1 is read. The sum of the four terms is bounded by their "
          "norm; the factor sqrt(2 (1 + x3)^2 + 2)/(1 + x3) is missing.",
      {});
}

Statement not_everywhere() {
  const Rates rates{Interval(1.0), Interval(2.0), Interval(3.0), Interval(4.0)};
  const Interval small(std::ldexp(1.0, -500));
  const Interval near =
      image_distance(rates, {small, Interval(0.0), Interval(1.0)}, {small, Interval(0.0), Interval(2.0)});
  const Interval large(1e6);
  const Interval far = image_distance(rates, {Interval(1.0), Interval(0.0), large},
                                      {Interval(1.0), Interval(0.0), Interval(2.0) * large});
  return make_statement(
      "kkl-paper/not-lipschitz",
      "T is not Lipschitz injective on all of O: no constant serves where (x1, x2) tends to 0, nor where x3 "
      "grows.",
      rigor::conjunction({decide(Interval(1e140) * near, Interval(1.0), Strictness::strict),
                          decide(Interval(1e10) * far, large, Strictness::strict)}),
      "λ = (1, 2, 3, 4). (t, 0, 1) and (t, 0, 2) are 1 apart, their images t times a number, at t = 2^-500 " +
          enclosed(near) + ". (1, 0, s) and (1, 0, 2 s) are s apart, their images at s = 1e6 " +
          enclosed(far) + ".",
      {});
}

/// With e = ell |ξ|² and m = |Mξ|² >= e: e - 2 m = -(m - e) - m, and e - m = -(m - e).
Statement factor_two() {
  const Verdict identity = rigor::vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [e, m] = at;
        return (e - Interval(2.0) * m) + (m - e) + m;
      },
      1);
  return make_statement(
      "kkl-paper/factor-two",
      "With ell of (10), mu of (9) vanishes on T(O_r), as (14) asks, with the factor 2 of (9) and without "
      "it.",
      identity,
      "On T(O_r) ell |ξ|² is at most |Mξ|², by (10): ell |ξ|² - 2 |Mξ|² = -(|Mξ|² - ell |ξ|²) - |Mξ|² is not "
      "positive, and neither is ell |ξ|² - |Mξ|². With the factor twice the ell of (10) would do.",
      {});
}

}  // namespace

std::vector<Statement> injectivity_claims() {
  const rigor::UpwardRounding upward;
  return {printed_constant(), not_everywhere(), factor_two()};
}

}  // namespace veritrack::kkl_observer

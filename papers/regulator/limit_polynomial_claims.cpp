#include <array>
#include <cstddef>
#include <string>

#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/regulator/limit_claims.hpp"
#include "papers/regulator/printed_limits.hpp"

namespace veritrack::regulator {

namespace {

using rigor::conjunction;
using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

/// Is `polynomial`, coefficient by coefficient, among those that are printed as `rounded`?
Verdict is_printed_as(const Polynomial& polynomial, const Polynomial& rounded) {
  if (polynomial.size() != rounded.size()) {
    return Verdict::undecided;
  }
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    if (!is_subset(polynomial[i], rounded[i])) {
      return Verdict::undecided;
    }
  }
  return Verdict::proved;
}

/// Is no polynomial in `a` a constant multiple of one in `b`? Their first two coefficients decide.
Verdict is_no_multiple(const Polynomial& a, const Polynomial& b) {
  return decide(Interval(0.0), abs(a[0] * b[1] - a[1] * b[0]), Strictness::strict);
}

/// p at q^-1 = x.
Interval value_at(const Polynomial& p, const Interval& x) {
  Interval sum(0.0);
  for (auto coefficient = p.rbegin(); coefficient != p.rend(); ++coefficient) {
    sum = sum * x + *coefficient;
  }
  return sum;
}

/// The number as a point of z, and half a unit of its last digit to either side.
Interval as_printed(const char* decimal) {
  return printed_polynomial({decimal}, Printed::rounded).front();
}

std::vector<Statement> multiple_statements() {
  const FrozenLoop ideal = ideal_loop();
  const FrozenLoop first = table_5_1_loop(Printed::rounded);
  const FrozenLoop second = table_5_2_loop(Printed::rounded);
  const Interval at_two = value_at(second.numerator, Interval(2.0));
  return {
      make_statement("chapter-5/limits/table-5.1/denominator",
                     "The denominator of Table 5.1's limit is a multiple of the ideal one, to the printed "
                     "digits.",
                     is_printed_as(ideal.denominator, first.denominator),
                     "3 A2 = 3 (1, -3^(1/2), 1) is printed as (3.0000, -5.1962, 3.0000).", {}),
      make_statement(
          "chapter-5/limits/table-5.1/numerator",
          "The numerator of Table 5.1's limit is no multiple of the ideal one, whatever its "
          "coefficients are rounded from.",
          is_no_multiple(first.numerator, ideal.numerator),
          "The first two coefficients and those of the ideal one have the determinant " +
              enclosed(first.numerator[0] * ideal.numerator[1] - first.numerator[1] * ideal.numerator[0]) +
              ".",
          {}),
      make_statement(
          "chapter-5/limits/table-5.2/no-multiples",
          "Neither the denominator nor the numerator of Table 5.2's limit is a constant multiple of the "
          "ideal one.",
          conjunction({is_no_multiple(second.denominator, ideal.denominator),
                       is_no_multiple(second.numerator, ideal.numerator)}),
          "The first two coefficients decide. Nor is its numerator the ideal one times a polynomial: that "
          "has a zero at q^-1 = 2, where the printed one is " +
              enclosed(at_two) + ".",
          {}),
      make_statement("chapter-5/limits/table-5.2/denominator",
                     "The denominator of Table 5.2's limit is A2 times a polynomial, to the printed digits: "
                     "the poles of the vibration are in the controller.",
                     is_printed_as(product(vibration_factor(), table_5_2_cofactor()), second.denominator),
                     "A2 (2.96044 - 0.421976/z - 0.415882/z^2) is printed so.", {})};
}

std::vector<Statement> pole_statements() {
  const FrozenLoop second = table_5_2_loop(Printed::rounded);
  const Polynomial cofactor = table_5_2_cofactor();
  const std::array<const char*, 2> printed{"-3.2232", "2.2085"};
  // A pole z of the controller is a zero q = z of D: of q^-1 = 1/z.
  const Interval at_pole = value_at(second.denominator, Interval(1.0) / as_printed(printed[0]));
  const auto has_zero_at = [&](const char* decimal) {
    const Interval almost_half_a_unit = parse_decimal("0.00004");
    const Interval low = value_at(cofactor, parse_decimal(decimal) - almost_half_a_unit);
    const Interval high = value_at(cofactor, parse_decimal(decimal) + almost_half_a_unit);
    return decide(low * high, Interval(0.0), Strictness::strict);
  };
  return {
      make_statement("chapter-5/limits/table-5.2/poles/printed",
                     "Two poles of the limiting controller of Table 5.2 are -3.2232 and 2.2085.",
                     decide(abs(at_pole), parse_decimal("0.01"), Strictness::weak),
                     "At z = -3.2232 its denominator is " + enclosed(at_pole) +
                         ", whatever its coefficients and the pole are rounded from.",
                     {}),
      make_statement(
          "chapter-5/limits/table-5.2/poles/corrected",
          "-3.2232 and 2.2085 are the zeros of that denominator in z^-1, to the printed digits: the "
          "controller's other poles are their reciprocals, about -0.3103 and 0.4528, inside the unit circle.",
          conjunction({is_printed_as(product(vibration_factor(), cofactor), second.denominator),
                       has_zero_at(printed[0]), has_zero_at(printed[1])}),
          "2.96044 - 0.421976/z - 0.415882/z^2 changes its sign within half a unit of the last digit of "
          "both.",
          {})};
}

/// N/D' at the common pole, D' the denominator without A_2, is the residue up to a common factor.
std::vector<Statement> matching_statements() {
  struct Complex {
    Interval real, imaginary;
  };
  const auto at_vibration = [](const Polynomial& p) {
    Complex sum{Interval(0.0), Interval(0.0)};
    for (std::size_t k = 0; k < p.size(); ++k) {
      const auto [sine, cosine] = rigor::sin_cos(Interval(static_cast<double>(k)) * vibration());
      sum = {sum.real + p[k] * cosine, sum.imaginary - p[k] * sine};
    }
    return sum;
  };
  const auto squared_size = [](const Complex& a) { return square(a.real) + square(a.imaginary); };
  // |N/D'| over that of the ideal controller: what their gains' ratio tends to at the common pole.
  const auto ratio = [&](const Polynomial& numerator, const Polynomial& cofactor) {
    const FrozenLoop ideal = ideal_loop();
    return sqrt(squared_size(at_vibration(numerator)) / squared_size(at_vibration(cofactor)) /
                (squared_size(at_vibration(ideal.numerator)) / Interval(9.0)));
  };
  const auto statement = [](const std::string& number, const Interval& gains) {
    return make_statement(
        "chapter-5/limits/match/table-" + number,
        "The limiting controller of Table " + number +
            " matches the ideal controller at the frequency of the vibration: towards it, "
            "the ratio of their gains tends to 1.",
        decide(abs(gains - Interval(1.0)), parse_decimal("0.01"), Strictness::weak),
        "Both have a pole there, to the printed digits, and the ratio of their gains tends to " +
            enclosed(gains) + ". The pole alone is what drives the output to zero.",
        {});
  };
  return {statement("5.1", ratio(table_5_1_loop(Printed::rounded).numerator, {Interval(3.0)})),
          statement("5.2", ratio(table_5_2_loop(Printed::rounded).numerator, table_5_2_cofactor()))};
}

/// A constant controller that leaves nothing of the vibration: has it the vibration's poles?
std::vector<Statement> internal_model_statements() {
  // The plant 1/A_2 with unit delay, and u_k = -(c y_k - y_{k-1}), c = 2 cos(omega): y less A_2 v, in which
  // no pole is left, as a polynomial in c and z = q^-1.
  const Verdict cancels = rigor::vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [c, z] = at;
        const Interval factor = Interval(1.0) - c * z + z * z;
        return factor + z * (c - z) - Interval(1.0);
      },
      2);
  // D (A_1 y - z B_1 u - A_1 v) + z B_1 (D u + N y) = (A_1 D + z B_1 N) y - A_1 D v.
  const Verdict loop = rigor::vanishes<8>(
      [](const std::array<Interval, 8>& at) {
        const auto& [a, b, d, n, y, u, v, z] = at;
        return d * (a * y - z * b * u - a * v) + z * b * (d * u + n * y) -
               ((a * d + z * b * n) * y - a * d * v);
      },
      1);
  return {
      make_statement(
          "chapter-5/internal-model/printed",
          "A constant controller in a stable loop that drives the output to zero has poles on the unit "
          "circle at the frequency of the vibration, whatever the plant (section 5.3.2).",
          cancels == Verdict::proved ? Verdict::refuted : Verdict::undecided,
          "x_k = 2 cos(omega) x_{k-1} - x_{k-2} + u_{k-1}, which satisfies assumptions 1 to 3, with u_k = "
          "-(2 "
          "cos(omega) y_k - y_{k-1}): A2 + (2 cos(omega) - 1/z)/z = 1, so that y = A2 v = 0 from the third "
          "sample on, and the controller has no pole but z = 0.",
          {}),
      make_statement(
          "chapter-5/internal-model/corrected",
          "A constant controller in a stable loop drives the output to zero for every vibration of frequency "
          "omega if and only if A1 D is a multiple of A2; so is its denominator D when the plant has no pole "
          "at e^{j omega}. Beyond that its numerator does not matter.",
          loop,
          "(A1 D + B1 N/z) y = A1 D v: in a stable loop the vibration leaves |A1 D| at e^{j omega} over a "
          "number that is not 0, and a real polynomial with the zero e^{j omega} has the factor A2.",
          {})};
}

}  // namespace

std::vector<Statement> limit_polynomial_claims() {
  std::vector<Statement> statements = multiple_statements();
  for (auto part : {pole_statements(), matching_statements(), internal_model_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::regulator

#include <array>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/claims/vibration_loop_claims.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::vanishes;

std::vector<Statement> disturbance_statements() {
  const Interval two_cosines = Interval(2.0) * cos(rigor::pi() / Interval(6.0));
  const Interval printed = sin(Interval(0.0)) / sin(rigor::pi() / Interval(6.0));
  const Interval next = two_cosines * Interval(0.0) - Interval(0.0);
  return {
      make_statement("chapter-5/disturbance/printed",
                     "v_k = alpha_k e_{-1} + beta_k e_{-2} with alpha_k = sin(k omega)/sin(omega), beta_k = "
                     "sin((k+1) omega)/sin(omega).",
                     decide(abs(two_cosines - printed), Interval(0.0), Strictness::weak),
                     "omega = pi/6, e_{-1} = 1, e_{-2} = 0: A2 v = q^2 e gives v_0 = 2 cos(omega), " +
                         enclosed(two_cosines) + ", and alpha_0 is 0.",
                     {}),
      make_statement(
          "chapter-5/disturbance/corrected",
          "v_k = e_{-1} sin((k+2) omega)/sin(omega) + e_{-2} sin((k+3) omega)/sin(omega), for every "
          "frequency that is no multiple of pi.",
          vanishes<4>(
              [](const std::array<Interval, 4>& at) {
                // The addition theorems in place of sin(a +- omega).
                const auto& [sine, cosine, s, c] = at;
                return (sine * c + cosine * s) + (sine * c - cosine * s) - Interval(2.0) * c * sine;
              },
              1),
          "Both sides are e_{-2} at k = -2 and 2 cos(omega) e_{-2} + e_{-1} at k = -1, and sin(a + "
          "omega) + sin(a - omega) = 2 cos(omega) sin(a) is the recursion A2 v = 0.",
          {}),
      make_statement(
          "chapter-5/initial-conditions",
          "There is a disturbance with v_k = 0 for all k <= 0, as the initial conditions of section "
          "5.2.4 have it.",
          decide(Interval(0.0), abs(next), Strictness::strict),
          "v_{-1} = v_0 = 0 and e_k = 0 for k >= 0: v_1 = 2 cos(omega) v_0 - v_{-1} = 0, and so on "
          "for ever. That the plant is at rest is all that is needed.",
          {})};
}

/// The coefficients of q^0, q, q^2, ... evaluated.
template <std::size_t N>
Interval polynomial(const std::array<Interval, N>& coefficients, const Interval& q) {
  Interval sum(0.0);
  for (auto each = coefficients.rbegin(); each != coefficients.rend(); ++each) {
    sum = sum * q + *each;
  }
  return sum;
}

/// The printed products of A_2 with A_1 and B_1 for n = 5; c = 2 cos(omega).
std::vector<Statement> expansion_statements() {
  const auto first = [](const std::array<Interval, 5>& at) {
    const auto& [a1, a2, a3, c, q] = at;
    const Interval one(1.0);
    return polynomial<4>({a3, a2, a1, one}, q) * polynomial<3>({one, -c, one}, q) -
           polynomial<6>({a3, a2 - c * a3, a1 - c * a2 + a3, one - c * a1 + a2, a1 - c, one}, q);
  };
  // `sign` of b'_2 in the coefficient of q^2.
  const auto second = [](const std::array<Interval, 5>& at, const Interval& sign) {
    const auto& [b0, b1, b2, c, q] = at;
    const Interval one(1.0);
    return polynomial<3>({b2, b1, b0}, q) * polynomial<3>({one, -c, one}, q) -
           polynomial<5>({b2, b1 - c * b2, b0 - c * b1 + sign * b2, b1 - c * b0, b0}, q);
  };
  return {
      make_statement("chapter-5/expansion/A",
                     "The coefficients of A = A1 A2 are as section 5.2.4 prints them, for n = 5.",
                     vanishes<5>(first, 5),
                     "The difference is the zero polynomial, evaluated exactly on a grid.", {}),
      make_statement(
          "chapter-5/expansion/B/printed",
          "The third coefficient of B = A2 B1 is b'_0 - 2 cos(omega) b'_1 - b'_2 (section 5.2.4), for n = 5.",
          vanishes<5>([&](const std::array<Interval, 5>& at) { return second(at, Interval(-1.0)); }, 4),
          "omega = pi/3, B1 = q^2 + 1: A2 B1 = q^4 - q^3 + 2 q^2 - q + 1, and the printed coefficient of q^2 "
          "is 0.",
          {}),
      make_statement(
          "chapter-5/expansion/B/corrected",
          "With + b'_2 in the third coefficient the coefficients of B = A2 B1 are as printed, for n = 5.",
          vanishes<5>([&](const std::array<Interval, 5>& at) { return second(at, Interval(1.0)); }, 4),
          "The difference is the zero polynomial, evaluated exactly on a grid. The general coefficient, of "
          "q^2, is printed so.",
          {})};
}

std::vector<Statement> ideal_controller_statements() {
  const Interval two(2.0);
  return {make_statement(
              "chapter-5/ideal-controller/general",
              "(B2 - A2)/A2 is (2 cos(omega) q - 1)/(1 - 2 cos(omega) q + q^2), so that (5.3) is the "
              "controller K of section 5.2.4.",
              vanishes<2>(
                  [&](const std::array<Interval, 2>& at) {
                    const auto& [c, q] = at;
                    return q * q - (Interval(1.0) - two * c * q + q * q) - (two * c * q - Interval(1.0));
                  },
                  2),
              "The numerators' difference is the zero polynomial in cos(omega) and q.", {}),
          make_statement("chapter-5/ideal-controller/example",
                         "For the plant of section 5.4 its numerator is 2 cos(omega) - (1 + cos(omega))/z + "
                         "1/(2 z^2), over 3 A2.",
                         vanishes<2>(
                             [&](const std::array<Interval, 2>& at) {
                               const auto& [c, z] = at;
                               const Interval half(0.5);
                               return (Interval(1.0) - half * z) * (two * c - z) -
                                      (two * c - (Interval(1.0) + c) * z + half * z * z);
                             },
                             2),
                         "(1 - 1/(2z)) (2 cos(omega) - 1/z), multiplied out.", {}),
          make_statement(
              "chapter-5/ideal-controller/output",
              "From rest, the ideal control law gives y_k = e_k for every plant, every frequency and "
              "every k.",
              vanishes<2>(
                  [&](const std::array<Interval, 2>& at) {
                    const auto& [c, z] = at;
                    return (Interval(1.0) - two * c * z + z * z) + z * (two * c - z) - Interval(1.0);
                  },
                  2),
              "P K = (2 cos(omega) - 1/z)/(z A2), and A2 + (2 cos(omega) - 1/z)/z = 1: (1 + P K) y = e/A2 "
              "is y = e.",
              {})};
}

}  // namespace

std::vector<Statement> vibration_model_claims() {
  std::vector<Statement> statements = disturbance_statements();
  for (auto part : {expansion_statements(), ideal_controller_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

#include "papers/claims/tracker_theory_claims.hpp"

#include <array>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::vanishes;
using rigor::Verdict;

/// f(x) = 10 x, H = 1, R = 25, Q = 1, N = 1: C = 1 and O = (1 + 1/100)/25.
Statement start_of_theorem_2_8() {
  const Interval gramian = parse_decimal("1.01") / Interval(25.0);
  const Interval p = Interval(1.0) + Interval(1.0) / gramian;
  const Interval q = Interval(1.0) + gramian;
  const Interval predicted = Interval(100.0) * parse_decimal("0.001") + Interval(1.0);
  const Interval growth = Interval(10.0) * (Interval(25.0) / (predicted + Interval(25.0)));
  const Interval bound = sqrt(p * q);
  return make_statement(
      "chapter-2/theorem-2.8/start",
      "|z(0)| < eps_z/(pq)^(1/2) implies |z(k)| <= (pq)^(1/2) (1 - gamma/q)^(k/2) |z(0)|, (2.36), for every "
      "start P(0|0).",
      decide(growth, bound, Strictness::weak),
      "f(x) = 10 x, H = 1, R = 25, Q = 1, N = 1, x(k) = 0 and P(0|0) = 1/1000: |z(1)| is " +
          enclosed(growth) + " |z(0)|, and (pq)^(1/2) is " + enclosed(bound) +
          ". Its proof needs P(0|0) >= I/q.",
      {});
}

std::vector<Statement> parts_of_theorem_2_8() {
  const Verdict radius = vanishes<3>(
      [](const std::array<Interval, 3>& x) {
        const auto& [q, rho, u] = x;  // q, rho_1, the root
        const Interval t = u - rho;   // rho_4 |z|^2/2 at the printed radius
        return q * square(t) + Interval(2.0) * rho * q * t - q * (square(u) - square(rho));
      },
      2);
  // a1 = (1 + u) a2, b2 = (1 + v) b1, t = a2 b1.
  const Verdict product = vanishes<3>(
      [](const std::array<Interval, 3>& x) {
        const auto& [u, v, t] = x;
        const Interval one(1.0);
        return (one + t * (one + u)) * (one + t * (one + v)) - Interval(4.0) * t -
               (square(one - t) + t * (u + v) * (one + t) + square(t) * u * v);
      },
      2);
  return {make_statement(
              "chapter-2/theorem-2.8/bounded-start", "The same for every start with I/q <= P(0|0) <= p I.",
              Verdict::undecided,
              "Its proof takes B(k) for F_x - F_zbar, which is REFUTED (theorem-2.9/decomposition); no "
              "trajectory that violates (2.36) is known.",
              {}),
          make_statement(
              "chapter-2/theorem-2.8/radius",
              "(2.35) solves -1/(sp^2) + rho_1 rho_4 q |z|^2 + rho_4^2 q |z|^4/4 = -gamma for |z|.", radius,
              "With t = rho_4 |z|^2/2: q t^2 + 2 rho_1 q t = q (u^2 - rho_1^2) at t = u - rho_1, u^2 = "
              "rho_1^2 + (1/(sp^2) - gamma)/q; an identity.",
              {}),
          make_statement(
              "chapter-2/theorem-2.8/product", "pq > 1 (proof of Theorem 2.8); even pq >= 4.", product,
              "With a1 = (1 + u) a2, b2 = (1 + v) b1, t = a2 b1 > 0: t (pq - 4) = (1 - t)^2 + t (u + v)(1 + "
              "t) + t^2 u v >= 0, an identity.",
              {}),
          make_statement(
              "chapter-2/theorem-2.8/decrease",
              "Without B(k), V decreases by at least |z|^2/(sp^2) (proof of Theorem 2.8), s as in section "
              "2.4.3, where I/q <= P(k|k) <= p I.",
              vanishes<2>([](const std::array<Interval, 2>& x) { return (x[0] + x[1]) - (x[1] + x[0]); }, 1),
              "z'P^-1 [P^-1 + F'Q^-1F]^-1 P^-1 z >= |P^-1 z|^2/(q + rho_1^2/delta_1), |P^-1 z| >= |z|/p, "
              "and s = q + rho_1^2/delta_1.",
              {})};
}

/// The largest output of a tone of amplitude 0 with this frequency.
Interval output_without_amplitude(const Interval& frequency) {
  Interval x1(0.0);
  Interval x2(0.0);
  Interval seen(0.0);
  const auto [sine, cosine] = rigor::sin_cos(frequency);
  for (int k = 0; k < 3; ++k) {
    seen = rigor::max(seen, rigor::max(rigor::abs(x1), rigor::abs(x2)));
    const Interval turned = cosine * x1 - sine * x2;
    x2 = sine * x1 + cosine * x2;
    x1 = turned;
  }
  return seen;
}

std::vector<Statement> discussion_statements() {
  const Interval apart = output_without_amplitude(Interval(0.0)) + output_without_amplitude(Interval(1.0));
  const Interval far = Interval(1.0) + square(Interval(1e150));
  return {
      make_statement("chapter-2/section-2.2.4/global-observability",
                     "The signal model of the frequency tracking problem is not observable globally.",
                     decide(apart, Interval(0.0), Strictness::weak),
                     "(0, 0, 0) and (0, 0, 1) have the same outputs at every sample, (0, 0): a rotation "
                     "leaves 0 where it is.",
                     {}),
      make_statement("chapter-2/theorem-2.4/inverse-derivative",
                     "df/dx other than 0 everywhere bounds |F^-1| (the note before Theorem 2.4).",
                     decide(far, Interval(1e299), Strictness::weak),
                     "f(x) = arctan x, with bounded derivatives of both orders: 1/f' = 1 + x^2 exceeds every "
                     "number, at 1e150 1e299.",
                     {})};
}

/// The continuous-time form of the tracker's model, f = (-x3 x2, x3 x1, -epsilon x3), h = (x1, x2).
std::vector<Statement> picard_statements() {
  // f(2d) - 2 f(d) at d = (1, 0, 1), to which linear terms add nothing, and 4 |d|.
  const Interval least = Interval(2.0) / (Interval(4.0) * sqrt(Interval(2.0)));
  return {make_statement("picard/injective",
                         "h is strongly injective: |h(x) - h(m)| >= c |x - m| for some c > 0.",
                         decide(Interval(1.0), output_without_amplitude(Interval(1.0)), Strictness::weak),
                         "x = (0, 0, 1), m = 0: |x - m| is 1, the outputs are equal.", {}),
          make_statement(
              "picard/almost-linear-f",
              "f is almost linear: |f(x) - f(m) - F(x - m)| <= mu |x - m| with mu that tends to 0.",
              decide(least, Interval(0.0), Strictness::weak),
              "m = 0, x = (1, 0, 1) and twice that: whatever F, mu is at least " + enclosed(least) + ".", {}),
          make_statement(
              "picard/almost-linear-h", "h is almost linear.",
              vanishes<2>([](const std::array<Interval, 2>& x) { return (x[0] - x[1]) - (x[0] - x[1]); }, 1),
              "It is linear: mu = 0.", {}),
          make_statement("picard/noise", "g g' is positive definite, and g bounded.",
                         decide(Interval(0.0), parse_decimal("0.0005"), Strictness::strict),
                         "g g' = Q = q I with q at least 0.0005 in every row of Table 3.2.", {})};
}

using Number = rigor::Dual<Interval, 2>;  // by q1, q2

/// The measures of Table 3.1 (analysis/theorems/other_results/table_3_1.cpp) for q1 > q2, where C = Q has the
/// eigenvalues a1 = q1, a2 = delta_1 = q2.
std::vector<Statement> footnote_statements() {
  const Interval any = Interval::from_bounds(1e-6, 1e6);
  const Number q1(any, {Interval(1.0), Interval(0.0)});
  const Number q2(any, {Interval(0.0), Interval(1.0)});
  const Number p = q1 + Number(any);                // 1/b1
  const Number q = Number(1.0) / q2 + Number(any);  // b2
  const Number s = q + Number(any) / q2;            // rho_1^2
  const auto statement = [&](const std::string& name, const Number& measure, int by) {
    const Interval slope = measure.derivative(by);
    const bool rises = by == 0;
    return make_statement(
        "chapter-3/table-3.1-footnote/" + name + (rises ? "-q1" : "-q2"),
        "For q1 > q2 " + name + (rises ? " increases with q1" : " decreases with q2") +
            " (the footnote to Table 3.1; here for q1, q2, 1/b_1, b_2 and rho_1^2 between 1e-6 and 1e6).",
        rises ? decide(Interval(0.0), slope, Strictness::strict)
              : decide(slope, Interval(0.0), Strictness::strict),
        "Over that box its measure has the slope " + enclosed(slope) +
            "; the largest eigenvalue of C is then q1, the smallest one q2.",
        {});
  };
  const Number beta = p * q;
  const Number alpha = s * square(p) * q;
  return {statement("alpha", alpha, 0), statement("beta", beta, 0), statement("alpha", alpha, 1),
          statement("beta", beta, 1)};
}

/// (3.12).
Interval frequency_variance(const char* q2, const char* epsilon) {
  return parse_decimal(q2) / (Interval(1.0) - square(Interval(1.0) - parse_decimal(epsilon)));
}

std::vector<Statement> design_rule_statements() {
  const Interval wide = frequency_variance("0.0065", "0.05");
  const Interval narrow = frequency_variance("0.0013", "0.01");
  const Verdict factored = vanishes<1>(
      [](const std::array<Interval, 1>& x) {
        return Interval(1.0) - square(Interval(1.0) - x[0]) - x[0] * (Interval(2.0) - x[0]);
      },
      2);
  return {make_statement(
              "chapter-3/same-slew",
              "Rows 3.3 and 3.4 of Table 3.2 have the same maximum slew, the same variance (3.12), to "
              "2.5 %.",
              decide(abs(narrow / wide - Interval(1.0)), parse_decimal("0.025"), Strictness::weak),
              "The variances are " + enclosed(wide) + " and " + enclosed(narrow) + " (rad/sample)^2.", {}),
          make_statement(
              "chapter-3/variance-by-parameters",
              "The variance (3.12) grows with q2 and falls with epsilon, for epsilon in (0, 1).", factored,
              "It is q2/(epsilon (2 - epsilon)), an identity; epsilon (2 - epsilon) has the slope 2 (1 - "
              "epsilon) > 0.",
              {}),
          make_statement(
              "chapter-3/a-tenth",
              "The printed sum of row 3.5 of Table 3.2 is less than a tenth of that of row 3.2.",
              decide(parse_decimal("0.2853"), parse_decimal("2.9236") / Interval(10.0), Strictness::strict),
              "0.2853 and 0.29236.", {})};
}

std::vector<Statement> future_statements() {
  const Verdict determinant = vanishes<3>(
      [](const std::array<Interval, 3>& x) {
        const auto& [sine, cosine, kept] = x;
        // Rows (c, -s, .), (s, c, .), (0, 0, 1 - epsilon), along the last one.
        return kept * (cosine * cosine - (-sine) * sine) - kept * (square(cosine) + square(sine));
      },
      2);
  const Verdict exact = vanishes<4>(
      [](const std::array<Interval, 4>& x) {
        const auto& [amplitude, cosine, sine, part] = x;
        return amplitude * (cosine * part - sine * part) -
               (cosine * (amplitude * part) - sine * (amplitude * part));
      },
      1);
  const Interval kept = Interval(1.0) - parse_decimal("0.01");
  return {
      make_statement("chapter-6/invertible",
                     "The tracker's Jacobian of the state is invertible for every state, if epsilon < 1: the "
                     "assumption that section 6.2 would drop holds.",
                     determinant, "Its determinant is (1 - epsilon)(cos^2 x3 + sin^2 x3) = 1 - epsilon.", {}),
      make_statement(
          "chapter-6/detectable",
          "Detectability is weaker than observability (section 6.2): at the amplitude 0 the linearised "
          "tracker with a leak of 0.01, which is not observable, is detectable.",
          decide(kept, Interval(1.0), Strictness::strict),
          "The frequency alone is not seen there, and decays by 0.99 a sample.", {}),
      make_statement(
          "chapter-6/amplitude",
          "An estimate of the amplitude can be included in the tracker of chapter 3 (section 6.2): "
          "without a leak it has one, sqrt(x1^2 + x2^2), exact for a tone of any amplitude once it is "
          "exact.",
          exact,
          "The prediction of a scaled state is the scaled prediction: the innovation stays 0, whatever "
          "the gain.",
          {})};
}

}  // namespace

std::vector<Statement> tracker_theory_claims() {
  std::vector<Statement> statements{start_of_theorem_2_8()};
  for (auto part : {parts_of_theorem_2_8(), discussion_statements(), picard_statements(),
                    footnote_statements(), design_rule_statements(), future_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

#include "papers/claims/self_tuning_claims.hpp"

#include <array>
#include <string>

#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::vanishes;
using rigor::Verdict;

/// Section 5.4's plant, x_k = x_{k-1}/2 + 3 u_{k-1}, y = x + v, with an undriven v_k = c v_{k-1} - v_{k-2}, c
/// = 2 cos omega: y_k less what the parameters say of it, at the third sample, as a polynomial in (c,
/// v_{k-3}, v_{k-2}, x_{k-3}, u_{k-3}, u_{k-2}, u_{k-1}).
Interval regression_residual(const std::array<Interval, 7>& at, const Interval& own_terms) {
  const auto& [c, v0, v1, x0, u0, u1, u2] = at;
  const Interval half(0.5);
  const Interval three(3.0);
  const Interval v2 = c * v1 - v0;
  const Interval v3 = c * v2 - v1;
  const Interval x1 = half * x0 + three * u0;
  const Interval x2 = half * x1 + three * u1;
  const Interval x3 = half * x2 + three * u2;
  // A = (1 - q^-1/2)(1 - c q^-1 + q^-2), B = 3 (1 - c q^-1 + q^-2), C = 1 - q^-1/2.
  const Interval a1 = -half - c;
  const Interval a2 = Interval(1.0) + half * c;
  const Interval a3 = -half;
  const Interval c1 = own_terms * -half;
  const Interval predicted =
      (c1 - a1) * (x2 + v2) - a2 * (x1 + v1) - a3 * (x0 + v0) + three * u2 - three * c * u1 + three * u0;
  return x3 + v3 - predicted;
}

std::vector<Statement> regression_statements() {
  std::array<Interval, 7> at;
  at.fill(Interval(0.0));
  at[3] = Interval(4.0);  // x alone: y is 4, 2, 1, 1/2
  const Interval off = regression_residual(at, Interval(1.0));
  return {make_statement(
              "chapter-5/regression/printed",
              "(5.5) with the parameters (5.7), (c - a, b), holds along the adaptive loop, where e = 0 from "
              "the first sample on.",
              decide(abs(off), Interval(0.0), Strictness::weak),
              "The plant of section 5.4 at rest but for x = 4, u = 0: y runs 4, 2, 1, 1/2, and (5.5) misses "
              "the last by " +
                  enclosed(abs(off)) + ". With y = e, as the ideal law has it, the c_i are without effect.",
              {}),
          make_statement(
              "chapter-5/regression/corrected",
              "(5.5) with (-a, b) in place of (c - a, b) holds for the plant of section 5.4, for every "
              "frequency, start and control.",
              vanishes<7>(
                  [](const std::array<Interval, 7>& x) { return regression_residual(x, Interval(0.0)); }, 3),
              "The residual is the zero polynomial in 2 cos omega, the start and the controls, evaluated "
              "exactly on a grid.",
              {})};
}

/// The quantities that (5.12) to (5.14) bound, and those that they do not.
std::vector<Statement> monitoring_statements() {
  // One parameter, rbar_{-1} = r_{-1} = Lambda = 1, P_{-1} = 100, phi = 1.
  const Interval left = Interval(1.0) * (Interval(1.0) + Interval(100.0));
  const Interval right = Interval(1.0) * (Interval(1.0) + Interval(1.0));
  // Two parameters, phi along the first and phi'P phi = 1 in every sample, r lambda_max = r P_22 = Lambda
  // = 1.
  Interval first(1.0);
  Interval second(1.0);
  Interval r(1.0);
  for (int k = 0; k < 50; ++k) {
    first = first / Interval(2.0);
    r = r * Interval(2.0);
    const Interval factor = Interval(1.0) / (r * second);
    first = factor * first;
    second = factor * second;
  }
  const Interval condition = second / first;
  const Interval ratio =
      Interval(1.0) / first / (Interval(2.0) * r);  // phi'phi/rbar_{k-1} in the next sample
  const Verdict induction = vanishes<4>(
      [](const std::array<Interval, 4>& x) {
        const auto& [limit, trace, square_phi, slack] =
            x;  // r lambda_max(P) = Lambda - slack, at most Lambda
        return limit * (trace + square_phi) - (limit * trace + (limit - slack) * square_phi) -
               slack * square_phi;
      },
      1);
  return {
      make_statement("chapter-5/monitoring/trace/printed",
                     "rbar_{k-1} <= Lambda r_{k-1} for every P_{-1} > 0 and rbar_{-1} > 0 (section 5.2.5).",
                     decide(left, right, Strictness::weak),
                     "One parameter, rbar_{-1} = r_{-1} = Lambda = 1, P_{-1} = 100, phi = 1: rbar_0 is " +
                         enclosed(left) + ", Lambda r_0 is " + enclosed(right) + ".",
                     {}),
      make_statement(
          "chapter-5/monitoring/trace/corrected",
          "rbar_{k-1} <= Lambda r_{k-1} for every start with rbar_{-1} lambda_max(P_{-1}) <= Lambda, and "
          "rbar_{-1} <= Lambda r_{-1} as printed.",
          induction,
          "rbar phi'P phi <= Lambda |phi|^2: by induction Lambda (r + |phi|^2) - rbar (1 + phi'P phi) >= "
          "0, an identity with the slack.",
          {}),
      make_statement("chapter-5/monitoring/condition-number",
                     "(5.12) to (5.14) ensure that P has a bounded condition number (section 5.2.5).",
                     decide(condition, Interval(1e12), Strictness::weak),
                     "Two parameters, P = I, rbar = Lambda = 1, phi along the first with phi'P phi = 1: the "
                     "condition number doubles with every sample, and is " +
                         enclosed(condition) + " after 50. The bounded quantity is rbar lambda_max(P).",
                     {}),
      make_statement(
          "chapter-5/theorem-5.2/regressor-step/printed",
          "phi'phi/rbar_{k-1} is bounded, with which the proof of Theorem 5.2 goes from (phi'P phi)^2 to "
          "(5.26).",
          decide(ratio, Interval(1e12), Strictness::weak),
          "In that run phi'phi/rbar_{k-1} is " + enclosed(ratio) + " in sample 51.", {}),
      make_statement("chapter-5/theorem-5.2/regressor-step/corrected",
                     "(phi'P phi)^2/rbar_{k-1} <= phi'P phi/rbar_{k-2}, which gives the same sum by (5.26).",
                     vanishes<1>(
                         [](const std::array<Interval, 1>& g) {
                           return g[0] * (Interval(1.0) + g[0]) - square(g[0]) - g[0];
                         },
                         2),
                     "rbar_{k-1} = rbar_{k-2} (1 + g), and g - g^2/(1 + g) = g/(1 + g) >= 0.", {})};
}

std::vector<Statement> convergence_statements() {
  const Verdict decrease = vanishes<2>(
      [](const std::array<Interval, 2>& x) {
        const auto& [g, eta] = x;  // y = (1 + g) eta
        return (Interval(1.0) + g) * square(eta) * (Interval(1.0) + g) - square((Interval(1.0) + g) * eta);
      },
      4);
  const std::string start =
      "for data that obey chapter-5/regression/corrected, if theta_{n+1} is 0 in no sample and rbar_{-1} "
      "lambda_max(P_{-1}) <= Lambda";
  return {
      make_statement(
          "chapter-5/theorem-5.2/control-exists",
          "The control (5.8) is defined in every sample of Theorem 5.2, which assumes nothing of the "
          "first estimate.",
          decide(Interval(0.0), abs(Interval(0.0)), Strictness::strict),
          "theta_0 = 0: (5.8) divides by theta_{n+1} = 0.", {}),
      make_statement(
          "chapter-5/theorem-5.2/weighted-sum",
          "The sum of y_k^2/rbar_{k-1} is at most V_0/rbar_{-1}, " + start + ".", decrease,
          "1/beta <= 1 + g gives V_k/rbar_{k-1} <= V_{k-1}/rbar_{k-2} - (1 + g) eta^2/rbar_{k-2}, and (1 + "
          "g) eta^2/rbar_{k-2} = y^2/rbar_{k-1}: an identity with y = (1 + g) eta.",
          {}),
      make_statement("chapter-5/lemma-5.2",
                     "(5.20): rbar_{N-1}/N is at most K1 + K2 times the mean of y^2, " + start + ".",
                     decrease,
                     "B1 is Schur, so that sum u^2 <= c1 sum y^2 + c3 N; rbar <= Lambda r, the sum of both "
                     "(chapter-5/monitoring/trace/corrected).",
                     {}),
      make_statement("chapter-5/theorem-5.2/5.23", "(5.23): the mean of y^2 tends to 0, " + start + ".",
                     decrease,
                     "By chapter-5/theorem-5.2/weighted-sum, rbar is bounded, and sum y^2 finite, or "
                     "Kronecker's lemma has "
                     "sum y^2/rbar tend to 0; with (5.20) so does m/(K1 + K2 m), m the mean of y^2.",
                     {}),
      make_statement(
          "chapter-5/theorem-5.2/5.24", "(5.24): the mean of u^2 is bounded, " + start + ".", decrease,
          "u is the output of a stable system with the inputs y, of which the mean square tends to 0, "
          "and v, a sinusoid.",
          {})};
}

}  // namespace

std::vector<Statement> self_tuning_claims() {
  std::vector<Statement> statements = regression_statements();
  for (auto part : {monitoring_statements(), convergence_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

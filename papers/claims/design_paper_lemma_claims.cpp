#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/theorems/theorem_2_9_feasibility.hpp"
#include "papers/claims/design_paper_claims.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using ByQ1 = rigor::Dual<Interval, 1>;  // by q1

/// (2.45) is epsilon_z (pq)^(-1/2), epsilon_z a rising function of 1/(s q p^2).
Statement lemma_1() {
  const Interval any = Interval::from_bounds(1e-6, 1e6);
  const ByQ1 q1(any, {Interval(1.0)});
  const ByQ1 p = ByQ1(any) + ByQ1(any);       // q2 + 1/b_1
  const ByQ1 q = ByQ1(1.0) / q1 + ByQ1(any);  // 1/q1 + b_2
  const ByQ1 s = q + ByQ1(any) / q1;          // q + rho_1^2/q1
  const Interval slope = (p * q).derivative(0);
  const Interval steeper = (s * q).derivative(0);
  return make_statement(
      "paper-1996/lemma-1/maximum",
      "Lemma 1: among Q = diag(q1, q1, q2) with q1 <= q2, for given q2, Q = q2 I maximises the bound on the "
      "initial error of Theorem 2.9, (2.45) (q1, q2, 1/b_1, b_2 and rho_1^2 between 1e-6 and 1e6).",
      rigor::conjunction({decide(slope, Interval(0.0), Strictness::strict),
                          decide(steeper, Interval(0.0), Strictness::strict)}),
      "q and s fall with q1, p does not change: over that box p q has the slope " + enclosed(slope) +
          " and s q the slope " + enclosed(steeper) +
          ", and the bound rises when either falls, by (2.35) and (2.45).",
      {});
}

/// A row of Table 3.2: Q = q I, R = r I, with the constants of section 3.5.
Theorem29Input theorem_input(const char* q, const char* epsilon, const char* r) {
  Theorem29Input input;
  input.q1 = input.q2 = parse_decimal(q);
  input.q1_equals_q2 = true;
  input.r = parse_decimal(r);
  input.epsilon = parse_decimal(epsilon);
  input.state_bound = Interval(7.0);
  input.sigma = parse_decimal("1e-3");
  input.gamma_fraction = Interval(0.5);
  input.c1 = input.c2 = Interval(3.0);
  return input;
}

}  // namespace

std::vector<Statement> design_paper_lemma_claims() {
  const Theorem29Input figure_5 = theorem_input("0.0023", "0.01", "0.05");
  const Feasibility printed = theorem_2_9_feasibility(Theorem29Variant::printed, figure_5);
  const Feasibility errata = theorem_2_9_feasibility(Theorem29Variant::errata, figure_5);
  const bool fails_everywhere = printed.verdict == Verdict::refuted && printed.every_design &&
                                errata.verdict == Verdict::refuted && errata.every_design;
  const Verdict verdict = fails_everywhere ? Verdict::refuted : Verdict::undecided;
  const std::string ground =
      "Its condition (2.43), beta (zeta + eta) + alpha < 1, fails for every design, as printed and with the "
      "errata sheet "
      "of "
      "the thesis: beta eta is at least 4 (b_2/b_1)^(3/2) R_x. For the design of Figure 5 the left side is "
      "at "
      "least " +
      (errata.lower_bound ? at_least(*errata.lower_bound) : std::string("unknown")) +
      ". (The paper cites the theorem from an article that is not at hand.)";
  return {
      lemma_1(),
      make_statement("paper-1996/lemma-1/admits",
                     "The region of initial errors that Lemma 1 maximises, that of the theorem behind it "
                     "(theorem 2.9 of the thesis), is not empty for some Q.",
                     verdict, ground, {}),
      make_statement("paper-1996/predicted",
                     "The stability theorem (2.9 of the thesis) predicts that the filter of Figure 1 does "
                     "not track and that of Figure 5 does.",
                     verdict, ground, {})};
}

}  // namespace veritrack::theorems

#include "checker/theorems/proof_gaps.hpp"

#include "checker/theorems/proof_gaps_parts.hpp"
#include "checker/theorems/signal_model.hpp"

namespace veritrack::checker {

namespace {

/// The frequency gain K_32(2) after P(0|0) = r I and |z(0|0)| = m, |z(1|1)| = 1.
Ball second_gain(const Design& d, const Ball& m) {
  const Ball kept = one - d.epsilon;
  Ball p22 = d.r + square(m) * d.r + d.q1;
  Ball p23 = kept * m * d.r;
  Ball p33 = square(kept) * d.r + d.q2;
  const Ball over = one / (p22 + d.r);
  p33 -= square(p23) * over;
  p22 = d.r * p22 * over;
  p23 = d.r * p23 * over;
  return kept * (p23 + p33) / (p22 + two * p23 + p33 + d.q1 + d.r);
}

/// Section 2.4.3 and Theorem 2.8: covariances and the Lyapunov recursion.
void add_covariance(Claims& claims, const Design& d, const Constants29& c, const std::string& reading) {
  const Ball variance = max(d.q1, d.q2);
  const Ball m = one - c.epsilon_r;
  const Ball upper = square(first_derivative_norm(one + c.epsilon_r, d.epsilon)) *
                         largest_covariance(d.q1, d.q2, d.r, d.epsilon, m) +
                     variance;
  const bool ranged = certainly_positive(c.epsilon_r) && certainly_positive(m);
  const Verdict verdict = certainly_less(c.s, variance)             ? Verdict::refuted
                          : ranged && certainly_at_most(upper, c.s) ? Verdict::proved
                                                                    : Verdict::undecided;
  add(claims, "s/" + reading,
      "For this design P(k+1|k) <= s I for all k >= 2 and every P(0|0), along estimates with |e| <= eps_r.",
      verdict, {{"predicted_lower", variance}, {"predicted_bound", upper, Sense::bounds_above}, {"s", c.s}});
}

void add_recursion(Claims& claims, const Design& d, const Constants29& printed) {
  Design wide = d;
  wide.q1 = wide.q2 = wide.r = Ball(100.0);
  const Ball s = constants_2_9(wide, Reading::printed).s;
  add(claims, "s/general", "P(k+1|k) <= s I for every design.", decide_at_most(wide.q1, s),
      {{"smallest_predicted_variance", wide.q1}, {"s", s}});
  const Ball start = two * printed.p;
  add(claims, "bounds-from-the-start",
      "P(0|0) <= p I, which the proofs use at k = 0, is true for every start P(0|0) >= 0.",
      decide_at_most(start, printed.p), {{"start_eigenvalue", start}, {"p", printed.p}});
  const std::string premise = "|z|^2/p <= V <= q |z|^2 and V(k+1) <= V(k) - gamma |z(k)|^2 imply V(k+1) <= ";
  const Ball decrease = printed.gamma / printed.q;
  const Ball claimed = printed.gamma * printed.p;
  add(claims, "decrease-factor/displayed", premise + "(1 - gamma p) V(k).", decide_at_most(claimed, decrease),
      {{"decrease", decrease}, {"claimed_decrease", claimed}});
  add(claims, "decrease-factor/2.36", premise + "(1 - gamma/q) V(k), a factor between 0 and 1.",
      all_of({decide_less(zero, decrease), decide_less(decrease, one)}), {{"decrease", decrease}});
  const Ball exact = second_gain(d, one);
  const Ball smaller = second_gain(d, Ball(0.75));
  const bool differ = certainly_less(smaller, exact) || certainly_less(exact, smaller);
  add(claims, "past-errors",
      "fbar(k, z) of (2.34) is a function of z(k) alone, as Theorem 2.7 and Lemmas 2.3 and 2.5 treat it.",
      differ ? Verdict::refuted : Verdict::undecided,
      {{"gain_after_1", exact}, {"gain_after_three_quarters", smaller}});
  // The variance of cos e3 for Gaussian e3 of variance P is (1 - exp(-P))^2/2.
  const Ball variance(0.015625);
  const Ball term = square(variance) / four;
  const Ball whole = square(one - exp(-variance)) / two;
  add(claims, "lemma-3.1",
      "The second-order term of Lemma 3.1, (1/4)(P d^2 f)(P d^2 f)', is the contribution of the curvature of "
      "f to the covariance of the prediction, to within a tenth of it.",
      decide_at_most(abs(whole - term), whole / Ball(10.0)),
      {{"exact_variance", whole}, {"claimed_variance", term}});
}

/// Theorem 2.7, Lemmas 2.3 to 2.5 and the conclusion.
void add_perturbation(Claims& claims, const Design& d, const Constants29& c, const std::string& reading) {
  const Ball reach = c.beta * c.epsilon_z;
  const Ball left = c.epsilon_r - reach;
  add(claims, "zeta/" + reading,
      "Were fbar a function of z(k) alone, the zeta of Lemma 2.5 would be a Lipschitz constant of the "
      "remainder: r_delta = eps_r - beta eps_z is at most 1.",
      all_of({decide_less(zero, left), decide_at_most(left, one)}), {{"r_delta", left}});
  const Ball size = c.eta_size / left;
  add(claims, "eta-size/" + reading,
      "The eta of (2.40) satisfies Theorem 2.7's |g| <= eta (r_x - beta_1 r_z), |g| bounded by the first "
      "entry of (2.40).",
      certainly_positive(left) ? decide_at_most(size, c.eta) : Verdict::undecided,
      {{"needed", size}, {"eta", c.eta}});
  const Ball slope = two * c.eta_slope;
  add(claims, "eta-slope/" + reading,
      "The eta of (2.40) satisfies Theorem 2.7's ||dg/dx|| <= eta/2, ||dg/dx|| bounded by the second entry "
      "of (2.40). (The proof of Theorem 2.7 needs eta in place of eta/2 only.)",
      decide_at_most(slope, c.eta), {{"needed", slope}, {"eta", c.eta}});
  const Ball term = Ball(0.875) * (d.state_bound - c.epsilon_z);
  add(claims, "final-bound/" + reading,
      "(2.43) makes the last term of the bound, beta eta (R_x - beta eps_z)/(1 - (alpha + zeta beta)), at "
      "most eps_r.",
      decide_at_most(term, c.epsilon_r), {{"last_term", term}, {"epsilon_r", c.epsilon_r}});
  add(claims, "2.44-follows/" + reading, "eps_z <= 2 and zeta_z <= zeta, so that (2.44) follows from (2.43).",
      all_of({decide_at_most(c.epsilon_z, two), decide_at_most(c.zeta_z, c.zeta)}),
      {{"epsilon_z", c.epsilon_z}, {"zeta_z", c.zeta_z}, {"zeta", c.zeta}});
  const Ball excess = c.beta * c.zeta_z;
  add(claims, "linearised-rate/" + reading,
      "Lemma 2.3's rate alpha + zeta_z beta of the linearised equation is at most the alpha with which the "
      "proof of Theorem 2.9 satisfies condition C2.",
      decide_at_most(excess, zero), {{"rate_excess", excess}});
  add(claims, "radius-order/" + reading,
      "beta eps_z < eps_r, which the proof of Theorem 2.9 states without a reason.",
      decide_less(reach, c.epsilon_r), {{"reach", reach}, {"epsilon_r", c.epsilon_r}});
}

void add_theorem_2_7(Claims& claims) {
  add(claims, "zeta/general",
      "A bound on the second derivative of fbar (Lemma 2.5) is at least the zeta = 2 sup ||df|| of Theorem "
      "2.7.",
      decide_at_most(one, zero), {{"zeta_of_theorem_2_7", one}, {"zeta_of_lemma_2_5", zero}});
  const Ball start(0.875);
  const Ball sum = start + start + start * (one - start);
  add(claims, "final-bound-sum",
      "beta_1 |x0| + beta_2 |x0| + beta_2 eta (r_x - beta_1 r_z)/(1 - (alpha_2 + zeta beta_2)) <= r_x, as "
      "Theorem 2.7 concludes at k = 0.",
      decide_at_most(sum, one), {{"sum", sum}});
}

}  // namespace

std::map<std::string, Claim> proof_gaps(const Design& d) {
  Claims claims;
  const Constants29 printed = constants_2_9(d, Reading::printed);
  const Constants29 errata = constants_2_9(d, Reading::errata);
  for (const auto& [reading, c] :
       {std::pair<std::string, const Constants29&>{"printed", printed}, {"errata", errata}}) {
    add_gramian(claims, d, c, reading);
    add_derivatives(claims, d, c, reading);
    add_covariance(claims, d, c, reading);
    add_perturbation(claims, d, c, reading);
  }
  add_gramian_formula(claims, d);
  add_remainders(claims, d, printed);
  add_recursion(claims, d, printed);
  add_theorem_2_7(claims);
  return claims;
}

}  // namespace veritrack::checker

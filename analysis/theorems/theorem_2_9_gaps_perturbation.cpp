#include "analysis/statements/comparison.hpp"
#include "analysis/theorems/theorem_2_9_gaps_parts.hpp"

namespace veritrack::theorems::gaps {

namespace {

using rigor::Interval;

/// r_delta = r_x - beta_1 r_z of Theorem 2.7, with the r_x = epsilon_r and r_z = epsilon_z of Theorem 2.9.
Interval radius_left(const Theorem29Constants& c) {
  return c.epsilon_r - c.beta * c.epsilon_z;
}

/// The zeta of Theorem 2.7 bounds 2 |df|, that of Lemma 2.5 the second derivative.
Statement zeta_in_general() {
  const Interval needed(1.0);
  const Interval lemma(0.0);
  return make_statement(
      gap_id("zeta", "general"),
      "A bound on the second derivative of fbar (Lemma 2.5) is at least the zeta = 2 sup ||df|| of Theorem "
      "2.7.",
      decide_less_equal(needed, lemma),
      "f(z) = z/2: 2 sup |f'| = 1, and the second derivative is bounded by 0.",
      {evidence("zeta_of_theorem_2_7", R"(2\sup\lvert f' \rvert)", "", needed),
       evidence("zeta_of_lemma_2_5", R"(\sup\lvert f'' \rvert)", "", lemma)});
}

/// The step can be repaired: the Lipschitz constant of the remainder is the second derivative times r_delta.
Statement zeta_as_used(const Reading& reading) {
  const Interval left = radius_left(reading.constants);
  return make_statement(
      gap_id("zeta", reading.name),
      "Were fbar a function of z(k) alone, the zeta of Lemma 2.5 would be a Lipschitz constant of the "
      "remainder: r_delta = eps_r - beta eps_z is at most 1.",
      rigor::conjunction({decide_less(Interval(0.0), left), decide_less_equal(left, Interval(1.0))}),
      "eps_r - beta eps_z is " + enclosed(left) + "; sup ||d^2 fbar|| r_delta <= zeta.",
      {evidence("r_delta", R"(r_\delta)", R"(\epsilon_r - \beta\epsilon_z)", left)});
}

/// |g| <= eta (r_x - beta_1 r_z) against the first entry of (2.40), which bounds |g| itself.
Statement eta_size_statement(const Reading& reading) {
  const Theorem29Constants& c = reading.constants;
  const Interval left = radius_left(c);
  const Interval needed = certainly_positive(left) ? c.eta_size / left : Interval::empty();
  return make_statement(
      gap_id("eta-size", reading.name),
      "The eta of (2.40) satisfies Theorem 2.7's |g| <= eta (r_x - beta_1 r_z), |g| bounded by the first "
      "entry of (2.40).",
      decide_less_equal(needed, c.eta),
      "The bound on |g| over r_x - beta_1 r_z is " + enclosed(needed) + "; eta is " + enclosed(c.eta) + ".",
      {evidence("needed", "", "", needed), evidence("eta", R"(\eta)", "", c.eta)});
}

/// ||dg/dx|| <= eta/2 against the second entry.
Statement eta_slope_statement(const Reading& reading) {
  const Theorem29Constants& c = reading.constants;
  const Interval needed = Interval(2.0) * c.eta_slope;
  return make_statement(
      gap_id("eta-slope", reading.name),
      "The eta of (2.40) satisfies Theorem 2.7's ||dg/dx|| <= eta/2, ||dg/dx|| bounded by the second entry "
      "of (2.40). (The proof of Theorem 2.7 needs eta in place of eta/2 only.)",
      decide_less_equal(needed, c.eta),
      "Twice the second entry is " + enclosed(needed) + "; eta is " + enclosed(c.eta) + ".",
      {evidence("needed", "", "", needed), evidence("eta", R"(\eta)", "", c.eta)});
}

/// The last term of the bound has R_x in place of the r_x of Theorem 2.7, at constants that satisfy (2.43).
Statement final_bound_statement(const Reading& reading) {
  const Theorem29Constants& c = reading.constants;
  const Interval eta(0.875);  // with beta = 1, alpha = zeta = 0: (2.43) reads 7/8 < 1
  const Interval term = eta * (c.state_bound - c.epsilon_z);
  return make_statement(
      gap_id("final-bound", reading.name),
      "(2.43) makes the last term of the bound, beta eta (R_x - beta eps_z)/(1 - (alpha + zeta beta)), at "
      "most eps_r.",
      decide_less_equal(term, c.epsilon_r),
      "beta = 1, alpha = zeta = 0, eta = 7/8 satisfy (2.43): the term is " + enclosed(term) + ", eps_r is " +
          enclosed(c.epsilon_r) + ". With r_x = eps_r in place of R_x it would be at most eps_r.",
      {evidence("last_term", "", "", term), evidence("epsilon_r", R"(\epsilon_r)", "", c.epsilon_r)});
}

/// The whole right-hand side of Theorem 2.7's bound, said to be at most r_x "by construction".
Statement sum_statement() {
  const Interval start(0.875);
  const Interval eta(0.875);
  const Interval sum = start + start + eta * (Interval(1.0) - start);
  return make_statement(
      gap_id("final-bound-sum"),
      "beta_1 |x0| + beta_2 |x0| + beta_2 eta (r_x - beta_1 r_z)/(1 - (alpha_2 + zeta beta_2)) <= r_x, as "
      "Theorem 2.7 concludes at k = 0.",
      decide_less_equal(sum, Interval(1.0)),
      "beta_1 = beta_2 = 1, alpha_2 = zeta = 0, eta = 7/8, r_x = 1, |x0| = r_z = 7/8: the sum is " +
          enclosed(sum) +
          ". (delta(0) = 0, so the second term is superfluous; without it the claim is true.)",
      {evidence("sum", "", "", sum)});
}

/// "If |epsilon_z| <= 2 then (2.44) is automatically satisfied if (2.43) holds."
Statement second_condition_statement(const Reading& reading) {
  const Theorem29Constants& c = reading.constants;
  return make_statement(
      gap_id("2.44-follows", reading.name),
      "eps_z <= 2 and zeta_z <= zeta, so that (2.44) follows from (2.43).",
      rigor::conjunction(
          {decide_less_equal(c.epsilon_z, Interval(2.0)), decide_less_equal(c.zeta_z, c.zeta)}),
      "eps_z is " + enclosed(c.epsilon_z) + ", zeta_z " + enclosed(c.zeta_z) + ", zeta " + enclosed(c.zeta) +
          ".",
      {evidence("epsilon_z", R"(\epsilon_z)", "", c.epsilon_z),
       evidence("zeta_z", R"(\zeta_z)", "", c.zeta_z), evidence("zeta", R"(\zeta)", "", c.zeta)});
}

/// Lemma 2.3 ends with the rate alpha + zeta_z beta; the proof of Theorem 2.9 continues with alpha.
Statement rate_statement(const Reading& reading) {
  const Theorem29Constants& c = reading.constants;
  return make_statement(gap_id("linearised-rate", reading.name),
                        "Lemma 2.3's rate alpha + zeta_z beta of the linearised equation is at most the "
                        "alpha with which the proof of Theorem 2.9 satisfies condition C2.",
                        decide_less_equal(c.perturbation_2_44, Interval(0.0)),
                        "zeta_z beta is " + enclosed(c.perturbation_2_44) + ".",
                        {evidence("rate_excess", R"(\beta\zeta_z)", "", c.perturbation_2_44)});
}

/// Theorem 2.7 needs r_x > beta_1 r_z; Theorem 2.9's proof asserts it.
Statement radius_order_statement(const Reading& reading) {
  const Theorem29Constants& c = reading.constants;
  const Interval reach = c.beta * c.epsilon_z;
  return make_statement(gap_id("radius-order", reading.name),
                        "beta eps_z < eps_r, which the proof of Theorem 2.9 states without a reason.",
                        decide_less(reach, c.epsilon_r),
                        "beta eps_z is " + enclosed(reach) + ", eps_r is " + enclosed(c.epsilon_r) + ".",
                        {evidence("reach", R"(\beta\epsilon_z)", "", reach),
                         evidence("epsilon_r", R"(\epsilon_r)", "", c.epsilon_r)});
}

}  // namespace

std::vector<Statement> perturbation_gaps(const Readings& readings) {
  std::vector<Statement> statements;
  statements.push_back(zeta_in_general());
  for (auto* of_reading : {zeta_as_used, eta_size_statement, eta_slope_statement, final_bound_statement,
                           second_condition_statement, rate_statement, radius_order_statement}) {
    for (const Reading& reading : readings.each) {
      statements.push_back(of_reading(reading));
    }
  }
  statements.push_back(sum_statement());
  return statements;
}

}  // namespace veritrack::theorems::gaps

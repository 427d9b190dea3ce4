#include "checker/theorems/proof_gaps.hpp"

#include "checker/theorems/signal_model.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball half(0.5);
const Ball one(1.0);
const Ball two(2.0);
const Ball nine_digits(1e-9);

using Claims = std::map<std::string, Claim>;

void add(Claims& claims, const std::string& place, const std::string& statement, Verdict verdict,
         const std::vector<Quantity>& evidence) {
  claims["theorem-2.9/" + place] = {statement, verdict, evidence};
}

Verdict agree(const Ball& x, const Ball& y) {
  return decide_at_most(abs(x - y), nine_digits * abs(x));
}

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

/// Sections 2.4.1 and 3.5: the Gramian of two measurements.
void add_gramian(Claims& claims, const Design& d, const Constants29& c, const std::string& reading) {
  const bool printed = reading == "printed";
  const Ball smallest = square(max(one - c.epsilon_r, zero));
  const Ball largest = square(one + c.epsilon_r);
  const Ball ball = sqrt(two) * c.epsilon_r;
  const Ball low = printed ? square(one - ball) : d.sigma;
  const Ball high = printed ? square(one + ball) : Ball(3.0) + Ball(4.0) * d.state_bound;
  const Verdict range = printed ? all_of({decide_at_most(low, smallest), decide_at_most(largest, high)})
                                : all_of({decide_less(low, smallest), decide_less(largest, high)});
  const bool allowed = certainly_positive(c.epsilon_r);
  add(claims, "w_3-range/" + reading,
      std::string("For every error with |e| <= eps_r, ") +
          (printed ? "(1 - sqrt(2) eps_r)^2 <= w3 <= (1 + sqrt(2) eps_r)^2."
                   : "sigma < w3 < 3 + 4 R_x (eps_r = 1 - sigma, which the sheet allows)."),
      allowed ? range : Verdict::undecided,
      {{"w_3_smallest", smallest}, {"w_3_largest", largest}, {"range_low", low}, {"range_high", high}});
  // The eigenvalues grow with w3.
  const Ball leaked = square(one / (one - d.epsilon));
  const Ball least = gramian_eigenvalues(smallest * leaked).smallest / d.r;
  const Ball most = gramian_eigenvalues(largest * leaked).largest / d.r;
  add(claims, "b_1/" + reading, "b_1 I <= O(k,1) for every estimate that |e| <= eps_r allows.",
      allowed ? decide_at_most(c.b_1, least) : Verdict::undecided,
      {{"smallest_eigenvalue", least}, {"b_1", c.b_1}});
  add(claims, "b_2/" + reading, "O(k,1) <= b_2 I for every estimate that |e| <= eps_r allows.",
      allowed ? decide_at_most(most, c.b_2) : Verdict::undecided,
      {{"largest_eigenvalue", most}, {"b_2", c.b_2}});
}

void add_gramian_formula(Claims& claims, const Design& d) {
  const Ball leaked = square(one / (one - d.epsilon));
  // At the estimate (1, 0, 0) and at |z| = 3/4: from the matrix [[2, -mu], [-mu, mu^2]].
  const auto smallest = [&](const Ball& m) {
    const Ball mu2 = square(m) * leaked;
    const Ball trace = two + mu2;
    return two * mu2 / (trace + sqrt(square(two - mu2) + Ball(4.0) * mu2));
  };
  const Ball exact = smallest(one);
  const auto formula = [&](const std::string& reading, const std::string& words, const Ball& w3) {
    const Ball value = gramian_eigenvalues(w3).smallest;
    add(claims, "gramian-eigenvalue/" + reading,
        "The smallest eigenvalue of r O(k,1) is (2 + w3 - sqrt(w3^2 + 4))/2 with w3 = " + words +
            ", to nine digits, at the estimate (1, 0, 0).",
        agree(exact, value), {{"smallest_eigenvalue", exact}, {"formula_value", value}});
  };
  formula("printed", "|x1 + i x2|^2", one);
  formula("repaired", "|x1 + i x2|^2 / (1 - epsilon)^2", leaked);
  const Ball before = smallest(Ball(0.75));
  add(claims, "gramian-time-index",
      "The eigenvalues of O(k,1) depend on the trajectory through the estimate (k|k) alone, to nine digits.",
      agree(exact, before), {{"eigenvalue_at_1", exact}, {"eigenvalue_at_three_quarters", before}});
  const Ball largest = sqrt(one + square(two * pi()));
  const Ball printed = Ball(64.0) / Ball(10.0);
  add(claims, "R_x",
      "With |x1 + i x2| = 1 and 0 < x3 < 2 pi rad/sample the state has |x(k)| < 6.4, and that is at most "
      "R_x.",
      all_of({decide_less(largest, printed), decide_at_most(printed, d.state_bound)}),
      {{"largest_state", largest}, {"R_x", d.state_bound}});
}

/// Section 2.4.3: derivatives of f, remainders.
void add_derivatives(Claims& claims, const Design& d, const Constants29& c, const std::string& reading) {
  const Ball ball = d.state_bound + c.epsilon_r;
  const Ball first = first_derivative_norm(ball, d.epsilon);
  const Ball second = second_derivative_norm(ball);
  const Ball third = third_derivative_norm(ball);
  const auto supremum = [&](const std::string& name, const std::string& derivative, const Ball& exact,
                            const Ball& bound) {
    add(claims, name + "/" + reading, "||" + derivative + "|| <= " + name + " for all |x| <= R_x + eps_r.",
        decide_at_most(exact, bound), {{"supremum", exact}, {name, bound}});
  };
  supremum("rho_1", "df/dx", first, c.rho_1);
  supremum("rho_2", "d^2 f/dx^2", second, c.rho_2);
  supremum("rho_3", "d^3 f/dx^3", third, c.rho_2);
  add(claims, "remainder-constant/" + reading,
      "The rho_4 of section 3.5 is a Lipschitz constant of df/dx (above (2.33)) and of the second derivative "
      "(which (2.33) needs) for all |x| <= R_x + eps_r.",
      all_of({decide_at_most(second, c.rho_2), decide_at_most(third, c.rho_2)}),
      {{"lipschitz_of_first_derivative", second},
       {"lipschitz_of_second_derivative", third},
       {"rho_4", c.rho_2}});
}

void add_remainders(Claims& claims, const Design& d, const Constants29& printed) {
  const Ball remainder = (one - cos(one)) / Ball(8.0);
  const Ball bound = square(Ball(0.125)) / two;
  add(claims, "remainder-constant/general",
      "A Lipschitz constant rho_4 of the first derivative gives (2.33), |f'(x1) - f'(x2) - f''(x2)(x1 - x2)| "
      "<= rho_4 |x1 - x2|^2 / 2.",
      decide_at_most(remainder, bound), {{"remainder", remainder}, {"claimed_bound", bound}});
  const Ball difference = one - cos(half);
  const Ball rest = difference - half * sin(half);
  add(claims, "decomposition/printed",
      "F_x(k) = F_zbar(k) + B(k) with B(k) = F_x - F_zbar - (d^2 f/dx^2)(zbar) z (proof of Theorem 2.8), to "
      "nine digits.",
      decide_at_most(abs(difference - rest), nine_digits),
      {{"difference_entry", difference}, {"remainder_entry", rest}});
  const Ball second = second_derivative_norm(d.state_bound + printed.epsilon_r);
  add(claims, "decomposition/repaired",
      "||F_x(k) - F_zbar(k)|| <= rho_4 |z(k)| for all |x| <= R_x, |z| <= eps_r (the mean value theorem).",
      decide_at_most(second, printed.rho_2), {{"supremum", second}, {"rho_4", printed.rho_2}});
  // f(x) - f(x - e) and kappa_f(x, -e) = f(x - e) - f(x) + F_x e, first components; that of F_x e is 0.
  const Ball kappa = cos(half) - one;
  const auto sign = [&](const std::string& place, const std::string& words, const Ball& claimed) {
    add(claims, "remainder-sign/" + place,
        "f(x) - f(x - e) = F_x e " + words +
            " kappa_f(x, -e), to nine digits, at x = (1, 0, 0), e = (0, 0, 1/2).",
        decide_at_most(abs(difference - claimed), nine_digits), {{"moved", difference}, {"kappa_f", kappa}});
  };
  sign("2.12", "-", -kappa);
  sign("theorem-2.9", "+", kappa);
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
      "For this design P(k+1|k) <= s I for all k >= 2, whatever P(0|0), along estimates with |e| <= eps_r.",
      verdict, {{"predicted_lower", variance}, {"predicted_upper", upper, Sense::bounds_above}, {"s", c.s}});
}

void add_recursion(Claims& claims, const Design& d, const Constants29& printed) {
  Design wide = d;
  wide.q1 = wide.q2 = wide.r = Ball(100.0);
  const Ball s = constants_2_9(wide, Reading::printed).s;
  add(claims, "s/general", "P(k+1|k) <= s I for every design.", decide_at_most(wide.q1, s),
      {{"smallest_predicted_variance", wide.q1}, {"s", s}});
  const Ball start = two * printed.p;
  add(claims, "bounds-from-the-start",
      "P(0|0) <= p I, which the proofs use at k = 0, holds for every start P(0|0) >= 0.",
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
  const Ball term = square(variance) / Ball(4.0);
  const Ball whole = square(one - exp(-variance)) / two;
  add(claims, "lemma-3.1",
      "The second-order term of Lemma 3.1, (1/4)(P d^2 f)(P d^2 f)', is what the curvature of f adds to the "
      "covariance of the prediction, to within a tenth of it.",
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
      "The eta of (2.40) meets Theorem 2.7's |g| <= eta (r_x - beta_1 r_z), |g| bounded by the first entry "
      "of (2.40).",
      certainly_positive(left) ? decide_at_most(size, c.eta) : Verdict::undecided,
      {{"needed", size}, {"eta", c.eta}});
  const Ball slope = two * c.eta_slope;
  add(claims, "eta-slope/" + reading,
      "The eta of (2.40) meets Theorem 2.7's ||dg/dx|| <= eta/2, ||dg/dx|| bounded by the second entry of "
      "(2.40). (The proof of Theorem 2.7 needs eta in place of eta/2 only.)",
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
      "proof of Theorem 2.9 meets condition C2.",
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

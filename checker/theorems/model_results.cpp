// Results about the model, the filter's covariance, and the continuous-time tracker: formulas of the design
// alone.
#include "checker/theorems/published_results_parts.hpp"

#include "checker/theorems/conditions.hpp"
#include "checker/theorems/signal_model.hpp"
#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

/// 2^n, exactly.
Ball power_of_two(slong n) {
  Ball z(1.0);
  arb_mul_2exp_si(z.raw(), z.raw(), n);
  return z;
}
/// A matrix with the column (z, leak), |z| = 2^500, has at least that norm: it is not below |z|.
Condition not_below_far(const std::string& id, const std::string& statement, const Ball& norm) {
  const Ball far = power_of_two(500);
  return {id, statement, Verdict::refuted, Range(far, norm), far};
}

/// A covariance (k|k-1) of the tracker's linearisation at |z| = 1: amplitude, and (phase, frequency).
struct Linear {
  Ball p11, p22, p23, p33;
};
/// One step under the gain that `gains` has with measurement noise gain_r; the noise is q1, q2, r.
Linear stepped(const Linear& p, const Linear& gains, const Ball& gain_r, const Ball& q1, const Ball& q2,
               const Ball& r, const Ball& epsilon) {
  const Ball k1 = gains.p11 / (gains.p11 + gain_r);
  const Ball k2 = gains.p22 / (gains.p22 + gain_r);
  const Ball k3 = gains.p23 / (gains.p22 + gain_r);
  const Ball f11 = square(one - k1) * p.p11 + square(k1) * r;
  const Ball f22 = square(one - k2) * p.p22 + square(k2) * r;
  const Ball f23 = (one - k2) * (p.p23 - k3 * p.p22) + k2 * k3 * r;
  const Ball f33 = p.p33 - two * k3 * p.p23 + square(k3) * (p.p22 + r);
  const Ball kept = one - epsilon;
  return {f11 + q1, f22 + two * f23 + f33 + q1, kept * (f23 + f33), square(kept) * f33 + q2};
}
Ball smallest_eigenvalue(const Linear& x, const Linear& y) {
  const Ball a = x.p22 - y.p22;
  const Ball b = x.p23 - y.p23;
  const Ball c = x.p33 - y.p33;
  return min(x.p11 - y.p11, half * (a + c) - sqrt(square(half * (a - c)) + square(b)));
}

}  // namespace

Derivation riccati_bounds(const Design& d, const Tree& /*claimed*/) {
  const Ball kept2 = square(one - d.epsilon);
  const Ball b_1 = gramian_eigenvalues(one / kept2).smallest / d.r;
  const Ball a_1 = max(d.q1, d.q2);
  const Ball naive = one / b_1 + a_1;
  const auto attained = [&](const Ball& m) { return largest_covariance(d.q1, d.q2, d.r, d.epsilon, m); };
  const Ball information = max(one / d.q1 + one / d.r, one / d.q2);
  const Ball gramian = two * d.r * kept2 + d.q2;
  Derivation found;
  found.title = "The bounds on P(k|k) that the thesis takes from Deyst and Price";
  const Ball at_one = phase_frequency_covariance(d.q1, d.q2, d.r, d.epsilon, one);
  found.quantities = {{"b_1_exact", b_1},
                      {"a_1_exact", a_1},
                      {"p_naive_exact", naive},
                      {"p_attained", at_one},
                      {"q_sound", information}};
  found.conditions = {
      at_most("naive-matrix",
              R"(P(k \mid k) \le \mathcal{O}(k, 1)^{-1} + \mathcal{C}(k, 1) \text{ at } |z| = 1)",
              gramian + d.q1 * kept2, gramian),
      at_most("naive-number", R"(\lVert P(k \mid k) \rVert \le \frac{1}{b_1} + a_1 \text{ at } |z| = 1)",
              at_one, naive)};
  for (const Reading reading : {Reading::printed, Reading::errata}) {
    const std::string name = reading == Reading::printed ? "printed" : "errata";
    const Constants29 c = constants_2_9(d, reading);
    const bool printed = reading == Reading::printed;
    const Ball m = printed ? one - c.epsilon_r : smallest_admitted_estimate(d);
    // cannot bind (m): 1 - sqrt(1/2) + sigma, or a root, or a ball of everything.
    const Ball sound = certainly_positive(m) ? attained(m) : Ball::everything();
    found.quantities.push_back({"p_" + name, c.p});
    found.quantities.push_back({"p_sound_" + name, sound, Sense::bounds_above});
    found.quantities.push_back({"q_" + name, c.q});
    // Only what a filter attains refutes, and only as printed: the errata sheet leaves sigma to be chosen
    // smaller.
    const Ball reached = phase_frequency_covariance(d.q1, d.q2, d.r, d.epsilon, m);
    const bool is_proved = certainly_at_most(sound, c.p);
    Condition p{
        "p-" + name,
        printed
            ? R"(\lVert P(k \mid k) \rVert \le p \text{ for } \bigl||z| - 1\bigr| \le \epsilon_r)"
            : R"(\lVert P(k \mid k) \rVert \le p \text{ for } \bigl||z| - 1\bigr| \le 1 - \sqrt{2\sigma})",
        is_proved                                 ? Verdict::proved
        : printed && certainly_less(c.p, reached) ? Verdict::refuted
                                                  : Verdict::undecided,
        is_proved || !printed ? sound : reached,
        c.p,
        Sense::bounds_above};
    found.conditions.push_back(p);
    found.conditions.push_back({"q-" + name, R"(\lVert P(k \mid k)^{-1} \rVert \le q)",
                                proved_if(certainly_at_most(information, c.q)), information, c.q});
  }
  return found;
}

Derivation song_grizzle(const Design& d, const Tree& /*claimed*/) {
  const Ball far = power_of_two(500);
  return {
      "Song and Grizzle 1993 (thesis, theorem 2.5), assumptions as printed",
      {},
      {less("gramian",
            R"(0 < \beta_1, \quad \beta_1 I \le \mathcal{O} \text{ for every sequence of estimates})", zero,
            zero),
       not_below_far(
           "bounded-F",
           R"(\sup_x \lVert F(x) \rVert < \infty \text{, so } \lVert F(x) \rVert < |z| \text{ for large } |z|)",
           first_derivative_norm(far, d.epsilon))}};
}

Derivation baras_bensoussan_james(const Design& d, const Tree& /*claimed*/) {
  const Ball band(0.25);
  const Ball leak = -log(one - d.epsilon);
  const Ball q_0 = min(d.q1, d.q2);
  const Ball spread = (max(d.q1, d.q2) + d.r * (square(leak) + square(one + band))) / (two * leak);
  const Ball nu = half * spread;
  const Ball q = nu + spread;
  const Ball sound = min(q_0 * sqrt(nu) / (q * sqrt(q)), band * sqrt(nu / q));
  // cannot bind (leak): without one nu is a ball of everything, from which nothing follows.
  const Ball start = certainly_positive(leak) ? nu : one;
  const auto printed = [&](const Ball& units) {
    const Ball gamma2 = (two + square(one + band) + square(one + leak)) / square(q_0 * units);
    const Ball p = one / (start * units) + half * (one / (d.r * units) + gamma2);
    return q_0 * units / (Ball(9.0) * sqrt(p) / sqrt(start * units));
  };
  const Ball bound = printed(one);
  const Ball rescaled = printed(power_of_two(20));
  const Ball far = power_of_two(500);
  const Ball large = power_of_two(400);
  const Ball coupling = square(half * (far - large));
  return {
      "Baras, Bensoussan and James 1988 (thesis, theorem 2.2) for the matching continuous-time oscillator",
      {{"epsilon_c", leak},
       {"q", q},
       {"printed_start_bound", bound},
       {"printed_start_bound_rescaled", rescaled},
       {"initial_frequency_error_bound", sound}},
      {not_below_far("bounded-derivative", R"(\sup_x \lVert \partial f / \partial x \rVert < \infty)",
                     sqrt(square(far) + square(leak))),
       less("excitation", R"(0 < q_0)", zero, q_0),
       less("detectable", R"(\eta'(F + \Lambda H)\eta \le -\alpha_0 |\eta|^2 \text{ at } \eta = (0, 0, 1))",
            zero, leak),
       at_most("detectable-everywhere", R"(\lVert \Lambda(x) \rVert \le 2^{400} \text{ serves every } x)",
               coupling, large * leak),
       at_most("controllable-everywhere", R"(\lVert Q\Gamma(x) \rVert \le 2^{400} \text{ serves every } x)",
               coupling, square(large)),
       at_most("units", R"(\text{(2.16) does not depend on the units of } x)", rescaled, bound),
       noise_free(R"(w = 0, \quad v = 0)", d),
       less("start", R"(\lvert e_0 \rvert < \frac{q_0}{q^{3/2} \lVert P_0^{1/2} \rVert})",
            largest_initial_error(d), sound)}};
}

Derivation theorem_2_7_printed(const Design& d, const Tree& /*claimed*/) {
  // p^2 + q1 p - q1 r = 0.
  const Ball p = half * (sqrt(square(d.q1) + four * d.q1 * d.r) - d.q1);
  const Ball factor = d.r / (p + d.q1 + d.r);
  const Ball least = Ball(3.0) * factor;
  return {"Theorem 2.7 of the thesis as printed, for the error equation of the tracker",
          {{"amplitude_factor", factor}, {"least_lhs", least}},
          {{"2.7", R"(\beta_2(\zeta + \eta) + \alpha_2 < 1)",
            certainly_at_most(one, least) ? Verdict::refuted : Verdict::undecided, least, one}}};
}

Derivation theorem_3_1(const Design& d, const Tree& /*claimed*/) {
  // J = [1 0; 1 iz; 1 (2 - epsilon) iz] turned: J'J has 3, 3, (3 - epsilon) iz, (1 + (2 - epsilon)^2) |z|^2,
  // as printed.
  const Ball determinant =
      Ball(3.0) * (Ball(3.0) * (one + square(two - d.epsilon)) - square(Ball(3.0) - d.epsilon));
  return {
      "Strong local observability of the signal model (thesis, theorem 3.1 and section 3.2.1)",
      {{"gram_determinant", determinant}},
      {less("rank", R"(0 < \det J'J \text{ at } |z| = 1)", zero, determinant),
       {"printed-gram", R"(J'J \text{ is the printed matrix, with } (1 - \epsilon)x_i)", Verdict::proved}}};
}

Derivation theorem_3_1_to_the_letter(const Design& /*d*/, const Tree& /*claimed*/) {
  return {"Further statements of section 3.2.1 of the thesis, taken literally",
          {},
          {less("rank-everywhere", R"(0 < \det J'J \text{ for every } x)", zero, zero),
           // The scan shows no parentheses, nor whether it has lost them: no statement may be made about it.
           {"gram-entry", R"((J'J)_{13} \le -2x_2 - 1 - \epsilon x_2 \text{, as the scan reads})",
            Verdict::undecided},
           less("definition-3.1", R"(h(f^k(x)) \ne h(f^k(\bar x)) \text{ for every } k = 0, \ldots, n-1)",
                zero, zero)}};
}

Derivation theorem_3_2(const Design& d, const Tree& /*claimed*/) {
  // The actual noise is the designed one times `factor`.
  const auto gap = [&](const Ball& factor) {
    Linear designed{d.q1, d.q1, zero, d.q2};
    Linear performed = designed;
    Linear optimal = designed;
    Ball smallest = Ball::everything();
    for (int k = 0; k < 6; ++k) {
      const Ball q1 = factor * d.q1;
      const Ball q2 = factor * d.q2;
      const Ball r = factor * d.r;
      performed = stepped(performed, designed, d.r, q1, q2, r, d.epsilon);
      designed = stepped(designed, designed, d.r, d.q1, d.q2, d.r, d.epsilon);
      optimal = stepped(optimal, optimal, r, q1, q2, r, d.epsilon);
      const Ball now = certainly_less(factor, one) ? smallest_eigenvalue(designed, performed)
                                                   : smallest_eigenvalue(optimal, designed);
      smallest = k == 0 ? now : min(smallest, now);
    }
    return smallest;
  };
  const Ball over = gap(half);
  const Ball under = gap(two);
  return {
      "Over-design and under-design of the filter (thesis, theorem 3.2), linearised at |z| = 1",
      {{"over_design_gap", over}, {"under_design_gap", under}},
      {less("over-design", R"(P^p(k \mid k-1) \le P^d(k \mid k-1), \quad k = 1, \ldots, 6)", zero, over),
       less("under-design", R"(P^d(k \mid k-1) \le P^o(k \mid k-1), \quad k = 1, \ldots, 6)", zero, under)}};
}

Derivation theorem_3_2_any_start(const Design& /*d*/, const Tree& /*claimed*/) {
  return {"Theorem 3.2 of the thesis as printed, without a condition on the start",
          {},
          {at_most("any-start", R"(P^p(0 \mid -1) \le P^d(0 \mid -1) \text{ for any two})", one, zero)}};
}

Derivation lemma_3_1(const Design& d, const Tree& /*claimed*/) {
  // P_11 P_33 with P_13 = 0, every variance in the range of the filter's covariance.
  const Ball smallest = one / max(one / d.q1 + one / d.r, one / d.q2);
  const Ball largest = largest_covariance(d.q1, d.q2, d.r, d.epsilon, one);
  const Range term(square(smallest), square(largest));
  const bool positive = certainly_positive(term.low);
  const Ball exact = half * (one - exp(-two));
  return {"Second-order terms of the prediction covariance (thesis, lemma 3.1)",
          {{"phase_term_printed", zero}, {"phase_term", term}},
          {{"exact-to-second-order",
            R"(\frac{1}{2}\mathrm{tr}(\mathcal{H}_2 P \mathcal{H}_2 P) \le \frac{1}{4}(P\partial^2 f)_2^2)",
            positive ? Verdict::refuted : Verdict::undecided, term, zero},
           {"truncated-under-estimate", R"(0 < \frac{1}{2}\mathrm{tr}(\mathcal{H}_2 P \mathcal{H}_2 P))",
            proved_if(positive), zero, term},
           at_most("under-estimate",
                   R"((F P F')_{22} \le \mathrm{Var}\,f_2 \text{ for every Gaussian error})", one, exact)}};
}

}  // namespace veritrack::checker

#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/theorems/covariance_range.hpp"
#include "analysis/theorems/signal_model.hpp"
#include "analysis/theorems/theorem_2_9_gaps_parts.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::theorems::gaps {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// s bounds P^-1 + F'Q^-1 F, an inverse covariance, and is used as a bound on P(k+1|k).
Statement predicted_in_general(const Readings& readings) {
  Theorem29Input wide = readings.input;
  const Interval variance(100.0);
  wide.q1 = wide.q2 = wide.r = variance;
  const Interval bound = theorem_2_9_constants(Theorem29Variant::printed, wide).s;
  return make_statement(
      gap_id("s", "general"), "P(k+1|k) <= s I for every design.", decide_less_equal(variance, bound),
      "q1 = q2 = r = 100, the other parameters as given: P(k+1|k) >= Q = 100 I, and s is " + enclosed(bound) +
          ".",
      {evidence("smallest_predicted_variance", "q_1", "", variance), evidence("s", "s", "", bound)});
}

Statement predicted_for_design(const Reading& reading, const Readings& readings) {
  const Theorem29Constants& c = reading.constants;
  const Theorem29Input& input = readings.input;
  const Interval one(1.0);
  const Interval largest_variance = max(input.q1, input.q2);
  const bool ranged = certainly_positive(c.epsilon_r) && certainly_less(c.epsilon_r, one);
  const Interval upper = ranged ? Interval((square(first_derivative_norm(one + c.epsilon_r, input.epsilon)) *
                                                largest_covariance(input, one - c.epsilon_r) +
                                            largest_variance)
                                               .upper())
                                : Interval::empty();
  const Verdict above = decide_less_equal(largest_variance, c.s);
  const Verdict below = decide_less_equal(upper, c.s);
  const Verdict verdict = above == Verdict::refuted  ? Verdict::refuted
                          : below == Verdict::proved ? Verdict::proved
                                                     : Verdict::undecided;
  Quantity predicted_bound = evidence("predicted_bound", "", "", upper);
  predicted_bound.sense = Sense::at_most;
  return make_statement(
      gap_id("s", reading.name),
      "For this design P(k+1|k) <= s I for all k >= 2 and every P(0|0), along estimates with |e| <= eps_r.",
      verdict,
      "Sound bounds: the largest eigenvalue of P(k+1|k) is at least " + at_least(largest_variance) +
          " and at most " + at_most(upper) + "; s is " + enclosed(c.s) + ".",
      {evidence("predicted_lower", R"(\max(q_1, q_2))", "", largest_variance), predicted_bound,
       evidence("s", "s", "", c.s)});
}

/// The bounds come from a window of N + 1 measurements, and step 0 has no past measurements.
Statement start_statement(const Readings& readings) {
  const Interval& p = readings.printed().p;
  const Interval start = Interval(2.0) * p;
  return make_statement(gap_id("bounds-from-the-start"),
                        "P(0|0) <= p I, which the proofs use at k = 0, is true for every start P(0|0) >= 0.",
                        decide_less_equal(start, p),
                        "P(0|0) = 2 p I, allowed by the theorem: its eigenvalue is " + enclosed(start) +
                            ", p is " + enclosed(p) + ".",
                        {evidence("start_eigenvalue", "2p", "", start), evidence("p", "p", "", p)});
}

/// The displayed recursion: V(k+1) <= V(k) - gamma |z|^2 bounds V(k+1)/V(k) by a lower bound on |z|^2/V(k).
Statement displayed_recursion_statement(const Readings& readings) {
  const Theorem29Constants& c = readings.printed();
  const Interval decrease = c.gamma / c.q;
  const Interval claimed = c.gamma * c.p;
  return make_statement(
      gap_id("decrease-factor", "displayed"),
      "|z|^2/p <= V <= q |z|^2 and V(k+1) <= V(k) - gamma |z(k)|^2 imply V(k+1) <= (1 - gamma p) V(k).",
      decide_less_equal(claimed, decrease),
      "V(k) = q |z|^2 and V(k+1) = V(k) - gamma |z|^2: V decreases by the fraction gamma/q, " +
          enclosed(decrease) + "; the claimed fraction is gamma p, " + enclosed(claimed) + ".",
      {evidence("decrease", R"(\frac{\gamma}{q})", "", decrease),
       evidence("claimed_decrease", R"(\gamma p)", "", claimed)});
}

/// The factor of (2.36) follows from |z|^2 >= V/q, for any gamma/q in (0, 1).
Statement concluded_recursion_statement(const Readings& readings) {
  const Interval decrease = readings.printed().gamma / readings.printed().q;
  return make_statement(
      gap_id("decrease-factor", "2.36"),
      "|z|^2/p <= V <= q |z|^2 and V(k+1) <= V(k) - gamma |z(k)|^2 imply V(k+1) <= (1 - gamma/q) V(k), a "
      "factor between 0 and 1.",
      rigor::conjunction({decide_less(Interval(0.0), decrease), decide_less(decrease, Interval(1.0))}),
      "|z|^2 >= V/q, so V decreases by at least the fraction gamma/q, " + enclosed(decrease) + ".",
      {evidence("decrease", R"(\frac{\gamma}{q})", "", decrease)});
}

/// The frequency gain K(2) across the phase, after two exact estimates of phase at time 1 with the same
/// xhat(1|1), |z| = 1, but another |z(0|0)|.
Interval second_gain(const Interval& magnitude_before, const Theorem29Input& input) {
  using Covariance = trackers::PolarCovariance<Interval>;
  const trackers::ToneModel<Interval> design{input.q1, input.q2, input.r, input.epsilon};
  const Interval zero(0.0);
  const Covariance start{input.r, zero, zero, input.r, zero, input.r};
  const Covariance first = trackers::predicted_covariance(start, magnitude_before, design);
  const Covariance filtered = trackers::filtered_covariance(first, trackers::gain(first, input.r), input.r);
  const Covariance second = trackers::predicted_covariance(filtered, Interval(1.0), design);
  return trackers::gain(second, input.r).k32;
}

Statement past_errors_statement(const Readings& readings) {
  const Interval exact = second_gain(Interval(1.0), readings.input);
  const Interval smaller = second_gain(Interval(0.75), readings.input);
  const bool differ = certainly_less(smaller, exact) || certainly_less(exact, smaller);
  return make_statement(
      gap_id("past-errors"),
      "fbar(k, z) of (2.34) is a function of z(k) alone, as Theorem 2.7 and Lemmas 2.3 and 2.5 treat it.",
      differ ? Verdict::refuted : Verdict::undecided,
      "P(0|0) = r I and |xhat(0|0)| = 1 or 0.75 give the same xhat(1|1) = (1, 0, 0) (with suitable "
      "measurements) but the gains K_32(2) = " +
          enclosed(exact) + " or " + enclosed(smaller) + ": equal z(1), different z(2).",
      {evidence("gain_after_1", "K_{32}(2)", "", exact),
       evidence("gain_after_three_quarters", "K_{32}(2)", "", smaller)});
}

/// Lemma 3.1 for the tracker's first component, Gaussian error of the frequency alone, variance 1/64 at the
/// estimate (1, 0, 0): the covariance of cos e_3 is (1 - exp(-P))^2/2, P^2/2 to second order.
Statement second_order_statement() {
  const Interval variance(0.015625);
  const Interval claimed = square(variance) / Interval(4.0);
  const Interval exact = square(Interval(1.0) - rigor::exp(-variance)) / Interval(2.0);
  return make_statement(
      gap_id("lemma-3.1"),
      "The second-order term of Lemma 3.1, (1/4)(P d^2 f)(P d^2 f)', is the contribution of the curvature of "
      "f to the covariance of the prediction, to within a tenth of it.",
      decide_less_equal(abs(exact - claimed), exact / Interval(10.0)),
      "Estimate (1, 0, 0), Gaussian error of variance 1/64 in the frequency alone, first component: the "
      "variance of cos e3 is " +
          enclosed(exact) + ", the term of the lemma " + enclosed(claimed) + ".",
      {evidence("exact_variance", "", R"(\frac{1}{2}(1 - e^{-P_{33}})^2)", exact),
       evidence("claimed_variance", "", R"(\frac{1}{4}P_{33}^2)", claimed)});
}

}  // namespace

std::vector<Statement> covariance_gaps(const Readings& readings) {
  std::vector<Statement> statements;
  statements.push_back(predicted_in_general(readings));
  for (const Reading& reading : readings.each) {
    statements.push_back(predicted_for_design(reading, readings));
  }
  statements.push_back(start_statement(readings));
  statements.push_back(displayed_recursion_statement(readings));
  statements.push_back(concluded_recursion_statement(readings));
  statements.push_back(past_errors_statement(readings));
  statements.push_back(second_order_statement());
  return statements;
}

}  // namespace veritrack::theorems::gaps

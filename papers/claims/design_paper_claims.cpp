#include "papers/claims/design_paper_claims.hpp"

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

/// |dy(k+1)/dx3|^2 - (c^2 + s^2)|z|^2 for y(k+1) = (c x1 - s x2, s x1 + c x2).
Verdict is_seen_by_amplitude() {
  return vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [c, s, x1, x2] = at;
        return square(-s * x1 - c * x2) + square(c * x1 - s * x2) -
               (square(c) + square(s)) * (square(x1) + square(x2));
      },
      2);
}

/// A leak of 1 - kept/of, and a frequency that is so many turns a sample too high.
struct Alias {
  int kept, of, turns;
};

/// Is it a whole number of turns in the second sample, too?
bool is_unseen(const Alias& alias) {
  return alias.turns > 0 && (alias.turns * alias.kept) % alias.of == 0;
}

std::vector<Statement> model_statements() {
  const bool unseen = is_unseen({19, 20, 20}) && is_unseen({99, 100, 100});
  const Interval at_rest(0.0);  // |dy(k+1)/dx3| at z = 0
  return {make_statement(
              "paper-1996/aliasing",
              "Aliasing keeps the model from being observable globally, with the leaks of 0.05 and 0.01 "
              "of its designs and the outputs of three samples.",
              unseen ? Verdict::proved : Verdict::undecided,
              "x3 and x3 + 40 pi have the same outputs at the leak 0.05 (40 pi and 0.95 times 40 pi are "
              "whole turns), x3 and x3 + 200 pi at 0.01. Over more samples a leak distinguishes them.",
              {}),
          make_statement("paper-1996/locally-observable/printed",
                         "The system (1), (2) is strongly locally observable.",
                         decide(Interval(0.0), at_rest, Strictness::strict),
                         "At (x1, x2) = (0, 0) all outputs are 0, whatever x3.", {}),
          make_statement(
              "paper-1996/locally-observable/corrected",
              "The system (1), (2) is strongly locally observable where (x1, x2) is not 0.",
              is_seen_by_amplitude(),
              "y(k) is (x1, x2), and the derivative of y(k+1) by x3 has the size |(x1, x2)|: an identity. "
              "Two samples are enough.",
              {})};
}

/// P' - S' for P the computed and S the achieved covariance under the same gain, and Joseph's form at the
/// optimal gain, multiplied by (P + R)^2.
Verdict is_ordered() {
  const Verdict difference = vanishes<8>(
      [](const std::array<Interval, 8>& at) {
        const auto& [f, k, p, s, q_design, q_actual, r_design, r_actual] = at;
        const Interval kept = square(f * (Interval(1.0) - k));
        const Interval gained = square(f * k);
        return (kept * p + gained * r_design + q_design) - (kept * s + gained * r_actual + q_actual) -
               (kept * (p - s) + (q_design - q_actual) + gained * (r_design - r_actual));
      },
      2);
  const Verdict joseph = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [p, r] = at;
        return square(r) * p + square(p) * r - p * r * (p + r);
      },
      3);
  return rigor::conjunction({difference, joseph});
}

/// Computed and achieved variance of a random walk of steps of variance 1, measured with noise of variance 1,
/// in a filter that assumes no steps.
struct UnderDesign {
  Interval computed, achieved;
};

UnderDesign under_designed(int samples) {
  const Interval one(1.0);
  UnderDesign filter{one, one};
  for (int k = 0; k < samples; ++k) {
    const Interval gain = filter.computed / (filter.computed + one);
    filter.achieved = square(one - gain) * filter.achieved + square(gain) + one;
    filter.computed = filter.computed / (filter.computed + one);
  }
  return filter;
}

std::vector<Statement> linear_filter_statements() {
  const UnderDesign under = under_designed(1000);
  const Interval one(1.0);
  const Interval linearised(1.0);
  const Interval exact = Interval(2.0) - Interval(2.0) * rigor::exp(Interval(-0.5));
  return {
      make_statement(
          "paper-1996/over-design/printed",
          "In a linear Kalman filter with Q and R above the actual values the computed covariance is "
          "above the achieved one, whatever the start.",
          decide(one, Interval(0.0), Strictness::weak),
          "A filter that starts with P(0) = 0 and an error of variance 1.", {}),
      make_statement(
          "paper-1996/over-design/corrected",
          "In a linear Kalman filter with Q and R above the actual values the computed covariance is above "
          "the "
          "achieved one in every sample, if it is so at the start.",
          is_ordered(),
          "With the gain k, P - S becomes (f (1 - k))^2 (P - S) + (Q - Qa) + (f k)^2 (R - Ra): an identity, "
          "here of one state, and for matrices by the same terms.",
          {}),
      make_statement(
          "paper-1996/under-design",
          "Under-design has no such guarantee: the achieved covariance may exceed the computed one "
          "more than 1e5 times.",
          decide(Interval(1e5), under.achieved / under.computed, Strictness::strict),
          "A random walk of steps of variance 1 in a filter with Q = 0, R = 1: after 1000 samples "
          "the achieved variance is " +
              enclosed(under.achieved) + ", the computed one " + enclosed(under.computed) + ".",
          {}),
      make_statement(
          "paper-1996/under-estimate",
          "The first-order covariance of a prediction is at most the true mean square of its error.",
          decide(linearised, exact, Strictness::weak),
          "Estimate (1, 0, 0), a frequency error alone, Gaussian with the variance 1: the first "
          "order has 1 for the error of the rotated signal, and its mean square, 2 - 2 exp(-1/2), is " +
              enclosed(exact) + ". (For the in-phase part alone the sentence is true.)",
          {})};
}

std::vector<Statement> covariance_statements() {
  const Verdict above = vanishes<9>(
      [](const std::array<Interval, 9>& at) {
        const auto& [u1, u2, u3, l11, l21, l22, l31, l32, l33] = at;
        const Interval p12 = l11 * l21;
        const Interval p13 = l11 * l31;
        const Interval p23 = l21 * l31 + l22 * l32;
        const Interval squares = square(u1) * square(l11) + square(u2) * (square(l21) + square(l22)) +
                                 square(u3) * (square(l31) + square(l32) + square(l33));
        const Interval products = u1 * u2 * p12 + u1 * u3 * p13 + u2 * u3 * p23;
        return squares + Interval(2.0) * products - square(u1 * l11 + u2 * l21 + u3 * l31) -
               square(u2 * l22 + u3 * l32) - square(u3 * l33);
      },
      2);
  const Interval q = parse_decimal("0.0005");
  const Interval far = q + q + square(Interval(1e100)) * q;  // phase, second sample, |z| = 1e100
  return {
      make_statement(
          "paper-1996/least-covariance", "P(k+1|k) is at least Q.", above,
          "P(k+1|k) - Q = F P(k|k) F' is positive semidefinite: with P = L L', u'P u = |L'u|^2, an identity. "
          "It is a bound and not a value that occurs, as P(k|k) is positive definite for r > 0.",
          {}),
      make_statement("paper-1996/gramian/positive-definite",
                     "With Q positive definite the controllability Gramian of [F, Q] is positive definite.",
                     rigor::conjunction({above, decide(Interval(0.0), q, Strictness::strict)}),
                     "It is Q and a sum of positive semidefinite matrices, and q is at least 0.0005 in the "
                     "four designs.",
                     {}),
      make_statement(
          "paper-1996/gramian/bounded",
          "With Q positive definite the controllability Gramian of [F, Q] over two samples is "
          "bounded, whatever the estimates.",
          decide(far, Interval(1e190), Strictness::weak),
          "F has the estimated amplitude in it: at |z| = 1e100 the variance of the phase part is " +
              enclosed(far) + ". Theorem 2.9 of the thesis bounds the states.",
          {})};
}

std::vector<Statement> slew_statements() {
  const Verdict stationary = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [kept, q] = at;  // the variance times 1 - kept^2
        return square(kept) * q + q * (Interval(1.0) - square(kept)) - q;
      },
      2);
  const rigor::Dual<Interval, 1> epsilon(Interval::from_bounds(0.0, 0.99), {Interval(1.0)});
  const Interval slope = (epsilon * (rigor::Dual<Interval, 1>(2.0) - epsilon)).derivative(0);
  const Interval rate =
      sqrt(Interval(2.0) * parse_decimal("0.0005") / (Interval(2.0) - parse_decimal("0.05")));
  const Interval spread = sqrt(parse_decimal("0.0005") / (Interval(1.0) - square(parse_decimal("0.95"))));
  const Interval ratio = pow(Interval(1.0) / (Interval(2.0) * parse_decimal("0.01")), 20);
  return {
      make_statement("paper-1996/variance",
                     "The frequency of model (1) has the stationary variance q2/(1 - (1 - epsilon)^2).",
                     stationary, "It is what a sample leaves as it is, an identity.", {}),
      make_statement("paper-1996/leak-for-q",
                     "A smaller leak lets q2 decrease at the same variance of the frequency (leaks up to "
                     "0.99).",
                     decide(Interval(0.0), slope, Strictness::strict),
                     "q2 is the variance times epsilon (2 - epsilon), which has the slope " +
                         enclosed(slope) + " there.",
                     {}),
      make_statement("paper-1996/snr",
                     "A noise of variance 0.01 in each channel is a signal-to-noise ratio of 17 dB at "
                     "amplitude 1, to half a decibel.",
                     rigor::conjunction({decide(pow(Interval(10.0), 33), ratio, Strictness::strict),
                                         decide(ratio, pow(Interval(10.0), 35), Strictness::strict)}),
                     "The ratio is 50, and 50^20 is " + enclosed(ratio) + ", between 10^33 and 10^35.", {}),
      make_statement(
          "paper-1996/slew-of-model",
          "A slew of up to 0.04 rad/sample a sample is within what the model with q = 0.0005 and the leak "
          "0.05 generates: at most twice its standard deviation.",
          decide(parse_decimal("0.04"), Interval(2.0) * rate, Strictness::weak),
          "The frequency changes by " + enclosed(rate) +
              " rad/sample a sample (standard deviation). It keeps near 0, with the standard deviation " +
              enclosed(spread) + " rad/sample.",
          {})};
}

}  // namespace

std::vector<Statement> design_paper_claims() {
  std::vector<Statement> statements = model_statements();
  for (auto part : {linear_filter_statements(), covariance_statements(), slew_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

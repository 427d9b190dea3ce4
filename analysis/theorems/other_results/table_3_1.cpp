#include "analysis/theorems/other_results/table_3_1.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "analysis/rigor/dual.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;
using Number = rigor::Dual<Interval, 3>;  // by q1, q2, r

/// Why the table says nothing of this design; empty when it does. Needs the upward rounding mode.
std::string why_not_applicable(Theorem29Variant variant, const Theorem29Input& input) {
  const Interval sigma_end = variant == Theorem29Variant::printed ? sqrt(Interval(0.5)) : Interval(1.0);
  if (!certainly_positive(input.sigma) || !certainly_less(input.sigma, sigma_end)) {
    return "Not applicable: sigma is not in its range, so that there is no epsilon_r and no b_1.";
  }
  if (input.q1_equals_q2 || certainly_less_equal(input.q1, input.q2)) {
    return "";
  }
  // cannot bind (input.q2): it chooses the words for why nothing is said.
  if (certainly_less(input.q2, input.q1)) {
    return "Not applicable: the table is for q_1 <= q_2, and here q_1 > q_2, for which the thesis's footnote "
           "to it "
           "gives the opposite signs.";
  }
  return "Not applicable: the table is for q_1 <= q_2, which is not known of this design.";
}

/// The parameters of the constants other than q1, q2 and r.
struct Factors {
  Interval b1;           ///< B1
  Interval b2;           ///< B2
  Interval rho_squared;  ///< rho1^2
};

struct Values {
  Number p, q, s;
  Number beta_squared;   ///< p q
  Number alpha_measure;  ///< s p^2 q, which increases with alpha
};

Values values(const Factors& factors, const std::array<Interval, 3>& design) {
  std::array<Number, 3> x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::array<Interval, 3> derivatives = {Interval(0.0), Interval(0.0), Interval(0.0)};
    derivatives.at(i) = Interval(1.0);
    x.at(i) = Number(design.at(i), derivatives);
  }
  const Number one(1.0);
  Values v;
  v.p = x[1] + x[2] * factors.b1;
  v.q = one / x[0] + Number(factors.b2) / x[2];
  v.s = v.q + Number(factors.rho_squared) / x[0];
  v.beta_squared = v.p * v.q;
  v.alpha_measure = v.s * square(v.p) * v.q;
  return v;
}

using Measure = Number Values::*;

/// Part `index` of `count` of [x/2, 2x]; together they cover it.
Interval part(const Interval& x, int index, int count) {
  const auto bound = [&](int i) {
    return Interval(0.5) +
           Interval(1.5) * Interval(static_cast<double>(i)) / Interval(static_cast<double>(count));
  };
  return x * hull(bound(index), bound(index + 1));
}

/// The derivative by direction 0 (q1) or 1 (q2) over the box, as the hull over its parts.
Interval derivative_over_box(const Factors& factors, const std::array<Interval, 3>& design, Measure measure,
                             int direction) {
  constexpr int kParts = 6;
  Interval total = Interval::empty();
  for (int i = 0; i < kParts * kParts * kParts; ++i) {
    const std::array<Interval, 3> cell = {part(design[0], i % kParts, kParts),
                                          part(design[1], i / kParts % kParts, kParts),
                                          part(design[2], i / (kParts * kParts), kParts)};
    const Interval slope = (values(factors, cell).*measure).derivative(direction);
    if (!is_finite(slope)) {
      return Interval::empty();
    }
    total = i == 0 ? slope : hull(total, slope);
  }
  return total;
}

Interval slope_in_r(const Factors& factors, std::array<Interval, 3> design, Measure measure, double r) {
  design[2] = Interval(r);
  return (values(factors, design).*measure).derivative(2);
}

/// The r at which the measure is stationary: negative slope at the lower end and positive slope at the upper
/// end, both certain. Empty when bisection did not find such a pair.
Interval stationary_point(const Factors& factors, const std::array<Interval, 3>& design, Measure measure) {
  double lower = 1e-30;
  double upper = 1e30;
  for (int i = 0; i < 200 && upper > lower * (1.0 + 1e-9); ++i) {
    const double middle = std::sqrt(lower) * std::sqrt(upper);
    const Interval slope = slope_in_r(factors, design, measure, middle);
    // cannot bind (slope): the slopes at both ends are looked at again below.
    const bool falls = certainly_negative(slope);
    // cannot bind (slope): the same.
    const bool rises = certainly_positive(slope);
    if (falls) {
      lower = middle;
    } else if (rises) {
      upper = middle;
    } else {
      break;
    }
  }
  const bool enclosed = certainly_negative(slope_in_r(factors, design, measure, lower)) &&
                        certainly_positive(slope_in_r(factors, design, measure, upper)) &&
                        upper < 2.0 * lower;
  return enclosed ? Interval::from_bounds(lower, upper) : Interval::empty();
}

Condition monotone(std::string id, const std::string& statement, const Interval& slope, bool increasing) {
  const Side side{"the derivative over the box", slope};
  return increasing ? compare(std::move(id), statement, zero(), side)
                    : compare(std::move(id), statement, side, zero());
}

/// "is minimised at": by convexity, wherever a stationary point exists; "is maximised at" is then refuted.
Condition extremum(std::string id, std::string statement, const Interval& point, bool minimum) {
  Condition condition{std::move(id), std::move(statement), Verdict::undecided, point, Interval::empty(), ""};
  if (is_finite(point)) {
    condition.verdict = minimum ? Verdict::proved : Verdict::refuted;
    condition.reason = "In r it decreases below the stationary point, which is at least " + at_least(point) +
                       ", and increases above it: a minimum.";
  } else {
    condition.reason = "No stationary point in r was enclosed for the values of this design.";
  }
  return condition;
}

/// Does a printed formula give the stationary point, to three digits?
Condition agreement(std::string id, std::string statement, const Interval& formula, const Interval& point) {
  return compare(std::move(id), std::move(statement),
                 {"the relative difference", abs(formula / point - Interval(1.0))},
                 {"0.001", Interval(0.001)});
}

/// r_alpha and r_beta by the printed formulas, p, q and s taken at the stationary points themselves.
struct Formulas {
  Interval alpha, beta;
};

Formulas formulas(Theorem29Variant variant, const Theorem29Input& input, const Factors& factors,
                  const std::array<Interval, 3>& design, const Interval& alpha_point,
                  const Interval& beta_point) {
  const Interval one(1.0);
  const auto at = [&](const Interval& r) { return values(factors, {design[0], design[1], r}); };
  const Values a = at(alpha_point);
  const Values b = at(beta_point);
  const Interval harmonic = a.p.value() * (one / a.s.value() + one / a.q.value());
  if (variant == Theorem29Variant::errata) {
    return {sqrt(Interval(1.25) * input.sigma * harmonic),
            sqrt(Interval(2.5) * design[0] * design[1] * input.sigma)};
  }
  // 1 - sqrt2 epsilon_r is sqrt2 sigma =: t, and 1 - 2 epsilon_r^2 = t (2 - t).
  const Interval t = sqrt(Interval(2.0)) * input.sigma;
  const Interval common = square(t * (Interval(2.0) - t)) * (one - square(t) / Interval(4.0));
  return {sqrt(Interval(0.75) * common * harmonic), sqrt(Interval(1.5) * common * b.p.value() / b.q.value())};
}

}  // namespace

Derivation evaluate_table_3_1(Theorem29Variant variant, const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  const bool printed = variant == Theorem29Variant::printed;
  const Theorem29Constants constants = theorem_2_9_constants(variant, input);
  const Interval one(1.0);
  const Factors factors{one / (input.r * constants.b_1), input.r * constants.b_2, square(constants.rho_1)};
  const std::array<Interval, 3> design = {input.q1, input.q2, input.r};
  const Interval r_alpha = stationary_point(factors, design, &Values::alpha_measure);
  const Interval r_beta = stationary_point(factors, design, &Values::beta_squared);
  const Formulas formula = formulas(variant, input, factors, design, r_alpha, r_beta);

  Derivation derivation;
  derivation.id = printed ? "table-3.1/printed" : "table-3.1/errata";
  derivation.title = printed
                         ? "Table 3.1 of the thesis as printed: alpha and beta by q1, q2 and r"
                         : "Table 3.1 of the thesis with the errata sheet: alpha and beta by q1, q2 and r";
  const std::string source = printed ? "thesis, Table 3.1" : "errata to page 69";
  const std::string refusal = why_not_applicable(variant, input);
  const auto add = [&](const QuantityText& text, const Interval& value) {
    add_quantity(derivation, text, refusal.empty() ? value : Interval::empty(), refusal);
  };
  add({"r_alpha", R"(r_\alpha)", R"(\partial\alpha/\partial r = 0)", "enclosed by bisection"}, r_alpha);
  add({"r_alpha_formula", R"(r_\alpha)", "", source}, formula.alpha);
  add({"r_beta", R"(r_\beta)", R"(\partial\beta/\partial r = 0)", "enclosed by bisection"}, r_beta);
  add({"r_beta_formula", R"(r_\beta)", "", source}, formula.beta);
  const auto slope = [&](Measure measure, int direction) {
    return derivative_over_box(factors, design, measure, direction);
  };
  derivation.conditions = {
      monotone("alpha-q1", R"(\alpha \text{ decreases with } q_1)", slope(&Values::alpha_measure, 0), false),
      monotone("beta-q1", R"(\beta \text{ decreases with } q_1)", slope(&Values::beta_squared, 0), false),
      monotone("alpha-q2", R"(\alpha \text{ increases with } q_2)", slope(&Values::alpha_measure, 1), true),
      monotone("beta-q2", R"(\beta \text{ increases with } q_2)", slope(&Values::beta_squared, 1), true),
      extremum("alpha-r",
               printed ? R"(\alpha \text{ is maximised at } r_\alpha)"
                       : R"(\alpha \text{ is minimised at } r_\alpha)",
               r_alpha, !printed),
      extremum("beta-r", R"(\beta \text{ is minimised at } r_\beta)", r_beta, true),
      agreement("r_alpha", R"(r_\alpha \text{ is what the formula gives, to } 10^{-3})", formula.alpha,
                r_alpha),
      agreement("r_beta", R"(r_\beta \text{ is what the formula gives, to } 10^{-3})", formula.beta, r_beta)};
  if (!refusal.empty()) {
    for (Condition& condition : derivation.conditions) {
      condition = {condition.id,      condition.statement, Verdict::undecided,
                   Interval::empty(), Interval::empty(),   refusal};
    }
  }
  derivation.notes = {
      "The derivatives are those of p q = beta^2 and of s p^2 q, which have the signs of the derivatives of "
      "beta and "
      "alpha; the box is half to twice each of q1, q2 and r, as far as q1 <= q2, for which the table is. In "
      "r both are convex on logarithmic scales, so "
      "that a "
      "stationary point is the minimum.",
      "r_alpha, and r_beta as printed, are equations rather than formulas: p, q and s depend on r. They are "
      "evaluated at "
      "the stationary point."};
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

#include "checker/theorems/table_3_1.hpp"

#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

/// p = q2 + r B1, q = 1/q1 + B2/r, s = q + rho^2/q1: the expressions in which the table varies q1, q2 and r.
struct Table {
  Ball b1, b2, rho2;
  [[nodiscard]] Ball p(const Ball& q2, const Ball& r) const { return q2 + r * b1; }
  [[nodiscard]] Ball q(const Ball& q1, const Ball& r) const { return one / q1 + b2 / r; }
  [[nodiscard]] Ball s(const Ball& q1, const Ball& r) const { return q(q1, r) + rho2 / q1; }
};

/// The range over r in [r/2, 2r] of a product of a factor that rises with r and one that falls: parts are
/// cut, and in each the factors are taken at its ends.
template <typename Rising, typename Falling>
Range over_r(const Ball& r, const Rising& rising, const Falling& falling) {
  constexpr int kParts = 256;
  Ball low = Ball::everything();
  Ball high = Ball::everything();
  const auto node = [&](int i) { return r * (half + Ball(1.5 * i / kParts)); };
  for (int i = 0; i < kParts; ++i) {
    const Ball least = rising(node(i)) * falling(node(i + 1));
    const Ball most = rising(node(i + 1)) * falling(node(i));
    low = i == 0 ? least : min(low, least);
    high = i == 0 ? most : max(high, most);
  }
  return {low, high};
}

/// The r at which s p^2 q is stationary in r: where 2 B1/p = (B2/r^2)(1/q + 1/s). Left of it the measure
/// falls, right of it it rises, as it is a posynomial.
Ball stationary_alpha(const Table& t, const Ball& q1, const Ball& q2) {
  const auto slope = [&](const Ball& r) {
    return two * t.b1 / t.p(q2, r) - t.b2 / square(r) * (one / t.q(q1, r) + one / t.s(q1, r));
  };
  Ball low(0x1p-100);
  Ball high(0x1p100);
  if (!certainly_less(slope(low), zero) || !certainly_positive(slope(high))) {
    return Ball::everything();
  }
  for (int i = 0; i < 200; ++i) {
    const Ball middle(sqrt(low * high).near());
    if (certainly_less(slope(middle), zero)) {
      low = middle;
    } else if (certainly_positive(slope(middle))) {
      high = middle;
    }
  }
  return Ball::hull(low, high);
}

Condition sign(const std::string& id, const std::string& statement, const Range& slope, bool increasing) {
  if (increasing) {
    return {id, statement, proved_if(certainly_positive(slope.low)), zero, slope};
  }
  return {id, statement, proved_if(certainly_less(slope.high, zero)), slope, zero};
}

Range negative(const Range& x) {
  return {-x.high, -x.low};
}

/// Derivatives of the measures of alpha and beta, by q1 and by q2, for q1, q2 and r from half to twice the
/// design's.
struct Slopes {
  Range alpha_q1, alpha_q2, beta_q1, beta_q2;
};
Slopes slopes_of(const Table& t, const Design& d) {
  const Ball low1 = half * d.q1;
  const Ball high1 = two * d.q1;
  const Ball low2 = half * d.q2;
  const Ball high2 = two * d.q2;
  const Ball low_r = half * d.r;
  const Ball high_r = two * d.r;
  const Ball rho = one + t.rho2;
  // -d(s p^2 q)/dq1 = p^2 ((1 + rho^2) q + s)/q1^2 and d(s p^2 q)/dq2 = 2 p s q.
  const auto alpha_q1 = [&](const Ball& q1, const Ball& q2) {
    return over_r(
        d.r, [&](const Ball& r) { return square(t.p(q2, r) / q1); },
        [&](const Ball& r) { return rho * t.q(q1, r) + t.s(q1, r); });
  };
  const auto alpha_q2 = [&](const Ball& q1, const Ball& q2) {
    return over_r(
        d.r, [&](const Ball& r) { return two * t.p(q2, r); },
        [&](const Ball& r) { return t.s(q1, r) * t.q(q1, r); });
  };
  return {negative({alpha_q1(high1, low2).low, alpha_q1(low1, high2).high}),
          {alpha_q2(high1, low2).low, alpha_q2(low1, high2).high},
          negative({t.p(low2, low_r) / square(high1), t.p(high2, high_r) / square(low1)}),
          {t.q(high1, high_r), t.q(low1, low_r)}};
}

/// The r at which alpha and beta are stationary, and the values that the table's formulas give for it.
struct StationaryR {
  Ball alpha, beta, alpha_formula, beta_formula;
};
StationaryR stationary_r(const Table& t, const Design& d, bool printed) {
  StationaryR r;
  r.alpha = stationary_alpha(t, d.q1, d.q2);
  r.beta = sqrt(d.q1 * d.q2 * t.b2 / t.b1);
  const Ball harmonic = t.p(d.q2, r.alpha) * (one / t.s(d.q1, r.alpha) + one / t.q(d.q1, r.alpha));
  const Ball u = sqrt(two) * d.sigma;
  const Ball common = square(u * (two - u)) * (one - square(u) / four);
  r.alpha_formula = printed ? sqrt(Ball(0.75) * common * harmonic) : sqrt(Ball(1.25) * d.sigma * harmonic);
  r.beta_formula = printed ? sqrt(Ball(1.5) * common * t.p(d.q2, r.beta) / t.q(d.q1, r.beta))
                           : sqrt(Ball(2.5) * d.q1 * d.q2 * d.sigma);
  return r;
}

/// The formula gives r to three digits.
Condition agrees(const std::string& id, const std::string& statement, const Ball& formula, const Ball& r) {
  const Ball three_digits(0.001);
  const Range off(zero, abs(formula / r - one).upper());
  return {id, statement, proved_if(certainly_less(off.high, three_digits)), off, three_digits};
}

}  // namespace

std::string check_table_3_1(const Tree& derivation, const Design& d, bool printed, Objections& objections) {
  const Constants29 c = constants_2_9(d, printed ? Reading::printed : Reading::errata);
  const Table t{one / (d.r * c.b_1), d.r * c.b_2, square(c.rho_1)};
  const Slopes slopes = slopes_of(t, d);
  const StationaryR r = stationary_r(t, d, printed);
  const Verdict minimum = printed ? Verdict::refuted : Verdict::proved;

  Derivation found;
  found.title = printed ? "Table 3.1 of the thesis as printed: alpha and beta by q1, q2 and r"
                        : "Table 3.1 of the thesis with the errata sheet: alpha and beta by q1, q2 and r";
  found.quantities = {{"r_alpha", r.alpha},
                      {"r_alpha_formula", r.alpha_formula},
                      {"r_beta", r.beta},
                      {"r_beta_formula", r.beta_formula}};
  found.conditions = {
      sign("alpha-q1", R"(\alpha \text{ decreases with } q_1)", slopes.alpha_q1, false),
      sign("beta-q1", R"(\beta \text{ decreases with } q_1)", slopes.beta_q1, false),
      sign("alpha-q2", R"(\alpha \text{ increases with } q_2)", slopes.alpha_q2, true),
      sign("beta-q2", R"(\beta \text{ increases with } q_2)", slopes.beta_q2, true),
      {"alpha-r",
       printed ? R"(\alpha \text{ is maximised at } r_\alpha)"
               : R"(\alpha \text{ is minimised at } r_\alpha)",
       r.alpha.finite() ? minimum : Verdict::undecided, r.alpha},
      {"beta-r", R"(\beta \text{ is minimised at } r_\beta)", proved_if(certainly_positive(r.beta)), r.beta},
      agrees("r_alpha", R"(r_\alpha \text{ is what the formula gives, to } 10^{-3})", r.alpha_formula,
             r.alpha),
      agrees("r_beta", R"(r_\beta \text{ is what the formula gives, to } 10^{-3})", r.beta_formula, r.beta)};
  // The table is for q1 <= q2, and for a sigma in its range.
  const bool ordered = d.q1_equals_q2 || certainly_at_most(d.q1, d.q2);
  const bool in_range = certainly_positive(d.sigma) && certainly_less(d.sigma, printed ? sqrt(half) : one);
  if (!ordered || !in_range) {
    for (Quantity& quantity : found.quantities) {
      quantity.value = Ball::everything();
    }
    for (Condition& condition : found.conditions) {
      condition.verdict = Verdict::undecided;
      condition.lhs.reset();
      condition.rhs.reset();
    }
  }
  return check_derivation(derivation, found, objections);
}

}  // namespace veritrack::checker

#include "analysis/theorems/other_results/total_stability.hpp"

#include <stdexcept>

#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/other_results/error_equation.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

const std::string kTotalStabilityTheorem = "thesis, theorem 2.6";

/// The Lipschitz constant of f(k, .) over the radius of the error equation, per unit of radius.
Interval lipschitz_rate(const ErrorEquation& equation) {
  return Interval(2.0) * equation.correction * equation.curvature;
}

/// The radius r with beta zeta(r) = share (1 - alpha), or the radius of the error equation.
Interval ball(const ErrorEquation& equation, double share) {
  return min(equation.radius,
             Interval(share) * equation.one_minus_alpha / (equation.beta * lipschitz_rate(equation)));
}

/// The error equation in which ball(., share) / beta is largest.
ErrorEquation best_equation(const TrackerInput& input, double share) {
  return error_equation(input, best_radius([&](const Interval& candidate) {
                          const ErrorEquation equation = error_equation(input, candidate);
                          return ball(equation, share) / equation.beta;
                        }));
}

/// An upper bound on |g(k)| for the assumed noise.
Interval perturbation(const TrackerInput& input, const ErrorEquation& equation) {
  const AssumedNoise noise = assumed_noise(input);
  return equation.correction * noise.process + equation.gain * noise.measurement;
}

void add_constants(Derivation& derivation, const ErrorEquation& equation, const Interval& r,
                   const Interval& zeta) {
  add_error_equation(derivation, equation);
  const std::string divides = "It divides by min(q_1, q_2), which may be 0 in this design.";
  add_quantity(derivation, {"r", "r", R"(\lvert e \rvert \le r)", "chosen here"}, r, divides);
  add_quantity(
      derivation,
      {"zeta", R"(\zeta)", R"(2 (\bar p / \underline q)^{1/2} \kappa_f r)", "docs/published-results.md"},
      zeta, divides);
}

Derivation evaluate(const TrackerInput& unchecked, bool with_noise) {
  const rigor::UpwardRounding upward;
  const TrackerInput input = with_finite_members(unchecked);
  const double share = with_noise ? 0.5 : 0.9375;
  const ErrorEquation equation = best_equation(input, share);
  const Interval r = ball(equation, share);
  const Interval zeta = lipschitz_rate(equation) * r;
  const Interval gap = equation.one_minus_alpha - equation.beta * zeta;  // 1 - (alpha + zeta beta)
  const Interval start = r / equation.beta;
  const Interval eta = perturbation(input, equation) / r;

  Derivation derivation;
  derivation.id = with_noise ? "total-stability" : "total-stability/corollary";
  derivation.title =
      with_noise ? "Total stability theorem (thesis, theorem 2.6) for the error equation of the tracker"
                 : "Corollary 2.6.1 of the thesis for the error equation of the tracker";
  add_constants(derivation, equation, r, zeta);
  derivation.conditions.push_back(start_covariance(input, equation));
  const Side margin{"1 - alpha", equation.one_minus_alpha};
  if (with_noise) {
    add_quantity(
        derivation,
        {"eta", R"(\eta)",
         R"(\frac{1}{r}\left(\lVert I - KH \rVert \lvert w \rvert + \lVert K \rVert \lvert v \rvert\right))",
         kTotalStabilityTheorem},
        eta);
    add_guarantee(derivation, {start, gap / equation.beta * r / equation.gain, Interval(1.0) - gap},
                  kTotalStabilityTheorem);
    derivation.conditions.push_back(compare("2.6", R"(\beta(\zeta + \eta) + \alpha < 1)",
                                            {"beta (zeta + eta)", equation.beta * (zeta + eta)}, margin));
    derivation.notes.emplace_back(
        "The thesis prints beta (alpha + zeta beta)^k |z_0| + beta eta r / (1 - alpha - zeta beta) <= r. "
        "That is false (alpha = zeta = 0, beta = r = 1, eta = |z_0| = 0.9, k = 0: the left side is 1.8); "
        "|z(k)| <= r is true nevertheless, since the geometric sum ends at k.");
    derivation.notes.emplace_back("noise_bound is for |w(k)| = 0; every smaller noise is tolerated, too.");
  } else {
    add_guarantee(derivation, {start, Interval::empty(), Interval(1.0) - gap}, "thesis, corollary 2.6.1",
                  "The corollary is for signals without noise.");
    derivation.conditions.push_back(
        compare("2.6.1", R"(\beta\zeta + \alpha < 1)", {"beta zeta", equation.beta * zeta}, margin));
    derivation.conditions.push_back(compare(
        "noise-free", R"(w(k) = 0, \quad v(k) = 0)",
        {"the largest perturbation |g(k)|", perturbation(input, equation)}, zero(), Strictness::weak));
  }
  derivation.conditions.push_back(start_error(input, R"(r / \beta)", start));
  conclude(derivation);
  return derivation;
}

/// The factor by which one step of the filter in its steady state multiplies an amplitude error while the
/// estimate is exact: 1 - K_1 = r/(p + q1 + r), p the positive root of p^2 + q1 p - q1 r = 0. Amplitude
/// and (phase, frequency) separate, so it is an eigenvalue of (I - KH)F at every step.
Interval amplitude_factor(const Theorem29Input& input) {
  const Interval root = sqrt(square(input.q1) + Interval(4.0) * input.q1 * input.r);
  const Interval p = (root - input.q1) / Interval(2.0);
  return input.r / (p + input.q1 + input.r);
}

}  // namespace

Interval total_stability_bound(const TotalStability& constants, const Interval& start, int k) {
  if (k < 0) {
    throw std::invalid_argument("the bound of theorem 2.6 begins at step 0");
  }
  const Interval rate = constants.alpha + constants.zeta * constants.beta;
  const Interval one(1.0);
  if (!certainly_less(rate, one)) {
    return Interval::empty();
  }
  return constants.beta * pow(rate, k) * start +
         constants.beta * constants.eta * constants.radius / (one - rate);
}

Derivation evaluate_total_stability(const TrackerInput& input) {
  return evaluate(input, true);
}

Derivation evaluate_total_stability_corollary(const TrackerInput& input) {
  return evaluate(input, false);
}

Derivation evaluate_theorem_2_7_printed(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  const Interval factor = amplitude_factor(input);
  const Interval least = Interval(3.0) * factor;
  Derivation derivation;
  derivation.id = "theorem-2.7/printed";
  derivation.title = "Theorem 2.7 of the thesis as printed, for the error equation of the tracker";
  add_quantity(derivation,
               {"amplitude_factor", "1 - K_1", R"(\frac{r}{p + q_1 + r}, \quad p^2 + q_1 p - q_1 r = 0)",
                "steady state of the amplitude, estimate exact"},
               factor);
  add_quantity(derivation,
               {"least_lhs", R"(\inf \left(\beta_2(\zeta + \eta) + \alpha_2\right))", "3(1 - K_1)",
                "zeta >= 2(1 - K_1), alpha_2 >= 1 - K_1, beta_2 >= 1, eta >= 0"},
               least);
  add_guarantee(derivation, {Interval::empty(), Interval::empty(), Interval::empty()}, "thesis, theorem 2.7");
  Condition condition =
      compare("2.7", R"(\beta_2(\zeta + \eta) + \alpha_2 < 1)",
              {"the least value of the left side over all choices, 3(1 - K_1),", least}, one());
  if (condition.verdict == rigor::Verdict::proved) {
    condition.verdict = rigor::Verdict::undecided;
    condition.reason = "The least value of the left side over all choices is below 1, which decides nothing.";
  }
  derivation.conditions.push_back(condition);
  derivation.notes.emplace_back(
      "zeta = 2 sup |Df| bounds a difference of two derivatives by their sum. Since 1 - K_1 does not depend "
      "on the size of the region, no region, start or noise is small enough: the condition requires a map "
      "that halves every error. Three times 1 - K_1 is 1 or more for every design with q_1 <= 4r/3.");
  conclude(derivation);
  return derivation;
}

Derivation evaluate_theorem_2_7_corrected(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const TrackerInput input = with_finite_members(unchecked);
  const Interval two(2.0);
  // beta (zeta + eta) + alpha_2 with zeta = (L/2) r_delta, alpha_2 = alpha + beta L r_x, r_delta = r_x/2, L
  // the Lipschitz rate: beta L r_x = (3/8)(1 - alpha) takes 15/32 of 1 - alpha and leaves the rest to the
  // noise.
  const double share = 0.375;
  const ErrorEquation equation = best_equation(input, share);
  const Interval r_x = ball(equation, share);
  const Interval r_delta = r_x / two;
  const Interval r_z = r_delta / equation.beta;
  const Interval rate_loss = equation.beta * lipschitz_rate(equation) * r_x;
  const Interval one_minus_alpha_2 = equation.one_minus_alpha - rate_loss;
  const Interval zeta = lipschitz_rate(equation) / two * r_delta;
  const Interval eta = perturbation(input, equation) / r_delta;
  const Interval gap = one_minus_alpha_2 - equation.beta * zeta;

  Derivation derivation;
  derivation.id = "theorem-2.7/corrected";
  derivation.title =
      "Theorem 2.7 of the thesis with its zeta corrected, for the error equation of the tracker";
  add_constants(derivation, equation, r_x, zeta);
  derivation.quantities.back().formula = R"((\bar p / \underline q)^{1/2} \kappa_f (r_x - \beta r_z))";
  add_quantity(
      derivation,
      {"one_minus_alpha_2", R"(1 - \alpha_2)",
       R"(1 - \alpha - 2\beta (\bar p / \underline q)^{1/2} \kappa_f r_x)", "C1 and C2 by corollary 2.6.1"},
      one_minus_alpha_2);
  add_quantity(derivation, {"r_z", "r_z", R"(\frac{r_x}{2\beta})", "chosen here"}, r_z);
  add_quantity(
      derivation,
      {"eta", R"(\eta)",
       R"(\frac{1}{r_x - \beta r_z}\left(\lVert I - KH \rVert \lvert w \rvert + \lVert K \rVert \lvert v \rvert\right))",
       "thesis, theorem 2.7"},
      eta);
  add_guarantee(derivation, {r_z, gap / equation.beta * r_delta / equation.gain, Interval(1.0) - gap},
                "thesis, theorem 2.7, zeta corrected");
  derivation.conditions = {
      start_covariance(input, equation),
      compare("2.7", R"(\beta_2(\zeta + \eta) + \alpha_2 < 1)",
              {"beta (zeta + eta)", equation.beta * (zeta + eta)}, {"1 - alpha_2", one_minus_alpha_2}),
      start_error(input, "r_z", r_z)};
  derivation.notes.emplace_back(
      "The term beta_2 (alpha_2 + zeta beta_2)^k |x_0| of the bound is not needed: the difference of the two "
      "solutions begins at 0. noise_bound is for |w(k)| = 0; every smaller noise is tolerated, too.");
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

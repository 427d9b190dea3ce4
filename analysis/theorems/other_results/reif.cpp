#include "analysis/theorems/other_results/reif.hpp"

#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/other_results/error_equation.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

const std::string kPaper = "Reif et al. 1999, theorem 3.1";
const std::string kOurs = "docs/published-results.md, after Reif et al. 1999";

/// The published constants; names as in the paper. The covariance bounded is P(k|k-1).
struct PublishedConstants {
  Interval p_lo, p_hi, alpha, kappa, epsilon;
};

PublishedConstants published_constants(const TrackerInput& input, const Interval& radius) {
  const ErrorEquation equation = error_equation(input, radius);
  const Interval one(1.0);
  const Interval two(2.0);
  PublishedConstants c;
  c.p_lo = equation.process;
  c.p_hi =
      square(equation.transition) * equation.covariance.largest + largest_process_noise(input.theorem_2_9);
  const Interval closed_loop = equation.transition * (one + c.p_hi / equation.measurement);
  const Interval ratio = equation.process / (c.p_hi * square(closed_loop));
  c.alpha = ratio / (one + ratio);
  const Interval kappa_phi = equation.curvature / two;
  c.kappa = kappa_phi / c.p_lo * (two * closed_loop + kappa_phi * radius);
  c.epsilon = min(radius, c.alpha / (two * c.p_hi * c.kappa));
  return c;
}

}  // namespace

Derivation evaluate_reif(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const TrackerInput input = with_finite_members(unchecked);
  const Interval radius =
      best_radius([&](const Interval& candidate) { return published_constants(input, candidate).epsilon; });
  const ErrorEquation equation = error_equation(input, radius);
  const PublishedConstants c = published_constants(input, radius);
  const Interval one(1.0);
  const Interval two(2.0);
  const Interval inside = c.epsilon * sqrt(c.p_lo / c.p_hi);
  // sqrt(V+) <= rate sqrt(V) + |s| / sqrt(p_lo), s = w - F K v; 1 - sqrt(1 - alpha/2) as a quotient.
  const Interval half = c.alpha / two;
  const Interval one_minus_rate = half / (one + sqrt(one - half));
  const Interval largest_noise = inside * one_minus_rate;
  const Interval gain = equation.transition * c.p_hi / equation.measurement;

  Derivation derivation;
  derivation.id = "reif-1999";
  derivation.title =
      "Stochastic stability of the EKF (Reif, Guenther, Yaz, Unbehauen 1999), constants as published";
  const std::string divides = "It divides by min(q_1, q_2), which may be 0 in this design.";
  add_quantity(derivation,
               {"epsilon_prime", R"(\epsilon')", R"(\lvert e \rvert \le \epsilon')", "chosen here"}, radius);
  add_quantity(derivation, {"a_bar", R"(\bar a)", R"(\sup \lVert F \rVert)", kPaper}, equation.transition);
  add_quantity(derivation, {"p_lo", R"(\underline p)", R"(\underline p I \le P(k \mid k-1))", kPaper}, c.p_lo,
               divides);
  add_quantity(derivation, {"p_hi", R"(\bar p)", R"(P(k \mid k-1) \le \bar p I)", kPaper}, c.p_hi);
  add_quantity(
      derivation,
      {"alpha", R"(\alpha)",
       R"(1 - \left(1 + \frac{\underline q}{\bar p (\bar a + \bar a \bar p \bar c^2 / \underline r)^2}\right)^{-1})",
       kPaper},
      c.alpha, divides);
  add_quantity(
      derivation,
      {"kappa", R"(\kappa)",
       R"(\frac{\kappa_\varphi}{\underline p}\left(2\left(\bar a + \frac{\bar a \bar p \bar c^2}{\underline r}\right) + \kappa_\varphi \epsilon'\right))",
       kPaper},
      c.kappa, divides);
  add_quantity(derivation,
               {"epsilon_published", R"(\epsilon)",
                R"(\min\left(\epsilon', \frac{\alpha}{2 \bar p \kappa}\right))", kPaper},
               c.epsilon, divides);
  add_guarantee(derivation, {inside, largest_noise / gain, one - one_minus_rate},
                "Reif et al. 1999 with the factor sqrt(p_lo / p_hi) and a noise condition");

  const AssumedNoise noise = assumed_noise(input);
  derivation.conditions = {
      compare("excitation", R"(0 < \underline q)", zero(),
              {"min(q_1, q_2)", smallest_process_noise(input.theorem_2_9)}),
      start_error(input, R"(\epsilon (\underline p / \bar p)^{1/2})", inside),
      compare(
          "noise",
          R"(\lvert w \rvert + \frac{\bar a \bar p}{\underline r} \lvert v \rvert < \left(1 - \sqrt{1 - \alpha/2}\right) \epsilon (\underline p / \bar p)^{1/2})",
          {"the largest disturbance allowed", noise.process + gain * noise.measurement},
          {"the disturbance that the ball tolerates", largest_noise})};
  derivation.notes = {
      "The paper treats the filter that linearises at the prediction; these constants are for that variant "
      "of the tracker, started with a covariance within its bounds.",
      "The paper's condition |e_0| <= epsilon keeps V from growing only while |e_k| <= epsilon, and V <= V_0 "
      "gives "
      "|e_k| <= sqrt(p_hi / p_lo) |e_0|: the start needs the factor sqrt(p_lo / p_hi)."};
  conclude(derivation);
  return derivation;
}

Derivation evaluate_reif_two_step(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const TrackerInput input = with_finite_members(unchecked);
  const Interval two(2.0);
  const auto growth = [&](const ErrorEquation& equation) {
    return equation.curvature / two * equation.correction;
  };
  const auto ball = [&](const ErrorEquation& equation) {
    return min(equation.radius, equation.one_minus_alpha / (two * growth(equation)));
  };
  const Interval radius = best_radius([&](const Interval& candidate) {
    const ErrorEquation equation = error_equation(input, candidate);
    return ball(equation) / equation.beta;
  });
  const ErrorEquation equation = error_equation(input, radius);
  const Interval epsilon = ball(equation);
  const Interval one_minus_rate = equation.one_minus_alpha - growth(equation) * epsilon;
  const Interval level = epsilon / sqrt(equation.covariance.largest);  // of sqrt(V)
  const Interval margin = one_minus_rate * level;

  Derivation derivation;
  derivation.id = "reif-1999/two-step";
  derivation.title = "The argument of Reif et al. (1999), carried out for the tracker's own filter";
  add_error_equation(derivation, equation);
  add_quantity(derivation,
               {"epsilon_ball", R"(\epsilon)", R"(\min\left(\rho, \frac{1 - \alpha}{2L}\right))", kOurs},
               epsilon, "It divides by min(q_1, q_2), which may be 0 in this design.");
  add_guarantee(
      derivation,
      {epsilon / equation.beta, margin * sqrt(equation.measurement), Interval(1.0) - one_minus_rate}, kOurs);

  const AssumedNoise noise = assumed_noise(input);
  derivation.conditions = {
      compare("excitation", R"(0 < \underline q)", zero(),
              {"min(q_1, q_2)", smallest_process_noise(input.theorem_2_9)}),
      start_covariance(input, equation), start_error(input, R"(\epsilon / \beta)", epsilon / equation.beta),
      compare(
          "noise",
          R"(\frac{\lvert w \rvert}{\sqrt{\underline q}} + \frac{\lvert v \rvert}{\sqrt r} < (1 - \alpha - L\epsilon) \frac{\epsilon}{\sqrt{\bar p}})",
          {"the largest disturbance allowed",
           noise.process / sqrt(equation.process) + noise.measurement / sqrt(equation.measurement)},
          {"the disturbance that the ball tolerates", margin})};
  derivation.notes = {
      "A leak acts like process noise of size epsilon |omega|: the model expects the frequency to decay, but "
      "the signal keeps its frequency.",
      "noise_bound is for |w(k)| = 0."};
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

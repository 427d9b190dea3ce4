#include "analysis/theorems/other_results/error_equation.hpp"

#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/signal_model.hpp"

namespace veritrack::theorems {

using rigor::Interval;
using rigor::Verdict;

namespace {

const std::string kProof = "docs/published-results.md";

Interval positive_or_empty(const Interval& x) {
  return certainly_positive(x) ? x : Interval::empty();
}

}  // namespace

ErrorEquation error_equation(const TrackerInput& input, const Interval& radius) {
  const Theorem29Input& design = input.theorem_2_9;
  const Interval one(1.0);
  ErrorEquation equation;
  equation.radius = radius;
  equation.transition = first_derivative_norm(one + radius, design.epsilon);
  equation.curvature = second_derivative_norm(one + radius);
  equation.covariance = covariance_range(input, radius);
  equation.process = positive_or_empty(smallest_process_noise(design));
  equation.measurement = positive_or_empty(design.r);
  const Interval& p_hi = equation.covariance.largest;
  const Interval gain = equation.process / (p_hi * square(equation.transition));
  const Interval alpha = one / sqrt(one + gain);
  equation.one_minus_alpha = gain / (one + gain) / (one + alpha);
  equation.beta = sqrt(p_hi / positive_or_empty(equation.covariance.smallest));
  equation.correction = sqrt(p_hi / equation.process);
  const Interval ratio = p_hi / equation.measurement;
  equation.gain = min(ratio, sqrt(ratio));
  return equation;
}

Interval best_radius(const std::function<Interval(const Interval&)>& value) {
  constexpr int kHalvings = 40;
  Interval best(0.5);
  double best_value = 0.0;
  Interval radius(0.5);
  for (int i = 0; i < kHalvings; ++i) {
    const Interval candidate = value(radius);
    if (is_finite(candidate) && candidate.lower() > best_value) {
      best_value = candidate.lower();
      best = radius;
    }
    radius *= Interval(0.5);
  }
  return best;
}

void add_guarantee(Derivation& derivation, const Guarantee& guarantee, const std::string& source,
                   const std::string& no_noise) {
  add_quantity(derivation,
               {"initial_frequency_error_bound", R"(\lvert e_0 \rvert)", "", source,
                "largest certified initial error, rad/sample", Sense::at_least},
               guarantee.initial_frequency_error,
               "No initial error satisfies the conditions for this design.");
  add_quantity(derivation,
               {"noise_bound", R"(\lvert v(k) \rvert)", "", source,
                "largest certified noise, over the amplitude", Sense::at_least},
               guarantee.noise,
               no_noise.empty() ? "No noise bound satisfies the conditions for this design." : no_noise);
  add_quantity(derivation, {"rate", "", "", source}, guarantee.rate, "No rate follows for this design.");
}

void add_error_equation(Derivation& derivation, const ErrorEquation& equation) {
  const std::string divides = "It divides by min(q_1, q_2), which may be 0 in this design.";
  add_quantity(derivation, {"radius", R"(\rho)", R"(\lvert e \rvert \le \rho)", "chosen here"},
               equation.radius);
  add_quantity(derivation, {"a_bar", R"(\bar a)", R"(\sup \lVert F \rVert)", kProof}, equation.transition);
  add_quantity(derivation, {"curvature", R"(\kappa_f)", R"(\sup \lVert D^2 f \rVert)", kProof},
               equation.curvature);
  add_quantity(derivation, {"p_lo", R"(\underline p)", R"(\underline p I \le P(k \mid k))", kProof},
               equation.covariance.smallest, divides);
  add_quantity(derivation, {"p_hi", R"(\bar p)", R"(P(k \mid k) \le \bar p I)", kProof},
               equation.covariance.largest);
  add_quantity(derivation,
               {"one_minus_alpha", R"(1 - \alpha)",
                R"(1 - \left(1 + \frac{\underline q}{\bar p \bar a^2}\right)^{-1/2})", kProof},
               equation.one_minus_alpha, divides);
  add_quantity(derivation, {"beta", R"(\beta)", R"((\bar p / \underline p)^{1/2})", kProof}, equation.beta,
               divides);
}

Condition start_covariance(const TrackerInput& input, const ErrorEquation& equation) {
  Condition condition{"start-covariance",          R"(\underline p I \le P(0 \mid 0) \le \bar p I)",
                      Verdict::undecided,          equation.covariance.smallest,
                      equation.covariance.largest, ""};
  const Interval& epsilon = input.theorem_2_9.epsilon;
  const bool known = is_finite(equation.covariance.smallest) && is_finite(equation.covariance.largest);
  if (known && input.initial_covariance) {
    condition.verdict = Verdict::proved;
    condition.reason = "The range was widened to include the given P(0|0).";
  } else if (known && input.starts_from_multiples) {
    condition.reason = "A range of multiples of the steady state is not proved to satisfy the bounds.";
  } else if (known && epsilon == Interval(0.0)) {
    condition.verdict = Verdict::proved;
    condition.reason =
        "P(0|0) is the steady state, which satisfies the bounds because its whole past is the steady state.";
  } else if (known) {
    condition.reason =
        "With a leak the steady state has |z| different from 1; it is not proved that the range contains it.";
  } else {
    condition.reason =
        "The range of the covariance is undefined, or overflows, for the values of this design.";
  }
  return condition;
}

Condition start_error(const TrackerInput& input, const std::string& bound_in_latex, const Interval& bound) {
  const std::string statement = R"(\lvert e_0 \rvert < )" + bound_in_latex;
  if (!input.theorem_2_9.initial_error) {
    return {"start",           statement, Verdict::undecided,
            Interval::empty(), bound,     "Nothing is assumed about the initial error."};
  }
  return compare("start", statement, {"the largest |e_0| allowed", *input.theorem_2_9.initial_error},
                 {"the bound on it", bound});
}

AssumedNoise assumed_noise(const TrackerInput& input) {
  return {input.theorem_2_9.process_noise.value_or(Interval::empty()),
          input.theorem_2_9.measurement_noise.value_or(Interval::empty())};
}

}  // namespace veritrack::theorems

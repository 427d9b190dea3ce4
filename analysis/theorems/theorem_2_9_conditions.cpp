#include "analysis/theorems/theorem_2_9_conditions.hpp"

#include <utility>

#include "analysis/statements/comparison.hpp"
#include "analysis/theorems/theorem_2_9_quantities.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// low < middle < high, each strict or weak: reported and explained by the two sides that failed first,
/// middle and high when none did.
Condition between(std::string id, std::string statement, const Side& low, Strictness low_strictness,
                  const Side& middle, const Side& high, Strictness high_strictness) {
  const Verdict above = decide(low.value, middle.value, low_strictness);
  const Verdict below = decide(middle.value, high.value, high_strictness);
  const Verdict verdict = rigor::conjunction({above, below});
  const bool lower_end_decided_it =
      above == Verdict::refuted || (above != Verdict::proved && below != Verdict::refuted);
  const Side& left = lower_end_decided_it ? low : middle;
  const Side& right = lower_end_decided_it ? middle : high;
  return {std::move(id), std::move(statement), verdict,
          left.value,    right.value,          explain(left, right, lower_end_decided_it ? above : below)};
}

/// The ranges of the free parameters.
void add_parameter_ranges(std::vector<Condition>& conditions, Theorem29Variant variant,
                          const Theorem29Input& input, const Theorem29Constants& c) {
  const auto strict = Strictness::strict;
  const bool printed = variant == Theorem29Variant::printed;
  const Side sigma_end = printed ? Side{"1/sqrt(2)", sqrt(Interval(0.5))} : one();
  conditions.push_back(between("sigma", printed ? R"(0 < \sigma < \frac{1}{\sqrt{2}})" : R"(0 < \sigma < 1)",
                               zero(), strict, {"sigma", input.sigma}, sigma_end, strict));
  conditions.push_back(between("epsilon_r", R"(0 < \epsilon_r < R_x)", zero(), strict,
                               {"epsilon_r", c.epsilon_r}, {"R_x", c.state_bound}, strict));
  conditions.push_back(between("gamma", R"(0 < \gamma s p^2 < 1)", zero(), strict,
                               {"gamma s p^2", input.gamma_fraction}, one(), strict));
  conditions.push_back(between("epsilon", R"(0 \le \epsilon < 1)", zero(), Strictness::weak,
                               {"the leak epsilon", input.epsilon}, one(), strict));
}

/// Adds to a condition on Q or R that the noise is within the bound that the theorem assumes.
void require_noise_bound(Condition& condition, const std::optional<Interval>& noise, const std::string& name,
                         const Side& bound) {
  if (condition.verdict == Verdict::refuted) {
    return;
  }
  const Side largest{"the largest " + name + " allowed", noise.value_or(Interval::empty())};
  const Verdict verdict = decide_less_equal(largest.value, bound.value);
  if (verdict != Verdict::proved) {
    condition.verdict = verdict;
    condition.lhs = largest.value;
    condition.rhs = bound.value;
    condition.reason = noise ? explain(largest, bound, verdict) : "Nothing is assumed about " + name + ".";
  }
}

/// (2.26). On the unit circle |x(k)| is at least 1 for every state.
Condition bounded_state(const Theorem29Input& input, const Theorem29Constants& c) {
  const std::string statement = R"(\lvert x(k) \rvert \le R_x)";
  const bool below_the_circle = certainly_less(c.state_bound, Interval(1.0));
  if (!input.largest_state && !below_the_circle) {
    return {"2.26",
            statement,
            Verdict::undecided,
            Interval::empty(),
            c.state_bound,
            "Nothing is assumed about |x(k)|."};
  }
  const Side state = input.largest_state ? Side{"the largest |x(k)| allowed", *input.largest_state}
                                         : Side{"|x(k)| on the unit circle", Interval(1.0)};
  const Verdict verdict = decide_less_equal(state.value, c.state_bound);
  return {"2.26",      statement,     verdict,
          state.value, c.state_bound, explain(state, {"R_x", c.state_bound}, verdict)};
}

/// The standing assumptions (2.24), (2.25), (2.26), (2.28), (2.29), as far as the constants and the
/// assumptions on the signal decide them.
void add_standing_assumptions(std::vector<Condition>& conditions, const Theorem29Input& input,
                              const Theorem29Constants& c) {
  const auto strict = Strictness::strict;
  const auto weak = Strictness::weak;
  Condition controllable =
      between("2.24", R"(0 < a_2 \le a_1)", zero(), strict, {"a_2 = q_1", c.a_2}, {"a_1 = q_2", c.a_1}, weak);
  Condition excited = between(
      "2.28",
      R"(0 < \delta_1, \quad \delta_1 I \le Q, \quad \lvert w(k) \rvert \le \lVert w \rVert = c_1 \sqrt{q_2})",
      zero(), strict, {"delta_1 = q_1", c.delta_1}, {"q_2", input.q2}, weak);
  if (input.q1_equals_q2) {
    for (Condition* condition : {&controllable, &excited}) {
      condition->verdict = decide_less(Interval(0.0), input.q1);
      condition->lhs = Interval(0.0);
      condition->rhs = input.q1;
      condition->reason = "q_1 and q_2 are the same number, at least " + at_least(input.q1) + ".";
    }
  }
  require_noise_bound(excited, input.process_noise, "|w(k)|", {"c_1 sqrt(q_2)", c.process_noise_bound});
  Condition measured = compare(
      "2.29",
      R"(0 < \delta_2, \quad \delta_2 I \le R, \quad \lvert v(k) \rvert \le \lVert v \rVert = c_2 \sqrt{r})",
      zero(), {"delta_2 = r", c.delta_2});
  require_noise_bound(measured, input.measurement_noise, "|v(k)|",
                      {"c_2 sqrt(r)", c.measurement_noise_bound});

  conditions.push_back(std::move(controllable));
  conditions.push_back(
      between("2.25", R"(0 < b_1 \le b_2)", zero(), strict, {"b_1", c.b_1}, {"b_2", c.b_2}, weak));
  conditions.push_back(bounded_state(input, c));
  conditions.push_back(std::move(excited));
  conditions.push_back(std::move(measured));
}

/// (2.43) to (2.45). The first two are decided against 1 - alpha: relative to 1 the left-hand sides have no
/// significant digit of it.
void add_stability_conditions(std::vector<Condition>& conditions, const Theorem29Input& input,
                              const Theorem29Constants& c) {
  const Side gap{"1 - alpha", c.one_minus_alpha};
  conditions.push_back(compare("2.43", R"(\beta(\zeta + \eta) + \alpha < 1)",
                               {"beta (zeta + eta)", c.perturbation_2_43}, gap));
  conditions.back().lhs = c.lhs_2_43;
  conditions.back().rhs = Interval(1.0);
  conditions.push_back(
      compare("2.44", R"(\beta\zeta_z + \alpha < 1)", {"beta zeta_z", c.perturbation_2_44}, gap));
  conditions.back().lhs = c.lhs_2_44;
  conditions.back().rhs = Interval(1.0);
  const std::string start = R"(\lvert e_0 \rvert < \epsilon_z (pq)^{-1/2})";
  const Side bound{"epsilon_z (pq)^(-1/2)", c.initial_error_bound};
  if (input.initial_error) {
    conditions.push_back(compare("2.45", start, {"the largest |e_0| allowed", *input.initial_error}, bound));
  } else {
    conditions.push_back({"2.45", start, Verdict::undecided, Interval::empty(), bound.value,
                          "Nothing is assumed about the initial error."});
  }
}

/// Where q1 may be zero, a condition that uses a quotient by q1 decides nothing, and says why.
void explain_divisions_by_q1(std::vector<Condition>& conditions, const Theorem29Input& input) {
  for (Condition& condition : conditions) {
    const std::string quantity = condition.id == "2.43"    ? "lhs_2_43"
                                 : condition.id == "2.44"  ? "lhs_2_44"
                                 : condition.id == "2.45"  ? "initial_error_bound"
                                 : condition.id == "gamma" ? "gamma"
                                                           : "";
    if (auto reason = why_not_applicable(quantity, input)) {
      condition.verdict = Verdict::undecided;
      condition.reason = std::move(*reason);
    }
  }
}

}  // namespace

std::vector<Condition> theorem_2_9_conditions(Theorem29Variant variant, const Theorem29Input& input,
                                              const Theorem29Constants& constants) {
  std::vector<Condition> conditions;
  add_parameter_ranges(conditions, variant, input, constants);
  add_standing_assumptions(conditions, input, constants);
  add_stability_conditions(conditions, input, constants);
  explain_divisions_by_q1(conditions, input);
  return conditions;
}

}  // namespace veritrack::theorems

#include "analysis/theorems/theorem_2_9.hpp"

#include <stdexcept>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/theorems/theorem_2_9_quantities.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::Verdict;

constexpr int kDigits = 6;

std::string at_least(const Interval& x) {
  return rigor::to_decimal(x.lower(), kDigits, Direction::down);
}
std::string at_most(const Interval& x) {
  return rigor::to_decimal(x.upper(), kDigits, Direction::up);
}

/// One side of an inequality: how the reason calls it, and what it is. A literal (0 or 1) is its own value.
struct Side {
  std::string words;
  Interval value;
  bool is_literal = false;
};

std::string not_known(const std::string& words) {
  return words + " is undefined, or overflows, for the values of this design.";
}

/// What decided left < right (or left <= right), in one sentence.
std::string explain(const Side& left, const Side& right, Verdict verdict) {
  if (verdict == Verdict::undecided) {
    if (!is_finite(left.value) || !is_finite(right.value)) {
      return not_known(is_finite(left.value) ? right.words : left.words);
    }
    const auto enclosed = [](const Side& side) {
      return side.is_literal ? side.words : side.words + " in " + rigor::to_decimal(side.value, kDigits);
    };
    return enclosed(left) + " and " + enclosed(right) + " are not told apart.";
  }
  const bool holds = verdict == Verdict::proved;
  const std::string left_end =
      holds ? " at most " + at_most(left.value) : " at least " + at_least(left.value);
  const std::string right_end =
      holds ? " at least " + at_least(right.value) : " at most " + at_most(right.value);
  if (left.is_literal) {
    return right.words + " is" + right_end + ".";
  }
  if (right.is_literal) {
    return left.words + " is" + left_end + ".";
  }
  return left.words + " is" + left_end + (holds ? " and " : " but ") + right.words + right_end + ".";
}

enum class Strictness { strict, weak };

Verdict decide(const Interval& left, const Interval& right, Strictness strictness) {
  return strictness == Strictness::strict ? decide_less(left, right) : decide_less_equal(left, right);
}

/// left < right, reported with the two sides that decided it.
Condition compare(std::string id, std::string statement, const Side& left, const Side& right) {
  const Verdict verdict = decide_less(left.value, right.value);
  return {std::move(id), std::move(statement), verdict,
          left.value,    right.value,          explain(left, right, verdict)};
}

/// low < middle < high, each strict or weak: reported as middle against high, explained by what failed first.
Condition between(std::string id, std::string statement, const Side& low, Strictness low_strictness,
                  const Side& middle, const Side& high, Strictness high_strictness) {
  const Verdict above = decide(low.value, middle.value, low_strictness);
  const Verdict below = decide(middle.value, high.value, high_strictness);
  const Verdict verdict = rigor::conjunction({above, below});
  const bool lower_end_decided_it =
      above == Verdict::refuted || (above != Verdict::proved && below != Verdict::refuted);
  return {std::move(id), std::move(statement),
          verdict,       middle.value,
          high.value,    lower_end_decided_it ? explain(low, middle, above) : explain(middle, high, below)};
}

Side zero() {
  return {"0", Interval(0.0), true};
}
Side one() {
  return {"1", Interval(1.0), true};
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

/// The standing assumptions (2.24), (2.25), (2.28), (2.29), as far as the constants decide them.
void add_standing_assumptions(std::vector<Condition>& conditions, const Theorem29Input& input,
                              const Theorem29Constants& c) {
  const auto strict = Strictness::strict;
  const auto weak = Strictness::weak;
  Condition controllable =
      between("2.24", R"(0 < a_2 \le a_1)", zero(), strict, {"a_2 = q_1", c.a_2}, {"a_1 = q_2", c.a_1}, weak);
  Condition excited =
      between("2.28", R"(0 < \delta_1, \quad \delta_1 I \le Q, \quad 0 \le \lVert w \rVert < \infty)", zero(),
              strict, {"delta_1 = q_1", c.delta_1}, {"q_2", input.q2}, weak);
  if (input.q1_equals_q2) {
    for (Condition* condition : {&controllable, &excited}) {
      condition->verdict = decide_less(Interval(0.0), input.q1);
      condition->reason = "q_1 and q_2 are the same number, at least " + at_least(input.q1) + ".";
    }
  }
  const Verdict process_noise = decide_less_equal(Interval(0.0), c.process_noise_bound);
  if (process_noise != Verdict::proved && excited.verdict != Verdict::refuted) {
    excited.verdict = process_noise;
    excited.reason = explain(zero(), {"c_1 sqrt(q_2)", c.process_noise_bound}, process_noise);
  }
  Condition measured =
      compare("2.29", R"(0 < \delta_2, \quad \delta_2 I \le R, \quad 0 \le \lVert v \rVert < \infty)", zero(),
              {"delta_2 = r", c.delta_2});
  const Verdict measurement_noise = decide_less_equal(Interval(0.0), c.measurement_noise_bound);
  if (measurement_noise != Verdict::proved && measured.verdict != Verdict::refuted) {
    measured.verdict = measurement_noise;
    measured.reason = explain(zero(), {"c_2 sqrt(r)", c.measurement_noise_bound}, measurement_noise);
  }
  conditions.push_back(std::move(controllable));
  conditions.push_back(
      between("2.25", R"(0 < b_1 \le b_2)", zero(), strict, {"b_1", c.b_1}, {"b_2", c.b_2}, weak));
  conditions.push_back(std::move(excited));
  conditions.push_back(std::move(measured));
}

/// (2.43) to (2.45). The first two are decided against 1 - alpha: next to 1 the left-hand sides carry no
/// digit of it.
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
                          "Nothing is assumed of the initial error."});
  }
}

/// Where q1 may be zero, a condition made of what divides by it decides nothing, and says why.
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

std::vector<std::string> notes(Theorem29Variant variant, const Theorem29Input& input) {
  std::vector<std::string> result;
  if (variant == Theorem29Variant::errata) {
    result.emplace_back(
        "The errata sheet leaves epsilon_r free in (0, 1) and uses sigma as a lower bound on w_3; "
        "epsilon_r = 1 - sigma is our choice.");
  }
  if (!input.q1_equals_q2 && certainly_less(input.q2, input.q1)) {
    result.emplace_back(
        "q_1 > q_2: the thesis warns of this in the footnote to section 3.5. The formulas are evaluated as "
        "printed, "
        "but a_2 = q_1 and a_1 = q_2 then do not bound the controllability Gramian.");
  }
  result.emplace_back(
      "(2.24), (2.25), (2.28) and (2.29) are decided for the constants that the thesis lists; whether these "
      "constants "
      "bound the Gramians along a trajectory is not decided here.");
  result.emplace_back(
      "(2.26) and the noise bounds |w| <= c_1 sqrt(q_2), |v| <= c_2 sqrt(r) are assumptions on the signal.");
  return result;
}

void validate(const Theorem29Input& input) {
  if (input.q2.lower() <= 0.0) {
    throw std::invalid_argument("Theorem 2.9 needs q2 > 0");
  }
  if (input.r.lower() <= 0.0) {
    throw std::invalid_argument("Theorem 2.9 needs r > 0");
  }
  if (input.q1.lower() < 0.0) {
    throw std::invalid_argument("Theorem 2.9 needs q1 >= 0");
  }
  if (input.q1_equals_q2 && is_finite(input.q1) && is_finite(input.q2) &&
      is_empty(intersection(input.q1, input.q2))) {
    throw std::invalid_argument("q1 and q2 are said to be equal but their enclosures are not");
  }
}

}  // namespace

Theorem29 evaluate_theorem_2_9(Theorem29Variant variant, const Theorem29Input& unchecked) {
  validate(unchecked);
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked);
  Theorem29 theorem;
  theorem.constants = theorem_2_9_constants(variant, input);
  const Theorem29Constants& c = theorem.constants;

  Derivation& derivation = theorem.derivation;
  const bool printed = variant == Theorem29Variant::printed;
  derivation.id = printed ? "theorem-2.9/printed" : "theorem-2.9/errata";
  derivation.title = printed ? "Theorem 2.9 (EKF stability) as printed in the 1994 thesis"
                             : "Theorem 2.9 (EKF stability) with the errata sheet of the 1994 thesis";
  derivation.quantities = theorem_2_9_quantities(variant, input, c);
  add_parameter_ranges(derivation.conditions, variant, input, c);
  add_standing_assumptions(derivation.conditions, input, c);
  add_stability_conditions(derivation.conditions, input, c);
  explain_divisions_by_q1(derivation.conditions, input);
  derivation.notes = notes(variant, input);

  std::vector<Verdict> verdicts;
  for (const Condition& condition : derivation.conditions) {
    verdicts.push_back(condition.verdict);
  }
  derivation.verdict = rigor::conjunction(verdicts);
  if (derivation.verdict == Verdict::proved && input.initial_error) {
    theorem.error_bound = make_error_bound(
        {c.state_bound, c.beta, c.one_minus_alpha, c.zeta, c.eta, c.epsilon_z, *input.initial_error});
  }
  return theorem;
}

}  // namespace veritrack::theorems

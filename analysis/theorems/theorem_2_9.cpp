#include "analysis/theorems/theorem_2_9.hpp"

#include <stdexcept>

#include "analysis/theorems/theorem_2_9_conditions.hpp"
#include "analysis/theorems/theorem_2_9_quantities.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Verdict;

std::vector<std::string> notes(Theorem29Variant variant, const Theorem29Input& input) {
  std::vector<std::string> result;
  if (variant == Theorem29Variant::errata) {
    result.emplace_back(
        "The errata sheet leaves epsilon_r free in (0, 1) and uses sigma as a lower bound on w_3; "
        "epsilon_r = 1 - sigma is our choice.");
  }
  // cannot bind (input.q2): a note, on which nothing depends.
  if (!input.q1_equals_q2 && certainly_less(input.q2, input.q1)) {
    result.emplace_back(
        "q_1 > q_2: the thesis warns of this in the footnote to section 3.5. The formulas are evaluated as "
        "printed, but a_2 = q_1 and a_1 = q_2 then do not bound the controllability Gramian.");
  }
  result.emplace_back(
      "(2.24), (2.25), (2.28) and (2.29) are decided for the constants that the thesis lists; whether these "
      "constants bound the Gramians along a trajectory is not decided here.");
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
  derivation.conditions = theorem_2_9_conditions(variant, input, c);
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

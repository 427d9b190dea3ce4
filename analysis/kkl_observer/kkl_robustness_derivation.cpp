#include <string>
#include <utility>

#include "analysis/kkl_observer/kkl_robustness.hpp"
#include "analysis/kkl_observer/kkl_worst_case.hpp"
#include "analysis/rigor/decimal.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Sense;

constexpr const char* kSource = "docs/kkl-observer.md";

theorems::Quantity robustness_quantity(std::string name, std::string symbol, std::string formula,
                                       const Interval& value, Sense sense, std::string words) {
  theorems::Quantity result{
      std::move(name), std::move(symbol), std::move(formula), kSource, value, std::nullopt,
      sense,           std::move(words)};
  if (rigor::is_empty(value)) {
    result.not_applicable = "No applicable bound was found: see the conditions.";
  }
  return result;
}

theorems::Condition regular_condition(const KklRobustness& found, const Interval& ell) {
  theorems::Condition condition{
      "regular", "\\ell \\le 2 \\inf |M\\xi|^2 / |\\xi|^2", Verdict::undecided, ell, found.largest_ell, {}};
  if (!found.knows_filters) {
    condition.reason =
        "the filters of the program cannot be bounded: a sinusoidal disturbance of any frequency from the "
        "assumed one up may have any samples (assume a bound in its place), or the sampling interval is too "
        "short for double precision.";
  } else if (rigor::certainly_less_equal(ell, found.largest_ell)) {
    condition.verdict = Verdict::proved;
    condition.reason =
        "mu of (9) vanishes at every filter state that the disturbance can cause: the bounds apply.";
  } else {
    condition.reason =
        "the ell in use is not proved to be small enough for mu of (9) to vanish under the disturbance";
    // cannot bind (found.largest_ell): it chooses words, next to a verdict that was reached without it.
    condition.reason += rigor::is_finite(found.largest_ell) && rigor::certainly_positive(found.largest_ell)
                            ? " (" + rigor::lower_decimal(found.largest_ell) +
                                  " is small enough): the bounds are for an observer with a smaller ell."
                            : ", and no ell was found that is.";
  }
  return condition;
}

constexpr const char* kOtherObserver =
    "the bounds are for an observer with an ell for which mu of (9) vanishes, not for the one in use.";

theorems::Condition frequency_condition(const KklRobustness& found, bool regular) {
  theorems::Condition condition{"frequency-exists",
                                "\\hat x_3 / x_3 > 0",
                                Verdict::undecided,
                                regular ? found.smallest_relative_square : Interval(),
                                Interval(0.0),
                                {},
                                theorems::Sense::at_least};
  if (!regular) {
    condition.reason = kOtherObserver;
  } else if (rigor::certainly_positive(found.smallest_relative_square)) {
    condition.verdict = Verdict::proved;
    condition.reason = "the estimate of the squared frequency stays positive under the disturbance.";
  } else {
    condition.reason =
        "under the disturbance the estimate of the squared frequency may reach zero, where it gives no "
        "frequency.";
  }
  return condition;
}

theorems::Condition bounded_condition(const KklRobustness& found, bool regular, const std::string& over) {
  theorems::Condition condition{
      "bounded",          "|\\hat\\omega - \\omega| \\le b_\\omega,\\ |\\hat A - A| \\le b_A",
      Verdict::undecided, regular ? found.frequency_error_bound : Interval(),
      Interval(),         {}};
  if (!regular) {
    condition.reason = kOtherObserver;
  } else if (rigor::is_finite(found.frequency_error_bound) && rigor::is_finite(found.amplitude_error_bound)) {
    condition.verdict = Verdict::proved;
    condition.reason = "branch and bound over " + over + ", " + std::to_string(found.cells) +
                       " cells; rounding of the estimates adds at most " +
                       rigor::upper_decimal(found.rounding, 3) + " rad/s.";
  } else {
    condition.reason = "branch and bound found no finite bound within " + std::to_string(found.cells) +
                       " cells, or rounding of the estimates has none.";
  }
  return condition;
}

}  // namespace

template <int M>
theorems::Derivation derive_kkl_robustness(const KklRobustnessQuestionOf<M>& question) {
  const KklRobustness found = bound_kkl_errors(question);
  const SampledErrors sampled = sample_errors(question);
  const rigor::UpwardRounding upward;
  const theorems::Condition regular = regular_condition(found, question.ell);
  // Bounds for the observer with a smaller ell are not bounds for the one in use.
  const bool is_regular = regular.verdict == Verdict::proved;
  const theorems::Condition exists = frequency_condition(found, is_regular);
  const bool applies = is_regular && exists.verdict == Verdict::proved;
  const auto bound = [applies](const Interval& value) { return applies ? value : Interval(); };
  theorems::Derivation derivation;
  derivation.id = "kkl-robustness";
  derivation.title = "Bounds on the estimation errors under the assumed disturbance";
  derivation.quantities = {
      robustness_quantity("frequency_error_bound", "b_\\omega", "\\sup_{t \\ge t_s} |\\hat\\omega - \\omega|",
                          bound(found.frequency_error_bound), Sense::at_most,
                          "frequency error once settled, rad/s"),
      robustness_quantity("amplitude_error_bound", "b_A", "\\sup_{t \\ge t_s} |\\hat A - A|",
                          bound(found.amplitude_error_bound), Sense::at_most,
                          "amplitude error once settled, signal units"),
      robustness_quantity("settling_time", "t_s", "", found.settling_time, Sense::at_most,
                          "settled after, s"),
      robustness_quantity("largest_ell", "2 \\inf |M\\xi|^2 / |\\xi|^2", "", found.largest_ell,
                          Sense::at_least, "an ell up to which the disturbed inverse is exact"),
      robustness_quantity("frequency_error_simulated", "", "\\max |\\hat\\omega - \\omega|",
                          Interval(sampled.frequency), Sense::sampled,
                          "largest frequency error seen in simulation, rad/s"),
      robustness_quantity("amplitude_error_simulated", "", "\\max |\\hat A - A|", Interval(sampled.amplitude),
                          Sense::sampled, "largest amplitude error seen in simulation, signal units")};
  derivation.conditions = {
      regular, exists, bounded_condition(found, is_regular, M > 4 ? "signals" : "signal and disturbance")};
  derivation.verdict = rigor::conjunction(
      {derivation.conditions[0].verdict, derivation.conditions[1].verdict, derivation.conditions[2].verdict});
  derivation.notes = {
      "The bounds are valid from the settling time on, for every signal of the assumed range, if the filters "
      "start at rest with the signal. They are about estimates computed in double precision "
      "(docs/rounding.md). "
      "A sinusoidal disturbance may have any phase and any frequency at or "
      "above the assumed one.",
      "The simulated errors are the largest over a grid of signals. They prove nothing, but show how tight "
      "the bounds are."};
  if (M > 4) {
    derivation.notes.emplace_back(
        "With more than four filters the bounds take the error of the squared frequency as linear in what "
        "the disturbance does to the filters, plus a bound on the rest (docs/kkl-observer.md).");
  }
  return derivation;
}

template theorems::Derivation derive_kkl_robustness<4>(const KklRobustnessQuestionOf<4>&);
template theorems::Derivation derive_kkl_robustness<5>(const KklRobustnessQuestionOf<5>&);
template theorems::Derivation derive_kkl_robustness<6>(const KklRobustnessQuestionOf<6>&);
template theorems::Derivation derive_kkl_robustness<7>(const KklRobustnessQuestionOf<7>&);
template theorems::Derivation derive_kkl_robustness<8>(const KklRobustnessQuestionOf<8>&);

}  // namespace veritrack::kkl_observer

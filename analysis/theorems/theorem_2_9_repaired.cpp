#include "analysis/theorems/theorem_2_9_repaired.hpp"

#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/signal_model.hpp"
#include "analysis/theorems/theorem_2_9_repaired_search.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr const char* kNotBorne = "No tube was found that tolerates the assumed noise.";

void add_quantities(Derivation& derivation, const Repaired& found) {
  const Interval none;
  const auto add = [&](const char* name, const char* symbol, const char* formula, const Interval& value,
                       Sense sense = Sense::enclosure) {
    add_quantity(derivation, {name, symbol, formula, kRepairedProof, "", sense}, value, kNoRepairedRecursion);
  };
  const auto of_start = [&](auto value) { return found.start ? value(*found.start) : none; };
  using R = const ErrorRecursion&;
  add("window", "N", "", of_start([](R r) { return Interval(r.window); }));
  add("epsilon_r", R"(\epsilon_r)", R"(\sup\lvert \hat z(k|k) - z(k) \rvert)",
      of_start([](R r) { return r.tube.plane_error; }));
  add("rho_1", R"(\rho_1)", R"(\sup_{\lvert \hat z \rvert \le 1 + \epsilon_r} \lVert \partial f \rVert)",
      of_start([&](R r) {
        return first_derivative_norm(Interval(1.0) + r.tube.plane_error, found.design.epsilon);
      }));
  add("delta_1", R"(\delta_1)", "q_1", found.design.q1);
  add("delta_2", R"(\delta_2)", "r", found.design.r);
  add("p", "p", R"(\sup \lambda_{\max}(P(k|k)))", of_start([](R r) { return r.p; }));
  add("q", "q", R"(\sup \lambda_{\max}(P(k|k)^{-1}))", of_start([](R r) { return r.q; }));
  add("s", "s", R"(\sup \lambda_{\max}(P(k+1|k)))", of_start([](R r) { return r.s; }), Sense::at_most);
  add("beta", R"(\beta)", R"((pq)^{1/2})", of_start([](R r) { return sqrt(r.p * r.q); }));
  add("one_minus_alpha", R"(1 - \alpha)", R"(1 - (\mu/(1 + \mu))^{1/2}, \quad F P F' \le \mu Q)",
      of_start([](R r) { return r.one_minus_alpha; }), Sense::at_least);
  add("curvature", "c", R"(\lvert \varphi \rvert_{P(k+1|k)^{-1}} \le c W^2)",
      of_start([](R r) { return r.curvature; }), Sense::at_most);
  add("process_gain", "g_w", "", of_start([](R r) { return r.process_gain; }), Sense::at_most);
  add("measurement_gain", "g_v", "", of_start([](R r) { return r.measurement_gain; }), Sense::at_most);
  add("radius", "R", R"(\alpha R + c R^2 \le R)", found.start ? found.start_radius : none);
  add("epsilon_z", R"(\epsilon_z)", R"(p^{1/2} R)",
      of_start([&](R r) { return sqrt(r.p) * found.start_radius; }));
  add("initial_error_bound", R"(\epsilon_z (pq)^{-1/2})", R"(q^{-1/2} R)",
      of_start([&](R r) { return start_error(r, found.start_radius); }));
  add("initial_frequency_error_bound", R"(\lvert e_3(0) \rvert)", R"(R / (P(0|0)^{-1})_{33}^{1/2})",
      of_start([&](R r) { return start_frequency_error(r, found.start_radius); }));
  add("rate", R"(\alpha)", R"((\mu/(1 + \mu))^{1/2})", of_start([](R r) { return r.alpha; }), Sense::at_most);
  add("noise_bound", R"(\lVert v \rVert)", R"(\max_R ((1 - \alpha) R - c R^2)/g_v)",
      found.noise ? found.noise->largest_disturbance() / found.noise->measurement_gain : none,
      Sense::at_least);
  add("process_noise_bound", R"(\lVert w \rVert)", R"(\max_R ((1 - \alpha) R - c R^2)/g_w)",
      found.process ? found.process->largest_disturbance() / found.process->process_gain : none,
      Sense::at_least);
}

Condition not_found(const char* id, const char* statement, const char* reason) {
  return {id, statement, Verdict::undecided, Interval::empty(), Interval::empty(), reason};
}

/// P(0|0) lies in the range of the Riccati bounds, and so does P(k|k) before the window is full.
Condition start_covariance(const Repaired& found, const TrackerInput& input) {
  Condition condition =
      not_found("P(0|0)", R"(q^{-1} I \le P(k|k) \le p I \text{ from } k = 0)",
                "It is not proved that the bounds on P(k|k) are valid before the window is full.");
  if (!found.assumed) {
    condition.reason = kNotBorne;
    return condition;
  }
  const ErrorRecursion& recursion = *found.assumed;
  if (input.initial_covariance) {
    // A step preserves the Loewner order: what lies between two ends that stay in the range stays there.
    const auto decide = [&](const rigor::IntervalMatrix<3>& start) {
      return decide_start(start, recursion.range, found.design, recursion.tube, recursion.window);
    };
    condition.verdict = decide(*input.initial_covariance);
    if (input.largest_initial_covariance) {
      condition.verdict = rigor::conjunction({condition.verdict, decide(*input.largest_initial_covariance)});
    }
    if (condition.verdict == Verdict::proved) {
      condition.reason =
          "The covariances up to the end of the window were enclosed and lie within the bounds.";
    }
  } else if (input.starts_from_multiples) {
    condition.reason = "Nothing is shown of a range of multiples of the steady state.";
  } else if (found.design.without_leak()) {
    condition.verdict = Verdict::proved;
    condition.reason =
        "The steady state is the result of an infinite past of exact estimates, into which the window "
        "extends.";
  } else {
    condition.reason =
        "With a leak the filter's steady state depends on the frequency; the bounds are valid for the steady "
        "state along exact estimates.";
  }
  return condition;
}

void add_conditions(Derivation& derivation, const Repaired& found, const Theorem29Input& input,
                    const TrackerInput& question) {
  const Interval smallest = min(input.q1, input.q2);
  derivation.conditions.push_back(compare("Q", "0 < Q", zero(), {"min(q_1, q_2)", smallest}));
  Condition leak = compare("epsilon", R"(0 \le \epsilon < 1)", {"the leak epsilon", input.epsilon}, one());
  leak.verdict = rigor::conjunction({leak.verdict, decide_less_equal(Interval(0.0), input.epsilon)});
  derivation.conditions.push_back(std::move(leak));
  constexpr const char* kInvariance = R"(\alpha R + c R^2 + g_w \lVert w \rVert + g_v \lVert v \rVert \le R)";
  if (!found.assumed) {
    derivation.conditions.push_back(not_found("invariance", kInvariance, kNotBorne));
  } else {
    const ErrorRecursion& r = *found.assumed;
    const Interval& radius = found.assumed_radius;
    derivation.conditions.push_back(
        {"invariance", kInvariance, r.decide_invariant(radius, found.disturbance),
         r.alpha * radius + r.curvature * square(radius) + found.disturbance, radius,
         "Decided without the cancellation: c R^2 + noise <= (1 - alpha) R.", Sense::at_most});
  }
  derivation.conditions.push_back(start_covariance(found, question));
  constexpr const char* kStart = R"(\lvert e_0 \rvert \le q^{-1/2} R)";
  if (found.assumed && input.initial_error) {
    derivation.conditions.push_back(
        compare("2.45", kStart, {"the largest |e_0| allowed", *input.initial_error},
                {"q^(-1/2) R", start_error(*found.assumed, found.assumed_radius)}, Strictness::weak));
    if (derivation.conditions.back().verdict == Verdict::refuted) {
      derivation.conditions.back().verdict = Verdict::undecided;  // another tube might tolerate it
    }
  } else {
    derivation.conditions.push_back(
        not_found("2.45", kStart, "No start is certified under the assumed noise."));
  }
}

/// The bounds for the assumed start and noise; only if the conditions are proved.
void add_assured(Derivation& derivation, const Repaired& found) {
  constexpr const char* kWhyNot = "The conditions are not all proved.";
  const bool assured = derivation.verdict == Verdict::proved;
  add_quantity(
      derivation,
      {"frequency_error_bound", R"(\sup_k \lvert e_3(k) \rvert)", R"(P_{33}^{1/2} R)", kRepairedProof},
      assured ? found.assumed->frequency_gain * found.assumed_radius : Interval::empty(), kWhyNot);
  add_quantity(derivation,
               {"ultimate_frequency_error", R"(\limsup_k \lvert e_3(k) \rvert)", R"(P_{33}^{1/2} R_-)",
                kRepairedProof, "", Sense::at_most},
               assured ? found.assumed->frequency_gain * found.assumed->ultimate_radius(found.disturbance)
                       : Interval::empty(),
               kWhyNot);
}

}  // namespace

Derivation derive_repaired_theorem(const TrackerInput& question) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(question.theorem_2_9);
  const Repaired found = search_repaired(input);
  Derivation derivation;
  derivation.id = "theorem-2.9/repaired";
  derivation.title = "Theorem 2.9 repaired: error and noise bounds with every gap of the proof closed";
  add_quantities(derivation, found);
  add_conditions(derivation, found, input, question);
  conclude(derivation);
  add_assured(derivation, found);
  derivation.feasibility = repaired_feasibility(found);
  derivation.evidence = repaired_evidence(found);
  derivation.notes = {
      "W(k)^2 = e(k)' P(k|k)^-1 e(k) with the filter's own P(k|k), for any past: the proof uses only bounds "
      "on P that are valid for every run in the tube.",
      "The largest start and the largest noise are certified separately: start errors assume no noise; noise "
      "limits assume an exact start. initial_frequency_error_bound assumes exact phase and amplitude.",
      "Start and noise bounds are for w = 0, a frequency that leaks as in (3.1). With a leak, a constant "
      "frequency omega is modelled as process noise epsilon omega, which must not exceed "
      "process_noise_bound."};
  return derivation;
}

}  // namespace veritrack::theorems

#include "analysis/theorems/theorem_2_9_repaired.hpp"

#include "analysis/theorems/comparison.hpp"
#include "analysis/theorems/derivation_builder.hpp"
#include "analysis/theorems/error_recursion_search.hpp"
#include "analysis/theorems/signal_model.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr const char* kProof = "docs/repaired-theorem.md";
constexpr const char* kNotBorne = "No tube was found that bears the assumed noise.";
constexpr const char* kNoRecursion =
    "No tube around the signal was found in which the covariance bounds make the error shrink.";

/// The parts of the derivation. A recursion is empty if none was found.
struct Repaired {
  IntervalDesign design;
  std::optional<ErrorRecursion> start, noise, process, assumed;
  Interval start_radius;  ///< of `start`, without noise
  Interval disturbance;   ///< assumed: g_w |w| + g_v |v|
  Interval assumed_radius;
};

/// W(0) <= R is certain for |e(0)| <= R / sqrt(q).
Interval start_error(const ErrorRecursion& recursion, const Interval& radius) {
  return radius / sqrt(recursion.q);
}

/// The same for an error of the frequency alone.
Interval start_frequency_error(const ErrorRecursion& recursion, const Interval& radius) {
  return radius / sqrt(recursion.range.information(2, 2));
}

Interval disturbance_of(const ErrorRecursion& recursion, const Interval& process_noise,
                        const Interval& measurement_noise) {
  return recursion.process_gain * process_noise + recursion.measurement_gain * measurement_noise;
}

/// A radius that is verified to be invariant under the disturbance; empty otherwise.
Interval verified_radius(const ErrorRecursion& recursion, const Interval& disturbance) {
  const Interval radius = recursion.propose_radius(disturbance);
  return recursion.decide_invariant(radius, disturbance) == Verdict::proved ? radius : Interval::empty();
}

Repaired search(const Theorem29Input& input) {
  Repaired found;
  found.design = {input.q1, input.q2, input.r, input.epsilon};
  const Interval zero(0.0);
  const std::vector<ErrorRecursion> ladder = recursion_ladder(found.design);
  found.start = best_recursion(ladder, [&](const ErrorRecursion& recursion) {
    return start_frequency_error(recursion, verified_radius(recursion, zero)).lower();
  });
  found.noise = best_recursion(ladder, [](const ErrorRecursion& recursion) {
    return (recursion.largest_disturbance() / recursion.measurement_gain).lower();
  });
  found.process = best_recursion(ladder, [](const ErrorRecursion& recursion) {
    return (recursion.largest_disturbance() / recursion.process_gain).lower();
  });
  if (found.start) {
    found.start_radius = verified_radius(*found.start, zero);
  }
  if (input.process_noise && input.measurement_noise) {
    const auto disturbance = [&](const ErrorRecursion& recursion) {
      return disturbance_of(recursion, *input.process_noise, *input.measurement_noise);
    };
    found.assumed = best_recursion(ladder, [&](const ErrorRecursion& recursion) {
      return start_error(recursion, verified_radius(recursion, disturbance(recursion))).lower();
    });
    if (found.assumed) {
      found.disturbance = disturbance(*found.assumed);
      found.assumed_radius = verified_radius(*found.assumed, found.disturbance);
    }
  }
  return found;
}

void add_quantities(Derivation& derivation, const Repaired& found) {
  const Interval none;
  const auto add = [&](const char* name, const char* symbol, const char* formula, const Interval& value) {
    add_quantity(derivation, {name, symbol, formula, kProof}, value, kNoRecursion);
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
  add("s", "s", R"(\sup \lambda_{\max}(P(k+1|k)))", of_start([](R r) { return r.s; }));
  add("beta", R"(\beta)", R"((pq)^{1/2})", of_start([](R r) { return sqrt(r.p * r.q); }));
  add("one_minus_alpha", R"(1 - \alpha)", R"(1 - (\mu/(1 + \mu))^{1/2}, \quad F P F' \le \mu Q)",
      of_start([](R r) { return r.one_minus_alpha; }));
  add("curvature", "c", R"(\lvert \varphi \rvert_{P(k+1|k)^{-1}} \le c W^2)",
      of_start([](R r) { return r.curvature; }));
  add("process_gain", "g_w", "", of_start([](R r) { return r.process_gain; }));
  add("measurement_gain", "g_v", "", of_start([](R r) { return r.measurement_gain; }));
  add("radius", "R", R"(\alpha R + c R^2 \le R)", found.start ? found.start_radius : none);
  add("epsilon_z", R"(\epsilon_z)", R"(p^{1/2} R)",
      of_start([&](R r) { return sqrt(r.p) * found.start_radius; }));
  add("initial_error_bound", R"(\epsilon_z (pq)^{-1/2})", R"(q^{-1/2} R)",
      of_start([&](R r) { return start_error(r, found.start_radius); }));
  add("initial_frequency_error_bound", R"(\lvert e_3(0) \rvert)", R"(R / (P(0|0)^{-1})_{33}^{1/2})",
      of_start([&](R r) { return start_frequency_error(r, found.start_radius); }));
  add("rate", R"(\alpha)", R"((\mu/(1 + \mu))^{1/2})", of_start([](R r) { return r.alpha; }));
  add("noise_bound", R"(\lVert v \rVert)", R"(\max_R ((1 - \alpha) R - c R^2)/g_v)",
      found.noise ? found.noise->largest_disturbance() / found.noise->measurement_gain : none);
  add("process_noise_bound", R"(\lVert w \rVert)", R"(\max_R ((1 - \alpha) R - c R^2)/g_w)",
      found.process ? found.process->largest_disturbance() / found.process->process_gain : none);
}

Condition not_found(const char* id, const char* statement, const char* reason) {
  return {id, statement, Verdict::undecided, Interval::empty(), Interval::empty(), reason};
}

/// P(0|0) lies in the range of the Riccati bounds, and so does P(k|k) before the window is full.
Condition start_covariance(const Repaired& found,
                           const std::optional<rigor::IntervalMatrix<3>>& initial_covariance) {
  Condition condition =
      not_found("P(0|0)", R"(q^{-1} I \le P(k|k) \le p I \text{ from } k = 0)",
                "Whether the bounds on P(k|k) hold before the window is full is not shown.");
  if (!found.assumed) {
    condition.reason = kNotBorne;
    return condition;
  }
  const ErrorRecursion& recursion = *found.assumed;
  if (initial_covariance) {
    condition.verdict =
        decide_start(*initial_covariance, recursion.range, found.design, recursion.tube, recursion.window);
    if (condition.verdict == Verdict::proved) {
      condition.reason =
          "The covariances up to the end of the window were enclosed and lie within the bounds.";
    }
  } else if (found.design.epsilon == Interval(0.0)) {
    condition.verdict = Verdict::proved;
    condition.reason =
        "The steady state is what an infinite past of exact estimates leaves; the window reaches into it.";
  } else {
    condition.reason =
        "With a leak the filter's steady state depends on the frequency; the bounds hold for the steady "
        "state "
        "along exact estimates.";
  }
  return condition;
}

void add_conditions(Derivation& derivation, const Repaired& found, const Theorem29Input& input,
                    const std::optional<rigor::IntervalMatrix<3>>& initial_covariance) {
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
    derivation.conditions.push_back({"invariance", kInvariance, r.decide_invariant(radius, found.disturbance),
                                     r.alpha * radius + r.curvature * square(radius) + found.disturbance,
                                     radius,
                                     "Decided without the cancellation: c R^2 + noise <= (1 - alpha) R."});
  }
  derivation.conditions.push_back(start_covariance(found, initial_covariance));
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
  add_quantity(derivation,
               {"frequency_error_bound", R"(\sup_k \lvert e_3(k) \rvert)", R"(P_{33}^{1/2} R)", kProof},
               assured ? found.assumed->frequency_gain * found.assumed_radius : Interval::empty(), kWhyNot);
  add_quantity(
      derivation,
      {"ultimate_frequency_error", R"(\limsup_k \lvert e_3(k) \rvert)", R"(P_{33}^{1/2} R_-)", kProof},
      assured ? found.assumed->frequency_gain * found.assumed->ultimate_radius(found.disturbance)
              : Interval::empty(),
      kWhyNot);
}

/// The ends of the constants used by the bounds, and the matrices they are computed from.
Evidence evidence_of(const char* name, const ErrorRecursion& recursion, const Interval& radius) {
  const auto point = [](const rigor::IntervalMatrix<3>& matrix) {
    return rigor::Matrix<3>(matrix.unaryExpr([](const Interval& entry) { return entry.upper(); }));
  };
  return {name,
          {{"window", static_cast<double>(recursion.window)},
           {"plane_error", recursion.tube.plane_error.upper()},
           {"frequency_error", recursion.tube.frequency_error.upper()},
           {"one_minus_alpha", recursion.one_minus_alpha.lower()},
           {"curvature", recursion.curvature.upper()},
           {"process_gain", recursion.process_gain.upper()},
           {"measurement_gain", recursion.measurement_gain.upper()},
           {"s", recursion.s.upper()},
           {"radius", radius.lower()}},
          {{"covariance_upper", point(recursion.range.upper)},
           {"information_upper", point(recursion.range.information)}}};
}

std::vector<Evidence> evidence_of(const Repaired& found) {
  std::vector<Evidence> evidence;
  if (found.start) {
    evidence.push_back(evidence_of("start", *found.start, found.start_radius));
  }
  if (found.noise) {
    evidence.push_back(evidence_of("noise", *found.noise, found.noise->toughest_radius()));
  }
  if (found.process) {
    evidence.push_back(evidence_of("process-noise", *found.process, found.process->toughest_radius()));
  }
  if (found.assumed) {
    evidence.push_back(evidence_of("assumed", *found.assumed, found.assumed_radius));
  }
  return evidence;
}

/// A point with positive noise bounds and a positive start error, or the reason why there is none.
Feasibility feasibility_of(const Repaired& found) {
  Feasibility feasibility;
  if (found.noise) {
    const ErrorRecursion& r = *found.noise;
    const Interval radius = r.toughest_radius();
    const Interval quarter(0.25);
    const Interval v(rigor::midpoint(quarter * r.largest_disturbance() / r.measurement_gain));
    const Interval w(rigor::midpoint(quarter * r.largest_disturbance() / r.process_gain));
    const Interval start = start_error(r, radius);
    feasibility.verdict = rigor::conjunction({r.decide_invariant(radius, disturbance_of(r, w, v)),
                                              decide_less(Interval(0.0), v), decide_less(Interval(0.0), w),
                                              decide_less(Interval(0.0), start)});
    feasibility.argument =
        "The witness satisfies the invariance condition with positive noise and start bounds.";
    const auto quantity = [](const char* name, const char* symbol, const Interval& value) {
      return Quantity{name, symbol, "", kProof, value, std::nullopt};
    };
    feasibility.witness = {quantity("window", "N", Interval(r.window)),
                           quantity("epsilon_r", R"(\epsilon_r)", r.tube.plane_error),
                           quantity("frequency_tube", "", r.tube.frequency_error),
                           quantity("radius", "R", radius),
                           quantity("c_1", "c_1", w / sqrt(found.design.q2)),
                           quantity("c_2", "c_2", v / sqrt(found.design.r)),
                           quantity("initial_error_bound", "", start)};
  } else if (found.design.q1 == Interval(0.0)) {
    feasibility.verdict = Verdict::refuted;
    feasibility.argument =
        "q_1 = 0: F P F' <= mu Q holds for no mu, so alpha = 1 and no radius is invariant under any noise.";
    feasibility.lower_bound = Interval(1.0);
  } else {
    feasibility.argument = kNoRecursion;
  }
  return feasibility;
}

}  // namespace

Derivation derive_repaired_theorem(const TrackerInput& question) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(question.theorem_2_9);
  const Repaired found = search(input);
  Derivation derivation;
  derivation.id = "theorem-2.9/repaired";
  derivation.title = "Theorem 2.9 repaired: error and noise bounds with every gap of the proof closed";
  add_quantities(derivation, found);
  add_conditions(derivation, found, input, question.initial_covariance);
  conclude(derivation);
  add_assured(derivation, found);
  derivation.feasibility = feasibility_of(found);
  derivation.evidence = evidence_of(found);
  derivation.notes = {
      "W(k)^2 = e(k)' P(k|k)^-1 e(k) with the filter's own P(k|k), whatever its past: nothing depends on how "
      "P "
      "came about, only on bounds that hold for every run in the tube.",
      "The largest start and the largest noise are each certified on their own: the start without noise, the "
      "noise from an exact start. initial_frequency_error_bound is for exact phase and amplitude.",
      "Start and noise bounds are for w = 0, a frequency that leaks as (3.1) says; with a leak a constant "
      "frequency omega is a process noise epsilon omega, which process_noise_bound must bear.",
      "The start covariance is the filter's steady state along exact estimates unless the design file gives "
      "a "
      "matrix."};
  return derivation;
}

}  // namespace veritrack::theorems

#include "analysis/theorems/theorem_2_9_repaired_search.hpp"

#include "analysis/theorems/error_recursion_search.hpp"

namespace veritrack::theorems {

using rigor::Interval;
using rigor::Verdict;

namespace {

Interval disturbance_of(const ErrorRecursion& recursion, const Interval& process_noise,
                        const Interval& measurement_noise) {
  return recursion.process_gain * process_noise + recursion.measurement_gain * measurement_noise;
}

/// A radius that is verified to be invariant under the disturbance; empty otherwise.
Interval verified_radius(const ErrorRecursion& recursion, const Interval& disturbance) {
  const Interval radius = recursion.propose_radius(disturbance);
  return recursion.decide_invariant(radius, disturbance) == Verdict::proved ? radius : Interval::empty();
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

}  // namespace

Interval start_error(const ErrorRecursion& recursion, const Interval& radius) {
  return radius / sqrt(recursion.q);
}

Interval start_frequency_error(const ErrorRecursion& recursion, const Interval& radius) {
  return radius / sqrt(recursion.range.information(2, 2));
}

Repaired search_repaired(const Theorem29Input& input) {
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

std::vector<Evidence> repaired_evidence(const Repaired& found) {
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

Feasibility repaired_feasibility(const Repaired& found) {
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
      return Quantity{name, symbol, "", kRepairedProof, value, std::nullopt};
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
        "q_1 = 0: no mu satisfies F P F' <= mu Q, so alpha = 1 and no radius is invariant under any noise.";
    feasibility.lower_bound = Interval(1.0);
  } else {
    feasibility.argument = kNoRepairedRecursion;
  }
  return feasibility;
}

}  // namespace veritrack::theorems

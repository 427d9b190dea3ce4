#include "checker/quadrature/contraction.hpp"

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

Ball start_level(const Setting& s, const Design& d) {
  return largest_level(s.metric, d.amplitude_error, d.phase_error, d.frequency_error);
}

/// The steady state lies between invariant bounds (Lemma 2), given that q1, q2 > 0.
bool contains_starts(const Setting& s, const Design& d) {
  return certainly_at_most(start_level(s, d), s.radius) &&
         (d.covariance ? between(*d.covariance, s.lower, s.upper) : certainly_positive(d.q1));
}

/// Every trajectory in `outer` is in `inner` from some sample on.
bool leads_into(const Setting& outer, const Setting& inner, const Design& d) {
  const Ball level = ultimate_level(outer, d);
  const std::array<Ball, 3> rows = inverse_rows(outer.metric);
  const Ball above = level * Ball(1.0 + 0x1p-20);
  return certainly_positive(level) &&
         certainly_at_most(largest_level(inner.metric, above * rows[0], above * rows[1], above * rows[2]),
                           inner.radius) &&
         positive_definite(outer.lower - inner.lower) && positive_definite(inner.upper - outer.upper);
}

std::vector<const Setting*> usable(const std::vector<CertifiedSet>& sets, const Design& d) {
  std::vector<const Setting*> found;
  for (const CertifiedSet& set : sets) {
    if (set.verified && bears(set.setting, d)) {
      found.push_back(&set.setting);
    }
  }
  return found;
}

void improve(std::optional<Ball>& best, const Ball& bound) {
  if (bound.finite()) {
    best = best ? min(*best, bound) : bound;
  }
}

}  // namespace

Promises check_contraction(const Tree& claimed, const Design& design, const std::vector<CertifiedSet>& sets,
                           Objections& objections) {
  Promises promises;
  const std::vector<const Setting*> useful = usable(sets, design);
  std::vector<const Setting*> bases;
  for (const Setting* set : useful) {
    if (contains_starts(*set, design)) {
      bases.push_back(set);
      improve(promises.ultimate, ultimate_level(*set, design) / set->metric.frequency);
      improve(promises.bound,
              max(start_level(*set, design), ultimate_level(*set, design)) / set->metric.frequency);
    }
  }
  promises.starts_inside = !bases.empty();
  const Setting* whole = first_of(sets, "start-error");
  // Without a set that holds the starts, what is said is said of every start in the set "start-error".
  std::vector<const Setting*> outer = bases;
  if (outer.empty() && whole != nullptr && bears(*whole, design)) {
    outer = {whole};
    improve(promises.ultimate, ultimate_level(*whole, design) / whole->metric.frequency);
  }
  for (const Setting* base : outer) {
    for (const Setting* inner : useful) {
      if (leads_into(*base, *inner, design)) {
        improve(promises.ultimate, ultimate_level(*inner, design) / inner->metric.frequency);
      }
    }
  }

  const Ball nothing = Ball::everything();
  Derivation found;
  found.title = "Contraction of the errors in a set that the tracker never leaves";
  const auto add = [&](const char* name, const Ball& value, Sense sense) {
    found.quantities.push_back({name, value, sense});
  };
  if (whole != nullptr) {
    const std::array<Ball, 3> rows = inverse_rows(whole->metric);
    if (bears(*whole, design)) {
      promises.reach = whole->radius * rows[2];
    }
    add("contraction_rate", whole->rate, Sense::encloses);
    add("radius", whole->radius, Sense::encloses);
    add("frequency_error_radius", whole->radius * rows[2], Sense::encloses);
    add("phase_error_radius", whole->radius * rows[1], Sense::encloses);
    add("amplitude_error_radius", whole->radius * rows[0], Sense::encloses);
  }
  add("ultimate_frequency_error", promises.ultimate.value_or(nothing), Sense::bounds_above);
  add("frequency_error_bound", promises.bound.value_or(nothing), Sense::bounds_above);
  const Setting* noisy = first_of(sets, "largest-noise");
  const Setting* slewing = first_of(sets, "largest-slew");
  promises.noise = noisy != nullptr ? std::optional(noisy->noise) : std::nullopt;
  promises.slew = slewing != nullptr ? std::optional(slewing->slew) : std::nullopt;
  add("largest_noise", promises.noise.value_or(nothing), Sense::bounds_below);
  add("largest_slew", promises.slew.value_or(nothing), Sense::bounds_below);
  if (const auto claim = settling_claim(claimed.at("quantities"))) {
    const Ball& count = claim->samples;
    bool settles = false;
    for (const Setting* base : outer) {
      const Ball start = promises.starts_inside ? start_level(*base, design) : base->radius;
      settles = settles || (certainly_not_negative(count) &&
                            settled(*base, design, start, claim->twice_ultimate, count));
    }
    if (settles && promises.starts_inside) {
      promises.settling = count;
    }
    add("settling_samples", settles ? count : nothing, Sense::bounds_above);
  }

  found.conditions = {{"leak", R"(\epsilon = 0)", proved_if(design.without_leak()), design.epsilon, zero},
                      {"controllable-amplitude", "q_1 > 0", decide_less(zero, design.q1), design.q1, zero},
                      {"invariant-set", R"(\kappa^2 R^2 + L_v^2 V^2 + L_w^2 W^2 \le R^2)",
                       proved_if(whole != nullptr && bears(*whole, design))}};
  if (whole != nullptr) {
    Condition& invariant = found.conditions.back();
    invariant.lhs = square(whole->rate * whole->radius) + square(whole->noise_gain * whole->noise) +
                    square(whole->slew_gain * whole->slew);
    invariant.rhs = square(whole->radius);
    found.conditions.push_back({"start-in-set", R"(|T e(0)| \le R,\ P_{lo} \le P(0) \le P_{hi})",
                                proved_if(promises.starts_inside), start_level(*whole, design), whole->radius,
                                Sense::bounds_above});
  }
  check_derivation(claimed, found, objections);
  return promises;
}

}  // namespace veritrack::checker

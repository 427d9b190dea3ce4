#include "checker/quadrature/contraction.hpp"

#include <algorithm>

#include "checker/quadrature/start_covariance.hpp"

namespace veritrack::checker {

namespace {

Ball start_level(const Setting& s, const Design& d) {
  return largest_level(s.metric, d.amplitude_error, d.phase_error, d.frequency_error);
}

bool contains_starts(const Setting& s, const Design& d, const std::optional<StartCovariance>& covariance) {
  return covariance && certainly_at_most(start_level(s, d), s.radius) &&
         covariance->between(s.lower, s.upper);
}

/// Every trajectory in `outer` is in `inner` from some sample on.
bool ends_in(const Setting& outer, const Setting& inner, const Design& d) {
  const Ball level = ultimate_level(outer, d);
  const std::array<Ball, 3> rows = inverse_rows(outer.metric);
  const Ball above = level * Ball(1.0 + 0x1p-20);
  // cannot bind (level): at level zero the outer set has the least of all ultimate bounds already.
  return certainly_positive(level) &&
         certainly_at_most(largest_level(inner.metric, above * rows[0], above * rows[1], above * rows[2]),
                           inner.radius) &&
         positive_definite(outer.lower - inner.lower) && positive_definite(inner.upper - outer.upper);
}

std::vector<const Setting*> usable(const std::vector<CertifiedSet>& sets, const Design& d) {
  std::vector<const Setting*> found;
  for (const CertifiedSet& set : sets) {
    if (set.verified && tolerates(set.setting, d)) {
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

/// The promises of the sets on the assumed starts, and the sets that contain them. When none does: on every
/// start in the set "start-error".
struct StartSets {
  Promises promises;
  std::vector<const Setting*> bases;
};
StartSets follow_starts(const std::vector<CertifiedSet>& sets, const Setting* whole, const Design& design,
                        const std::optional<StartCovariance>& covariance) {
  StartSets found;
  Promises& promises = found.promises;
  const std::vector<const Setting*> useful = usable(sets, design);
  for (const Setting* set : useful) {
    if (contains_starts(*set, design, covariance)) {
      found.bases.push_back(set);
      improve(promises.ultimate, ultimate_level(*set, design) / set->metric.frequency);
      improve(promises.bound,
              max(start_level(*set, design), ultimate_level(*set, design)) / set->metric.frequency);
    }
  }
  promises.starts_inside = !found.bases.empty();
  if (!promises.starts_inside && whole != nullptr && tolerates(*whole, design)) {
    found.bases = {whole};
    improve(promises.ultimate, ultimate_level(*whole, design) / whole->metric.frequency);
  }
  for (const Setting* base : found.bases) {
    for (const Setting* inner : useful) {
      if (ends_in(*base, *inner, design)) {
        improve(promises.ultimate, ultimate_level(*inner, design) / inner->metric.frequency);
      }
    }
  }
  return found;
}

/// Is it true of the starts of some base?
bool settles(const StartSets& starts, const Design& design, const Settled& claim) {
  return std::any_of(starts.bases.begin(), starts.bases.end(), [&](const Setting* base) {
    const Ball level = starts.promises.starts_inside ? start_level(*base, design) : base->radius;
    return settled(*base, design, level, claim.frequency_error, claim.samples);
  });
}

std::vector<Quantity> size_of(const Setting& set) {
  const std::array<Ball, 3> rows = inverse_rows(set.metric);
  return {{"contraction_rate", set.rate},
          {"radius", set.radius},
          {"frequency_error_radius", set.radius * rows[2]},
          {"phase_error_radius", set.radius * rows[1]},
          {"amplitude_error_radius", set.radius * rows[0]}};
}

std::vector<Condition> conditions_of(const Setting* whole, const Promises& promises, const Design& design) {
  std::vector<Condition> conditions{
      {"leak", R"(\epsilon = 0)", proved_if(design.without_leak()), design.epsilon, zero},
      {"controllable-amplitude", "q_1 > 0", decide_less(zero, design.q1), design.q1, zero},
      {"invariant-set", R"(\kappa^2 R^2 + L_v^2 V^2 + L_w^2 W^2 \le R^2)",
       proved_if(whole != nullptr && tolerates(*whole, design))}};
  if (whole != nullptr) {
    Condition& invariant = conditions.back();
    invariant.lhs = square(whole->rate * whole->radius) + square(whole->noise_gain * whole->noise) +
                    square(whole->slew_gain * whole->slew);
    invariant.rhs = square(whole->radius);
    conditions.push_back({"start-in-set", R"(|T e(0)| \le R,\ P_{lo} \le P(0) \le P_{hi})",
                          proved_if(promises.starts_inside), start_level(*whole, design), whole->radius,
                          Sense::bounds_above});
  }
  return conditions;
}

}  // namespace

Promises check_contraction(const Tree& claimed, const Design& design, const std::vector<CertifiedSet>& sets,
                           Objections& objections) {
  const Setting* whole = first_of(sets, "start-error");
  const Setting* noisy = first_of(sets, "largest-noise");
  const Setting* slewing = first_of(sets, "largest-slew");
  const std::optional<StartCovariance> covariance = read_start_covariance(claimed, design, objections);
  StartSets starts = follow_starts(sets, whole, design, covariance);
  Promises& promises = starts.promises;
  promises.covariance = covariance ? covariance->words : "";
  Derivation found;
  found.title = "Contraction of the errors in an invariant set";
  if (whole != nullptr) {
    found.quantities = size_of(*whole);
    if (tolerates(*whole, design)) {
      promises.reach = frequency_errors(*whole);
      promises.reach_error = promises.reach;
      promises.rate = whole->rate;
    }
  }
  if (noisy != nullptr) {
    promises.noise = noisy->noise;
    promises.noise_error = frequency_errors(*noisy);
  }
  if (slewing != nullptr) {
    promises.slew = slewing->slew;
    promises.slew_error = frequency_errors(*slewing);
  }
  add_bounds(promises, found);
  if (const auto claim = settling_claim(claimed.at("quantities"))) {
    if (settles(starts, design, *claim)) {
      found.quantities.push_back({"settling_samples", claim->samples, Sense::bounds_above});
      found.quantities.push_back({"settled_frequency_error", claim->frequency_error, Sense::bounds_above});
      promises.settled = promises.starts_inside ? claim : std::nullopt;
    }
  }
  found.conditions = conditions_of(whole, promises, design);
  check_derivation(claimed, found, objections);
  return promises;
}

}  // namespace veritrack::checker

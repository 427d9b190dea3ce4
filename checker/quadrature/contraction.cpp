#include "checker/quadrature/contraction.hpp"

#include "checker/numbers/matrix3.hpp"
#include "checker/quadrature/set_inequality.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball one(1.0);

/// Lengths of the rows of T^-1: |amplitude|, |phase|, |frequency error| are at most these times |T e|.
std::array<Ball, 3> inverse_rows(const Metric& t) {
  return {one / t.amplitude, sqrt(square(one / t.phase) + square(t.coupling / (t.phase * t.frequency))),
          one / t.frequency};
}

/// sup |T e| over |e_i| <= bounds_i.
Ball largest_level(const Metric& t, const Ball& amplitude, const Ball& phase, const Ball& frequency) {
  return sqrt(square(t.amplitude * amplitude) + square(t.phase * phase + abs(t.coupling) * frequency) +
              square(t.frequency * frequency));
}

bool positive_definite(const Covariance<Ball>& p) {
  return certainly_positive(p.p11) && certainly_positive(p.p22) &&
         certainly_positive(p.p22 * p.p33 - square(p.p23));
}

Covariance<Ball> operator-(const Covariance<Ball>& x, const Covariance<Ball>& y) {
  return {x.p11 - y.p11, x.p22 - y.p22, x.p23 - y.p23, x.p33 - y.p33};
}

/// P - lower > 0 and upper - P > 0.
bool between(const Matrix3& p, const Covariance<Ball>& lower, const Covariance<Ball>& upper) {
  const auto whole = [](const Covariance<Ball>& c) {
    Matrix3 result = diagonal(c.p11, c.p22, c.p33);
    result[2][1] = result[1][2] = c.p23;
    return result;
  };
  return definite(p - whole(lower)) && definite(whole(upper) - p);
}

/// What |T e| tends to at most under the noise and slew of the design.
Ball ultimate_level(const Setting& s, const Design& d) {
  const Ball pushed = square(s.noise_gain * d.noise) + square(s.slew_gain * d.slew);
  return sqrt(pushed / (one - square(s.rate)));
}

bool bears(const Setting& s, const Design& d) {
  return certainly_at_most(d.noise, s.noise) && certainly_at_most(d.slew, s.slew);
}

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

/// rate^(2k) (l^2 - u^2) + u^2 <= level^2 for this k, hence for all later ones.
bool settled(const Setting& s, const Design& d, const Ball& start, const Ball& frequency_error,
             const Ball& samples) {
  const Ball level = frequency_error * s.metric.frequency;
  const Ball ultimate = square(ultimate_level(s, d));
  if (!certainly_less(ultimate, square(level))) {
    return false;
  }
  if (certainly_at_most(start, level)) {
    return true;
  }
  const Ball log_shrunk = samples * log(square(s.rate));
  return certainly_at_most(log_shrunk + log(square(start) - ultimate), log(square(level) - ultimate));
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

const Setting* first_of(const std::vector<CertifiedSet>& sets, const std::string& purpose) {
  for (const CertifiedSet& set : sets) {
    if (set.verified && set.purpose == purpose) {
      return &set.setting;
    }
  }
  return nullptr;
}

}  // namespace

CertifiedSet check_set(const Tree& tree, const Design& design, std::int64_t& cells, Objections& objections) {
  CertifiedSet set;
  set.purpose = tree.at("purpose").text();
  Setting& s = set.setting;
  const auto number = [&](const char* name) { return from_hexadecimal(tree.at(name).text()); };
  const auto entry = [&](const char* name, std::size_t i, std::size_t j) {
    return from_hexadecimal(tree.at(name).at(i).at(j).text());
  };
  const auto block = [&](const char* name) {
    return Covariance<Ball>{entry(name, 0, 0), entry(name, 1, 1), entry(name, 1, 2), entry(name, 2, 2)};
  };
  bool form = certainly_equal(entry("metric", 2, 1), zero);
  for (const char* name : {"metric", "covariance_lower", "covariance_upper"}) {
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
      form = form && certainly_equal(entry(name, 0, i), zero) && certainly_equal(entry(name, i, 0), zero);
    }
  }
  for (const char* name : {"covariance_lower", "covariance_upper"}) {
    form = form && certainly_equal(entry(name, 1, 2), entry(name, 2, 1));
  }
  s.q1 = design.q1;
  s.q2 = design.q2;
  s.r = design.r;
  s.metric = {entry("metric", 0, 0), entry("metric", 1, 1), entry("metric", 1, 2), entry("metric", 2, 2)};
  s.lower = block("covariance_lower");
  s.upper = block("covariance_upper");
  s.radius = number("radius");
  s.noise = number("noise");
  s.slew = number("slew");
  s.rate = number("rate");
  s.noise_gain = number("noise_gain");
  s.slew_gain = number("slew_gain");
  s.noisy = !certainly_equal(s.noise, zero);
  s.slewing = !certainly_equal(s.slew, zero);
  s.largest_amplitude = (s.radius / s.metric.amplitude).upper();
  s.largest_chi = (s.radius * sqrt(square(one / s.metric.phase) +
                                   square((one - s.metric.coupling / s.metric.phase) / s.metric.frequency)))
                      .upper();
  const Ball reach =
      square(s.rate * s.radius) + square(s.noise_gain * s.noise) + square(s.slew_gain * s.slew);
  const auto refuse = [&](const char* why) {
    objections.push_back(set.purpose + ": " + why);
    return set;
  };
  if (!certainly_equal(design.epsilon, zero) || !certainly_positive(design.q2) ||
      !certainly_positive(design.r)) {
    return refuse("certified sets are for epsilon = 0, q2 > 0, r > 0");
  }
  if (!form || !certainly_positive(s.metric.amplitude) || !certainly_positive(s.metric.phase) ||
      !certainly_positive(s.metric.frequency)) {
    return refuse("the matrices do not have their form");
  }
  if (!certainly_positive(s.radius) || !certainly_at_most(zero, s.noise) ||
      !certainly_at_most(zero, s.slew) || !certainly_at_most(zero, s.rate) || !certainly_less(s.rate, one) ||
      !certainly_at_most(zero, s.noise_gain) || !certainly_at_most(zero, s.slew_gain) ||
      !certainly_less(s.largest_amplitude, one)) {
    return refuse("radius, noise, slew, rate or gains are out of range");
  }
  if (!positive_definite(s.lower) || !positive_definite(s.upper - s.lower)) {
    return refuse("the covariance bounds are not positive definite and in order");
  }
  if (!certainly_at_most(reach, square(s.radius))) {
    return refuse("(c) noise and slew lead out of the set");
  }
  if (!keeps_covariance(s)) {
    return refuse("(b) the covariance does not certainly stay between its bounds");
  }
  if (!contracts(s, cells)) {
    return refuse("(a) the step inequality does not certainly hold");
  }
  set.verified = true;
  return set;
}

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
  const Tree& quantities = claimed.at("quantities");
  const Tree* samples = quantities.find("settling_samples");
  const Tree* ultimate = quantities.find("ultimate_frequency_error");
  if (samples != nullptr && ultimate != nullptr) {
    // The claim is about the ultimate bound that is claimed, which is checked above.
    const Ball count = from_hexadecimal(samples->at("lo").text());
    const Ball twice = Ball(2.0) * from_hexadecimal(ultimate->at("lo").text());
    bool settles = false;
    for (const Setting* base : outer) {
      const Ball start = promises.starts_inside ? start_level(*base, design) : base->radius;
      settles = settles || (certainly_at_most(zero, count) && settled(*base, design, start, twice, count));
    }
    if (settles && promises.starts_inside) {
      promises.settling = count;
    }
    add("settling_samples", settles ? count : nothing, Sense::bounds_above);
  }

  found.conditions = {
      {"leak", R"(\epsilon = 0)", proved_if(certainly_equal(design.epsilon, zero)), design.epsilon, zero},
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

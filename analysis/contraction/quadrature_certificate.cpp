#include "analysis/contraction/quadrature_certificate.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/contraction/falsifier.hpp"
#include "analysis/contraction/sampled_limit.hpp"
#include "analysis/contraction/set_search.hpp"
#include "analysis/contraction/start_bounds.hpp"
#include "analysis/rigor/decimal.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::IntervalVector;
using rigor::Verdict;
using theorems::Condition;
using theorems::Quantity;

constexpr const char* kSource = "docs/contraction.md";

std::string at_most(const Interval& x) {
  return rigor::to_decimal(x.upper(), 4, Direction::up);
}
std::string at_least(const Interval& x) {
  return rigor::to_decimal(x.lower(), 4, Direction::down);
}

Quantity quantity(std::string name, std::string symbol, std::string formula, const Interval& value) {
  return {std::move(name), std::move(symbol), std::move(formula), kSource, value, std::nullopt};
}
Quantity missing(std::string name, std::string symbol, std::string formula, std::string why) {
  return {std::move(name), std::move(symbol), std::move(formula), kSource, Interval(), std::move(why)};
}

/// The sets that say something of the assumed starts, noise and slew.
class Promises {
 public:
  Promises(const ContractionQuestion& question, const ContractionCertificate& certificate) {
    std::vector<StartBounds> others;
    for (const auto* set :
         {&certificate.set, &certificate.bound_set, &certificate.ultimate_set, &certificate.settling_set}) {
      if (*set) {
        const StartBounds bounds(question, (*set)->set);
        (bounds.contains_starts() ? bases_ : others).push_back(bounds);
      }
    }
    starts_inside_ = !bases_.empty();
    if (!starts_inside_ && certificate.set) {
      bases_ = {StartBounds(question, certificate.set->set)};
    }
    ultimate_ = least([](const StartBounds& bounds) { return bounds.ultimate_frequency_error(); });
    for (const StartBounds& inner : others) {
      const bool led_into = std::any_of(bases_.begin(), bases_.end(), [&](const StartBounds& base) {
        return certainly_leads_into(base.set(), inner.set(), question.noise, question.slew);
      });
      if (led_into) {
        ultimate_ = Interval(std::min(ultimate_.upper(), inner.ultimate_frequency_error().upper()));
      }
    }
  }

  [[nodiscard]] bool starts_inside() const { return starts_inside_; }
  [[nodiscard]] const Interval& ultimate() const { return ultimate_; }

  void add_to(std::vector<Quantity>& quantities) const {
    quantities.push_back(quantity("ultimate_frequency_error", "\\nu_\\infty",
                                  "u\\,|e_3' T^{-1}|,\\ u^2 = \\tfrac{L_v^2 V^2 + L_w^2 W^2}{1 - \\kappa^2}",
                                  ultimate_));
    const std::string symbol = "\\sup_k |\\nu(k)|";
    const std::string formula = "\\max(|T e(0)|, u)\\,|e_3' T^{-1}|";
    quantities.push_back(starts_inside_ ? quantity("frequency_error_bound", symbol, formula,
                                                   least([](const StartBounds& bounds) {
                                                     return bounds.frequency_error_bound();
                                                   }))
                                        : missing("frequency_error_bound", symbol, formula,
                                                  "The assumed starts are not in a certified set."));
    add_settling(quantities);
  }

 private:
  template <typename Promise>
  [[nodiscard]] Interval least(Promise promise) const {
    double result = std::numeric_limits<double>::infinity();
    for (const StartBounds& bounds : bases_) {
      const Interval value = promise(bounds);
      if (rigor::is_finite(value)) {
        result = std::min(result, value.upper());
      }
    }
    return Interval(result);
  }

  void add_settling(std::vector<Quantity>& quantities) const {
    const std::string name = "settling_samples";
    const std::string symbol = "k_s";
    const std::string formula = "|\\nu(k)| \\le 2\\nu_\\infty \\text{ for } k \\ge k_s";
    std::optional<Interval> samples;
    for (const StartBounds& bounds : bases_) {
      const auto found =
          certainly_positive(ultimate_) ? bounds.samples_until(Interval(2.0) * ultimate_) : std::nullopt;
      samples = found && samples ? rigor::min(*samples, *found) : found ? found : samples;
    }
    quantities.push_back(samples
                             ? quantity(name, symbol, formula, *samples)
                             : missing(name, symbol, formula,
                                       certainly_positive(ultimate_)
                                           ? "No set promises from when on it holds."
                                           : "Without noise and slew the ultimate bound is zero, which is "
                                             "approached but not reached."));
  }

  std::vector<StartBounds> bases_;  ///< those that hold the starts; the largest when none does
  bool starts_inside_ = false;
  Interval ultimate_;
};

Condition start_in_set(const ContractionQuestion& question, const CertifiedSet& set, bool starts_inside) {
  const Interval radius(set.radius);
  const Interval level = StartBounds(question, set).start_level();
  Condition condition{"start-in-set",
                      "|T e(0)| \\le R,\\ P_{lo} \\le P(0) \\le P_{hi}",
                      starts_inside ? Verdict::proved : Verdict::undecided,
                      Interval(level.upper()),
                      radius,
                      {}};
  condition.reason = starts_inside ? "every assumed start lies in a certified set."
                     : certainly_less_equal(level, radius)
                         ? "the initial covariance is not certainly between the bounds of the certified set."
                         : "the assumed start errors reach " + at_most(level) +
                               " in a metric where the set ends at " + at_least(radius) +
                               ": smaller start errors, or a proof of capture, would do.";
  return condition;
}

void add_size(const CertifiedSet& set, std::vector<Quantity>& quantities) {
  const Interval radius(set.radius);
  const IntervalVector<3> bounds = error_bounds(set, radius);
  quantities.push_back(quantity("contraction_rate", "\\kappa", "\\sup |T e^+| / |T e|", Interval(set.rate)));
  quantities.push_back(quantity("radius", "R", "", radius));
  quantities.push_back(quantity("frequency_error_radius", "\\nu_R", "R\\,|e_3' T^{-1}|", bounds[2]));
  quantities.push_back(quantity("phase_error_radius", "\\psi_R", "R\\,|e_2' T^{-1}|", bounds[1]));
  quantities.push_back(quantity("amplitude_error_radius", "a_R", "R\\,|e_1' T^{-1}|", bounds[0]));
}

Condition leak(const Interval& epsilon) {
  const bool none = epsilon == Interval(0.0);
  return {"leak",
          "\\epsilon = 0",
          none ? Verdict::proved : Verdict::undecided,
          epsilon,
          Interval(0.0),
          none ? "there is no leak, so the errors do not depend on the frequency."
               : "with a leak the errors do not settle at zero; this certificate does not cover that."};
}

/// With q1 = 0 the row (1, 0, 0) is a left eigenvector of F(1) to the eigenvalue 1 that Q does not reach: by
/// the test of Popov, Belevitch and Hautus the amplitude is an uncontrollable mode on the unit circle.
Condition controllable_amplitude(const Interval& q1) {
  const Interval zero(0.0);
  Condition condition{"controllable-amplitude", "q_1 > 0", rigor::decide_less(zero, q1), q1, zero, {}};
  condition.reason =
      condition.verdict == Verdict::proved ? "process noise reaches the amplitude."
      : condition.verdict == Verdict::refuted
          ? "with q1 = 0 and no leak the amplitude is an uncontrollable mode on the unit circle (witness: "
            "the "
            "row (1, 0, 0) is a left eigenvector of F to the eigenvalue 1, and (1, 0, 0) Q = 0): its "
            "variance "
            "falls like 1/k, the gain goes to zero, and no steady state is exponentially stable; any q1 > 0 "
            "repairs this."
          : "q1 is not certainly positive.";
  return condition;
}

Condition invariant_set(const ContractionQuestion& question, const ContractionCertificate& certificate) {
  Condition condition{
      "invariant-set", "\\kappa^2 R^2 + L_v^2 V^2 + L_w^2 W^2 \\le R^2", Verdict::undecided, {}, {}, {}};
  if (certificate.set) {
    const CertifiedSet& set = certificate.set->set;
    condition.verdict = certificate.set->verdict;
    condition.lhs = rigor::square(Interval(set.rate) * Interval(set.radius)) +
                    rigor::square(Interval(set.noise_gain) * Interval(set.noise)) +
                    rigor::square(Interval(set.slew_gain) * Interval(set.slew));
    condition.rhs = rigor::square(Interval(set.radius));
    condition.reason = certificate.set->reason;
    return condition;
  }
  condition.reason = "no set could be certified for this noise and slew";
  if (certificate.noise_set) {
    condition.reason += "; the largest certified noise (without slew) is " +
                        rigor::to_decimal(certificate.noise_set->set.noise, 4, Direction::down) + ", " +
                        at_most(question.noise) + " was assumed";
  }
  if (certificate.slew_set) {
    condition.reason += "; the largest certified slew (without noise) is " +
                        rigor::to_decimal(certificate.slew_set->set.slew, 4, Direction::down) + ", " +
                        at_most(question.slew) + " was assumed";
  }
  condition.reason += ".";
  return condition;
}

bool is_sensible(const ContractionQuestion& question) {
  const auto& d = question.design;
  return certainly_positive(d.r) && certainly_positive(d.q2) && certainly_positive(d.q1) &&
         d.epsilon == Interval(0.0) && certainly_less_equal(Interval(0.0), question.noise) &&
         certainly_less_equal(Interval(0.0), question.slew) &&
         certainly_less_equal(Interval(0.0), question.initial_amplitude_error) &&
         certainly_less_equal(Interval(0.0), question.initial_phase_error) &&
         certainly_less_equal(Interval(0.0), question.initial_frequency_error);
}

/// What a search found, for a reader to judge the certificate by. None of it is proved.
void add_samples(const ContractionQuestion& question, const ContractionCertificate& certificate,
                 std::vector<Quantity>& quantities) {
  const auto& intervals = question.design;
  const trackers::QuadratureEkfDesign<double> design{midpoint(intervals.q1), midpoint(intervals.q2),
                                                     midpoint(intervals.r), 0.0};
  const auto add = [&](const char* name, const char* symbol, const char* formula, double value) {
    quantities.push_back(quantity(name, symbol, formula, Interval(value)));
    quantities.back().proved = false;
  };
  const CertifiedSet& set = certificate.set->set;
  const double limit = sampled_radius_limit(set, design);
  add("frequency_error_radius_sampled_limit", "\\hat\\nu_R", "\\hat R\\,|e_3' T^{-1}|",
      error_bounds(set, Interval(limit))[2].upper());
  add("frequency_error_radius_share_of_limit", "R / \\hat R", "", set.radius / limit);
  FalsifierOptions effort;
  effort.search_evaluations = 10;
  if (certificate.bound_set) {
    const Falsification found = try_to_break(certificate.bound_set->set, design, effort);
    add("frequency_error_bound_tightness", "", "\\sup_{\\text{found}} |\\nu| / (R\\,|e_3' T^{-1}|)",
        found.from_rim.tightness());
  }
  if (certificate.ultimate_set) {
    const Falsification found = try_to_break(certificate.ultimate_set->set, design, effort);
    add("ultimate_frequency_error_tightness", "", "\\sup_{\\text{found}} |\\nu| / \\nu_\\infty",
        found.from_zero.tightness());
  }
}

void find_sets(const ContractionQuestion& question, ContractionCertificate& certificate) {
  certificate.noise_set = find_set(question, Objective::noise);
  certificate.slew_set = find_set(question, Objective::slew);
  certificate.set = find_set(question, Objective::start_error);
  if (!certificate.set) {
    return;
  }
  certificate.bound_set = find_set(question, Objective::frequency_bound);
  const bool disturbed = certainly_positive(question.noise) || certainly_positive(question.slew);
  if (!disturbed) {
    return;
  }
  certificate.ultimate_set = find_set(question, Objective::ultimate_error);
  if (!certificate.ultimate_set) {
    certificate.ultimate_set = find_inner_set(question, certificate.set->set);
  }
  const Interval ultimate = Promises(question, certificate).ultimate();
  certificate.settling_set = find_set(question, Objective::settling, 2.0 * ultimate.upper());
}

}  // namespace

ContractionCertificate certify_contraction(const ContractionQuestion& question) {
  const rigor::UpwardRounding upward;
  ContractionCertificate certificate;
  theorems::Derivation& derivation = certificate.derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction of the errors in a set that the tracker never leaves";
  derivation.notes = {
      "Covers the tracker in exact arithmetic, for every frequency, signal amplitude constant.",
      "Amplitude error and noise are relative to the true amplitude; the set is described in the frame of "
      "the "
      "estimated phase."};
  if (is_sensible(question)) {
    find_sets(question, certificate);
  }
  derivation.conditions = {leak(question.design.epsilon), controllable_amplitude(question.design.q1),
                           invariant_set(question, certificate)};
  auto& quantities = derivation.quantities;
  if (certificate.set) {
    const Promises promises(question, certificate);
    derivation.conditions.push_back(start_in_set(question, certificate.set->set, promises.starts_inside()));
    add_size(certificate.set->set, quantities);
    promises.add_to(quantities);
  } else {
    for (const char* name : {"contraction_rate", "radius", "frequency_error_radius", "phase_error_radius",
                             "amplitude_error_radius", "ultimate_frequency_error", "frequency_error_bound",
                             "settling_samples"}) {
      quantities.push_back(missing(name, "", "", "No set could be certified."));
    }
  }
  const std::string none = "No set could be certified.";
  quantities.push_back(certificate.noise_set ? quantity("largest_noise", "V_{max}", "",
                                                        Interval(certificate.noise_set->set.noise))
                                             : missing("largest_noise", "V_{max}", "", none));
  quantities.push_back(certificate.slew_set
                           ? quantity("largest_slew", "W_{max}", "", Interval(certificate.slew_set->set.slew))
                           : missing("largest_slew", "W_{max}", "", none));
  if (certificate.set && question.with_samples) {
    add_samples(question, certificate, quantities);
  }
  std::vector<Verdict> verdicts;
  for (const Condition& condition : derivation.conditions) {
    verdicts.push_back(condition.verdict);
  }
  derivation.verdict = rigor::conjunction(verdicts);
  return certificate;
}

}  // namespace veritrack::contraction

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"

#include <tbb/parallel_invoke.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quadrature/contraction/promises.hpp"
#include "analysis/quadrature/contraction/set_search.hpp"
#include "analysis/quadrature/falsifier/sampled_quantities.hpp"
#include "analysis/quadrature/start_covariance.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/sets/harder_questions.hpp"
#include "analysis/sets/lock_limit.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::IntervalVector;
using rigor::Verdict;
using theorems::Condition;

constexpr const char* kNone = "No set could be certified.";

std::string not_between(const sets::ContractionQuestion& question) {
  const bool is_range = question.start_covariance && !question.start_covariance->range.empty();
  return is_range ? question.start_covariance->range +
                        " is not proved to lie between the covariance bounds of a certified set; a narrower "
                        "range may."
                  : "the initial covariance is not proved to lie between the bounds of the certified set.";
}

Condition start_in_set(const sets::ContractionQuestion& question, const CertifiedSet& set,
                       bool starts_inside) {
  const Interval radius(set.radius);
  const Interval level = StartBounds(question, set).start_level();
  Condition condition{"start-in-set",
                      "|T e(0)| \\le R,\\ P_{lo} \\le P(0) \\le P_{hi}",
                      starts_inside ? Verdict::proved : Verdict::undecided,
                      Interval(level.upper()),
                      radius,
                      {},
                      theorems::Sense::at_most};
  // cannot bind (level): it chooses words, next to a verdict that was reached without it.
  condition.reason = starts_inside ? "every assumed start lies in a certified set."
                     : certainly_less_equal(level, radius)
                         ? not_between(question)
                         : "the assumed starts have level " + rigor::upper_decimal(level) +
                               "; the certified set has level " + rigor::lower_decimal(radius) +
                               ". Smaller start errors, or a proof of capture, would suffice.";
  return condition;
}

void set(theorems::Quantity& quantity, const char* formula, const Interval& value,
         std::string why_not = kNone) {
  quantity.formula = formula;
  quantity.source = "docs/contraction.md";
  theorems::set_value(quantity, value, std::move(why_not));
}

/// The size of the set; without one the quantities are there but not applicable.
void set_size(const std::optional<Verification>& found, sets::KalmanFilterResult& result) {
  Interval rate;
  Interval radius;
  IntervalVector<3> bounds;
  bounds.setConstant(Interval::empty());
  if (found) {
    rate = Interval(found->set.rate);
    radius = Interval(found->set.radius);
    bounds = error_bounds(found->set, radius);
  }
  set(result.contraction_rate, "\\sup |T e^+| / |T e|", rate);
  set(result.radius, "", radius);
  set(result.frequency_error_radius, "R\\,|e_3' T^{-1}|",
      sets::excludes_other_locks(bounds[2]) ? bounds[2] : Interval());
  set(result.phase_error_radius, "R\\,|e_2' T^{-1}|", bounds[1]);
  set(result.amplitude_error_radius, "R\\,|e_1' T^{-1}|", bounds[0]);
}

/// The bounds of the sets for the assumed starts.
void set_promises(const sets::ContractionQuestion& question, const Promises& promises,
                  sets::StartResult& starts) {
  set(starts.ultimate_frequency_error,
      "u\\,|e_3' T^{-1}|,\\ u = \\sqrt{\\kappa^2 u^2 + L_v^2 V^2 + L_w^2 W^2} + \\varrho",
      promises.ultimate_frequency_error());
  set(starts.frequency_error_bound, "\\max(|T e(0)|, u)\\,|e_3' T^{-1}|",
      promises.starts_inside() ? promises.frequency_error_bound() : Interval(),
      "The assumed starts are not in a certified set.");
  const bool undisturbed = question.noise == Interval(0.0) && question.slew == Interval(0.0);
  const std::optional<Promises::Settling> settling = promises.settling();
  const char* why_not = undisturbed ? "Without noise and slew only rounding is left of the bound in the long "
                                      "run, and no settling time is computed."
                                    : "No certified set gives a settling time.";
  set(starts.settling_samples, "|\\nu(k)| \\le \\nu_s \\text{ for } k \\ge k_s",
      settling ? settling->samples : Interval(), why_not);
  set(starts.settled_frequency_error, "", settling ? settling->frequency_error : Interval(), why_not);
  starts.covariance_multiples = promises.covariance_multiples();
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
  condition.reason = condition.verdict == Verdict::proved ? "process noise reaches the amplitude."
                     : condition.verdict == Verdict::refuted
                         ? "with q1 = 0 and no leak the amplitude is an uncontrollable mode on the unit "
                           "circle (witness: the row (1, 0, 0) is a left eigenvector of F for the eigenvalue "
                           "1, and (1, 0, 0) Q = 0): its variance decays like 1/k, the gain tends to zero, "
                           "and no steady state is exponentially stable; any q1 > 0 remedies this."
                         : "q1 is not certainly positive.";
  return condition;
}

Condition invariant_set(const sets::ContractionQuestion& question,
                        const ContractionCertificate& certificate) {
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
  if (question.effort == sets::SearchEffort::quick) {
    condition.reason = "a quick search found no set that does all that is required.";
    return condition;
  }
  const auto& noisy = certificate.noise_set;
  const auto& slewing = certificate.slew_set;
  condition.reason = "no set could be certified for this noise and slew: " +
                     sets::beyond_the_limits(question, noisy ? std::optional(noisy->set.noise) : std::nullopt,
                                             slewing ? std::optional(slewing->set.slew) : std::nullopt) +
                     ".";
  return condition;
}

bool tolerates(const CertifiedSet& set, const sets::ContractionQuestion& question) {
  return certainly_less_equal(question.noise, Interval(set.noise)) &&
         certainly_less_equal(question.slew, Interval(set.slew));
}

/// Those that tolerate the assumed noise and slew: the one whose size is reported first, and those that were
/// made for more, too, so that what is proved for more is reported for less.
std::vector<CertifiedSet> sets_of(const sets::ContractionQuestion& question,
                                  const ContractionCertificate& certificate) {
  std::vector<CertifiedSet> sets;
  for (const auto* found : {&certificate.set, &certificate.bound_set, &certificate.ultimate_set,
                            &certificate.settling_set, &certificate.noise_set, &certificate.slew_set}) {
    if (*found && tolerates((*found)->set, question)) {
      sets.push_back((*found)->set);
    }
  }
  return sets;
}

/// Gives each purpose the best of all sets: what is reported of one is then not contradicted by another.
void share_sets(const sets::ContractionQuestion& question, ContractionCertificate& certificate) {
  const auto size = [](const std::optional<Verification>& found) {
    return error_bounds(found->set, Interval(found->set.radius))[2].lower();
  };
  const std::array<std::optional<Verification>, 6> all{certificate.set,          certificate.noise_set,
                                                       certificate.slew_set,     certificate.bound_set,
                                                       certificate.ultimate_set, certificate.settling_set};
  for (const std::optional<Verification>& found : all) {
    if (!found) {
      continue;
    }
    if (tolerates(found->set, question) && (!certificate.set || size(found) > size(certificate.set))) {
      certificate.set = found;
    }
    if (certificate.noise_set && found->set.noise > certificate.noise_set->set.noise) {
      certificate.noise_set = found;
    }
    if (certificate.slew_set && found->set.slew > certificate.slew_set->set.slew) {
      certificate.slew_set = found;
    }
  }
}

/// Searches that do not need each other's results, at the same time. Threads do not inherit a rounding mode.
template <typename... Searches>
void at_the_same_time(const Searches&... searches) {
  tbb::parallel_invoke([&] {
    const rigor::UpwardRounding upward;
    searches();
  }...);
}

/// The sets of every purpose.
void find_all_sets(const sets::ContractionQuestion& question, ContractionCertificate& certificate) {
  const auto find_start = [&] { certificate.set = find_set(question, Objective::start_error); };
  const auto find_noise = [&] { certificate.noise_set = find_set(question, Objective::noise); };
  const auto find_slew = [&] { certificate.slew_set = find_set(question, Objective::slew); };
  if (question.with_limits) {
    at_the_same_time(find_start, find_noise, find_slew);
  } else {
    find_start();
    if (!certificate.set) {
      at_the_same_time(find_noise, find_slew);
    }
  }
  share_sets(question, certificate);
  if (!certificate.set && certificate.noise_set) {
    certificate.set = with_slew(question, certificate.noise_set->set);
  }
  if (!certificate.set) {
    return;
  }
  const auto find_bound = [&] { certificate.bound_set = find_set(question, Objective::frequency_bound); };
  // cannot bind (question.noise, question.slew): without either the searches that follow find nothing to
  // improve.
  const bool disturbed = certainly_positive(question.noise) || certainly_positive(question.slew);
  if (!disturbed) {
    find_bound();
    share_sets(question, certificate);
    return;
  }
  at_the_same_time(find_bound, [&] {
    certificate.ultimate_set = find_set(question, Objective::ultimate_error);
    if (!certificate.ultimate_set) {
      certificate.ultimate_set = find_inner_set(question, certificate.set->set);
    }
  });
  const Interval ultimate = Promises(question, sets_of(question, certificate)).ultimate_frequency_error();
  certificate.settling_set = find_set(question, Objective::settling,
                                      question.settled_frequency_error.value_or(2.0 * ultimate.upper()));
  share_sets(question, certificate);
}

/// As far as the question wants. A search for everything proves what a quick one proves, too.
void find_sets(const sets::ContractionQuestion& question, ContractionCertificate& certificate) {
  if (question.effort != sets::SearchEffort::everything) {
    certificate.set = find_sufficient_set(question);
    if (certificate.set || question.effort == sets::SearchEffort::quick) {
      return;
    }
  }
  find_all_sets(question, certificate);
  const auto is_satisfied = [&] {
    return !question.required.any() ||
           Promises(question, sets_of(question, certificate)).satisfy(question.required);
  };
  const auto add = [&](std::optional<Verification> sufficient) {
    if (sufficient) {
      (certificate.set ? certificate.settling_set : certificate.set) = std::move(sufficient);
    }
  };
  if (question.effort == sets::SearchEffort::everything && !is_satisfied()) {
    add(find_sufficient_set(question));
  }
  // A set for more does it for less.
  for (const sets::ContractionQuestion& harder : sets::harder_questions(question)) {
    if (is_satisfied()) {
      return;
    }
    add(find_sufficient_set(harder));
    if (!is_satisfied()) {
      // Together with the sets that there are it may be enough.
      const std::optional<Verification> before =
          std::exchange(certificate.bound_set, find_set(harder, Objective::frequency_bound));
      if (!certificate.bound_set || !is_satisfied()) {
        certificate.bound_set = before;
      } else if (!certificate.set) {
        certificate.set = certificate.bound_set;
      }
    }
  }
}

}  // namespace

ContractionCertificate certify_contraction(const sets::ContractionQuestion& asked) {
  const sets::ContractionQuestion question = with_start_covariance(asked, 0.0);
  const rigor::UpwardRounding upward;
  ContractionCertificate certificate;
  theorems::Derivation& derivation = certificate.derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction of the errors in an invariant set";
  derivation.notes = {
      "Covers the tracker in double precision (IEEE 754, round to nearest, sine and cosine within 1 ulp), at "
      "every frequency up to pi rad/sample, for a signal of constant amplitude.",
      "Amplitude error and noise are relative to the true amplitude; the set is described in the frame of "
      "the "
      "estimated phase."};
  const bool without_leak = question.design.without_leak();
  // cannot bind (question.design.q1): nothing is proposed for q1 = 0, where there is no steady covariance.
  if (without_leak && certainly_positive(question.design.q1) && sets::is_well_posed(question)) {
    find_sets(question, certificate);
  }
  derivation.conditions = {leak(question.design.epsilon), controllable_amplitude(question.design.q1),
                           invariant_set(question, certificate)};
  const Promises promises(question, sets_of(question, certificate));
  if (certificate.set) {
    derivation.conditions.push_back(start_in_set(question, certificate.set->set, promises.starts_inside()));
  }
  sets::KalmanFilterResult& result = certificate.result;
  set_size(certificate.set, result);
  set_promises(question, promises, result.starts);
  const auto& noisy = certificate.noise_set;
  const auto& slewing = certificate.slew_set;
  const auto is_lock = [](const std::optional<Verification>& found) {
    return found && sets::excludes_other_locks(error_bounds(found->set, Interval(found->set.radius))[2]);
  };
  set(result.largest_noise, "", is_lock(noisy) ? Interval(noisy->set.noise) : Interval());
  set(result.largest_slew, "", is_lock(slewing) ? Interval(slewing->set.slew) : Interval());
  if (certificate.set && question.with_samples) {
    add_sampled_quantities(question, certificate, derivation);
  }
  sets::conclude(derivation, result);
  return certificate;
}

}  // namespace veritrack::quadrature

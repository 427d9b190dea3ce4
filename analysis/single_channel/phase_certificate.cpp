#include "analysis/single_channel/phase_certificate.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/sets/controllability.hpp"
#include "analysis/sets/harder_questions.hpp"
#include "analysis/sets/lock_limit.hpp"
#include "analysis/single_channel/phase_promises.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;

constexpr const char* kNone = "No set of errors could be certified under the assumed noise and slew.";

Condition leak(const Interval& epsilon) {
  const bool none = epsilon == Interval(0.0);
  return {"leak",
          "\\epsilon = 0",
          none ? Verdict::proved : Verdict::undecided,
          epsilon,
          Interval(0.0),
          none ? "there is no leak, so the errors settle at zero."
               : "with a leak the errors settle at a function of the phase, not at zero; this certificate "
                 "does not cover that, but may cover the design without its leak."};
}

Condition controllable_amplitude(const trackers::ToneModel<Interval>& design) {
  const sets::UncontrollableMode mode = sets::find_uncontrollable_mode(design);
  const bool driven = certainly_positive(design.q1);
  return {"controllable-amplitude",
          "q_1 > 0",
          mode.verdict == Verdict::proved ? Verdict::refuted
          : driven                        ? Verdict::proved
                                          : Verdict::undecided,
          design.q1,
          Interval(0.0),
          driven ? "process noise reaches the amplitude."
                 : mode.reason + ". Witness: w = (1, 0, 0), w F = w, w Q = 0, at every phase."};
}

Condition invariant_set(const PhaseQuestion& question, const PhaseCertificate& certificate) {
  Condition condition{"invariant-set",
                      "(\\kappa_n + c R \\sum_m \\kappa_m) R + g^n \\sqrt n\\,u + \\varrho \\sum_m "
                      "\\kappa_m \\le R",
                      Verdict::undecided,
                      {},
                      {},
                      {},
                      theorems::Sense::at_most};  // rounding is bounded from above

  if (certificate.set) {
    const WindowErrors errors = errors_of(question, *certificate.set);
    const auto n = static_cast<double>(errors.window());
    condition.verdict = Verdict::proved;
    condition.rhs = Interval(certificate.set->claim.assumption.radius);
    condition.lhs = errors.after_window(condition.rhs);
    condition.reason = "verified over all phases and the band, for windows of " +
                       rigor::to_decimal(n, 2, Direction::up) + " samples.";
    return condition;
  }
  if (question.tracker.effort == sets::SearchEffort::quick) {
    condition.reason = "a quick search found no set that does all that is required.";
    return condition;
  }
  const auto& noisy = certificate.noise_set;
  const auto& slewing = certificate.slew_set;
  condition.reason =
      "no set could be certified for this noise, slew and band: " +
      sets::beyond_the_limits(question.tracker, noisy ? std::optional(noisy->noise.lower()) : std::nullopt,
                              slewing ? std::optional(slewing->slew.lower()) : std::nullopt) +
      ".";
  return condition;
}

StartFinding find_start(const PhaseQuestion& question, const PhaseCertificate& certificate,
                        double level_seen) {
  using Kind = StartFinding::Kind;
  return {certificate.bound_set               ? Kind::in_set
          : question.tracker.start_covariance ? Kind::covariance_is_given
                                              : Kind::outside,
          level_seen};
}

/// Without words, which are up to those who know the design file.
Condition start_in_set(const PhaseCertificate& certificate) {
  Condition condition{"start-in-set",
                      {},
                      certificate.bound_set ? Verdict::proved : Verdict::undecided,
                      {},
                      Interval(certificate.set->start_level),
                      {},
                      theorems::Sense::at_most};
  if (certificate.bound_set) {
    condition.lhs = Interval(*certificate.bound_set->assumed_level);
    condition.rhs = Interval(certificate.bound_set->start_level);
  }
  return condition;
}

void set(theorems::Quantity& quantity, const char* formula, const Interval& value,
         std::string why_not = kNone) {
  quantity.formula = formula;
  quantity.source = "docs/single-channel.md";
  theorems::set_value(quantity, value, std::move(why_not));
}

/// How far the set of starts reaches, whatever phase and frequency (lower end), and what it never exceeds.
struct Reach {
  Interval frequency;  ///< rad/sample
  Interval phase;      ///< rad
  Interval amplitude;  ///< relative
};

Reach reach_of(const PhaseSet& set) {
  const Interval level(set.start_level);
  const Interval signal = level * sqrt(Interval(set.claim.assumption.signal_variance));
  const Interval frequency = level * sqrt(Interval(set.claim.assumption.frequency_variance));
  const Interval one(1.0);
  // |z| >= 1 + delta_1, and tan(arg z) = delta_2 / (1 + delta_1).
  const Interval least_phase = atan(level * sqrt(Interval(set.floor.p22)) / (one + signal));
  const Interval largest_phase = atan(signal / sqrt(one - square(signal)));
  return {hull(level * sqrt(Interval(set.floor.p33)), frequency), hull(least_phase, largest_phase),
          hull(level * sqrt(Interval(set.floor.p11)), signal)};
}

/// Whether there is a set, and the frequency errors in it tell the lock from others.
bool is_lock(const PhaseQuestion& question, const std::optional<PhaseSet>& found) {
  return found && sets::excludes_other_locks(Interval(found->claim.assumption.radius) *
                                                 sqrt(Interval(found->claim.assumption.frequency_variance)),
                                             question.band);
}

void set_size(const PhaseQuestion& question, const std::optional<PhaseSet>& set_found,
              sets::KalmanFilterResult& result) {
  const Reach reach = set_found ? reach_of(*set_found) : Reach{};
  if (set_found) {
    result.rate_window = errors_of(question, *set_found).window();
  }
  result.contraction_rate.words =
      "factor of the error per sample, the mean over a window, before noise and slew";
  set(result.contraction_rate, "(\\kappa_n + c R \\textstyle\\sum_m \\kappa_m)^{1/n}",
      set_found ? errors_of(question, *set_found).rate() : Interval());
  result.radius.symbol = "R_0";
  set(result.radius, "e' P^{-1} e \\le R_0^2", set_found ? Interval(set_found->start_level) : Interval());
  set(result.frequency_error_radius, "R_0 \\sqrt{P_{33}}",
      is_lock(question, set_found) ? reach.frequency : Interval());
  set(result.phase_error_radius, "", reach.phase);
  set(result.amplitude_error_radius, "", reach.amplitude);
}

/// Sets the promises for the assumed starts, or else for the starts of the set.
void set_promises(const PhaseQuestion& question, const PhaseCertificate& certificate,
                  sets::StartResult& starts) {
  const std::optional<PhaseSet>& best = certificate.bound_set ? certificate.bound_set : certificate.set;
  const Interval ultimate = best ? ultimate_frequency_error(question, *best) : Interval();
  const double start = best ? best->assumed_level.value_or(best->start_level) : 0.0;
  set(starts.ultimate_frequency_error, "\\limsup x_k\\,\\sqrt{P_{33}}", ultimate);
  set(starts.frequency_error_bound, "\\sup_k x_k\\,\\sqrt{P_{33}}",
      certificate.bound_set ? frequency_error_bound(question, *certificate.bound_set, start) : Interval(),
      certificate.set ? "The assumed starts are not in a certified set." : kNone);
  const bool disturbed =
      certainly_positive(question.tracker.noise) || certainly_positive(question.tracker.slew);
  Interval settling;
  Interval settled;
  if (best) {
    // Nobody waits for the error that rounding alone leaves.
    const std::optional<double> of_ultimate =
        disturbed ? std::optional((Interval(2.0) * ultimate).upper()) : std::nullopt;
    for (const std::optional<double>& level : {question.tracker.settled_frequency_error, of_ultimate}) {
      if (level && *level > 0.0 && !rigor::is_finite(settling)) {
        settling = settling_samples(question, *best, start, *level);
        settled = rigor::is_finite(settling) ? Interval(*level) : Interval();
      }
    }
  }
  const char* why_not = !best ? kNone
                        : disturbed
                            ? "No certified set gives a settling time."
                            : "Without noise and slew only rounding is left of the bound in the long run, "
                              "and no settling time is computed.";
  set(starts.settling_samples, "|\\nu(k)| \\le \\nu_s \\text{ for } k \\ge k_s", settling, why_not);
  set(starts.settled_frequency_error, "", settled, why_not);
}

sets::KalmanFilterResult result_of(const PhaseQuestion& question, const PhaseCertificate& certificate) {
  sets::KalmanFilterResult result;
  set_size(question, certificate.set, result);
  set_promises(question, certificate, result.starts);
  set(result.largest_noise, "",
      is_lock(question, certificate.noise_set) ? certificate.noise_set->noise : Interval(),
      "No noise could be certified.");
  set(result.largest_slew, "",
      is_lock(question, certificate.slew_set) ? certificate.slew_set->slew : Interval(),
      "No slew could be certified.");
  theorems::Quantity& bias = result.bias_frequency.emplace(sets::quantities::bias_frequency());
  bias.symbol = "\\nu_*";
  set(bias, "0", question.tracker.design.without_leak() && certificate.set ? Interval(0.0) : Interval());
  return result;
}

/// The numbers from which a set is verified again (docs/certificate-format.md).
theorems::Evidence evidence_of(const char* name, const PhaseSet& set) {
  const WindowClaim& claim = set.claim;
  const WindowAssumption& assumption = claim.assumption;
  theorems::Evidence evidence{name,
                              {{"radius", assumption.radius},
                               {"frequency_variance", assumption.frequency_variance},
                               {"signal_variance", assumption.signal_variance},
                               {"loosening", assumption.loosening},
                               {"noise", set.noise.upper()},
                               {"slew", claim.slew},
                               {"curvature", claim.curvature},
                               {"curvature_weight", claim.curvature_weight},
                               {"signal_uncertainty", claim.signal_uncertainty},
                               {"start_level", set.start_level}},
                              {}};
  for (std::size_t m = 1; m <= claim.shares.size(); ++m) {
    evidence.numbers.emplace_back("share_" + std::to_string(m), claim.shares[m - 1]);
  }
  return evidence;
}

/// Where what is required is not proved: a set for more that does it.
void add_set_for_more(const PhaseQuestion& question, PhaseCertificate& certificate) {
  constexpr std::size_t kMost = 5;
  const Interval band = sets::aligned_band(question.band);
  std::vector<sets::ContractionQuestion> questions = sets::harder_questions(question.tracker);
  questions.resize(std::min(questions.size(), kMost));
  for (const sets::ContractionQuestion& harder : questions) {
    if (certificate.bound_set && satisfies(question, *certificate.bound_set)) {
      return;
    }
    std::optional<PhaseSet> found = PhaseSearch({harder, band}).sufficient_set();
    if (found && certainly_less_equal(question.tracker.noise, found->noise) &&
        certainly_less_equal(question.tracker.slew, found->slew) && satisfies(question, *found)) {
      certificate.bound_set = std::move(found);
      if (!certificate.set) {
        certificate.set = certificate.bound_set;
      }
    }
  }
}

/// As far as the question wants. A search for everything proves the requirements that one set proves, too.
void look_for_sets(const PhaseQuestion& question, PhaseCertificate& certificate, double& level_seen) {
  const sets::ContractionQuestion& asked = question.tracker;
  const PhaseSearch search(question);
  if (asked.effort != sets::SearchEffort::everything && !asked.start_covariance) {
    // One set that does all that is required is the set of the certificate, too.
    certificate.bound_set = search.sufficient_set();
    certificate.set = certificate.bound_set;
    if (certificate.set || asked.effort == sets::SearchEffort::quick) {
      return;
    }
  }
  certificate.set = search.largest_set();
  if (certificate.set && !asked.start_covariance) {
    certificate.bound_set = search.least_bound();
    if (asked.effort == sets::SearchEffort::everything && asked.required.any() && certificate.bound_set &&
        !satisfies(question, *certificate.bound_set)) {
      if (auto sufficient = search.sufficient_set()) {
        certificate.bound_set = std::move(sufficient);
      }
    }
    level_seen = search.start_level_seen(*certificate.set);
  }
  if (asked.required.any() && !asked.start_covariance) {
    add_set_for_more(question, certificate);
  }
  if (asked.with_limits || !certificate.set) {
    certificate.noise_set = search.largest_noise();
    certificate.slew_set = search.largest_slew();
  }
}

}  // namespace

PhaseCertificate certify_over_phases(const PhaseQuestion& question) {
  const rigor::UpwardRounding upward;
  PhaseCertificate certificate;
  theorems::Derivation& derivation = certificate.derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction of the errors over all phases and the band of frequencies";
  derivation.notes = {
      "Covers the tracker in double precision, at every phase, for every frequency that stays in the band, "
      "for a signal of constant amplitude (docs/rounding.md says what is assumed of the program).",
      "The metric is the inverse of the tracker's own covariance, in which errors decrease over a window of "
      "samples. Amplitude error and noise are relative to the true amplitude."};
  const bool sensible = sets::is_well_posed(question.tracker) && is_finite(question.band);
  derivation.conditions = {leak(question.tracker.design.epsilon),
                           controllable_amplitude(question.tracker.design)};
  const bool covered = std::all_of(derivation.conditions.begin(), derivation.conditions.end(),
                                   [](const Condition& one) { return one.verdict == Verdict::proved; });
  double level_seen = 0.0;
  if (sensible && covered) {
    look_for_sets(question, certificate, level_seen);
  }
  const std::pair<const char*, const std::optional<PhaseSet>*> sets[] = {
      {"start-error", &certificate.set},
      {"frequency-error-bound", &certificate.bound_set},
      {"largest-noise", &certificate.noise_set},
      {"largest-slew", &certificate.slew_set}};
  for (const auto& [name, set] : sets) {
    if (*set) {
      derivation.evidence.push_back(evidence_of(name, **set));
    }
  }
  if (certificate.bound_set) {
    const DiagonalStart& start = certificate.bound_set->start.value();
    theorems::Evidence evidence{"start-covariance", {}, {}, {}};
    evidence.decimals = {{"p11", start.signal}, {"p12", "0"},    {"p13", "0"},
                         {"p22", start.signal}, {"p23", "0"},    {"p33", start.frequency},
                         {"from", start.from},  {"to", start.to}};
    derivation.evidence.push_back(std::move(evidence));
  }
  if (certificate.set) {
    auto& numbers = derivation.evidence.front().numbers;
    numbers.emplace_back("least_p11", certificate.set->floor.p11);
    numbers.emplace_back("least_p22", certificate.set->floor.p22);
    numbers.emplace_back("least_p33", certificate.set->floor.p33);
  }
  derivation.conditions.push_back(invariant_set(question, certificate));
  if (certificate.set) {
    certificate.start = find_start(question, certificate, level_seen);
    derivation.conditions.push_back(start_in_set(certificate));
  }
  certificate.result = result_of(question, certificate);
  sets::conclude(derivation, certificate.result);
  return certificate;
}

}  // namespace veritrack::single_channel

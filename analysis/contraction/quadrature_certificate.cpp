#include "analysis/contraction/quadrature_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/contraction/proposal.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

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

/// The largest proposal on a ladder of fractions that verifies; nothing when none does. Runs in the rounding
/// mode of the filter; the verification opens its own.
std::optional<Verification> largest_set(const ContractionQuestion& question, Objective objective) {
  const rigor::NearestRounding nearest;
  ProposalRequest request;
  const auto& design = question.design;
  request.design = {midpoint(design.q1), midpoint(design.q2), midpoint(design.r), 0.0};
  request.objective = objective;
  if (objective == Objective::start_error) {
    request.noise = question.noise.upper();
    request.slew = question.slew.upper();
  }
  request.evaluations = question.search_evaluations;
  const auto shape = propose_shape(request);
  if (!shape) {
    return std::nullopt;
  }
  for (const double fraction : {0.8, 0.7, 0.6, 0.45, 0.3, 0.15, 0.05}) {
    const auto proposal = propose_set(request, *shape, fraction);
    if (!proposal) {
      continue;
    }
    Verification verification = verify_certified_set(design, *proposal);
    // A proposal is not to be believed, not even in the noise and slew that it was asked to bear.
    const rigor::UpwardRounding upward;
    const bool bears_what_is_assumed =
        objective != Objective::start_error ||
        (certainly_less_equal(question.noise, Interval(verification.set.noise)) &&
         certainly_less_equal(question.slew, Interval(verification.set.slew)));
    if (verification.verdict == Verdict::proved && bears_what_is_assumed) {
      return verification;
    }
  }
  return std::nullopt;
}

Quantity quantity(std::string name, std::string symbol, std::string formula, const Interval& value) {
  return {std::move(name), std::move(symbol), std::move(formula), kSource, value, std::nullopt};
}
Quantity missing(std::string name, std::string symbol, std::string formula, std::string why) {
  return {std::move(name), std::move(symbol), std::move(formula), kSource, Interval(), std::move(why)};
}

/// Everything that is said of the set for the assumed noise and slew.
class SetReport {
 public:
  SetReport(const ContractionQuestion& question, const CertifiedSet& set)
      : set_(set), rate_(set.rate), radius_(set.radius) {
    ultimate_ = ultimate_level(set, question.noise, question.slew);
    IntervalVector<3> start;
    start << rigor::symmetric(question.initial_amplitude_error.upper()),
        rigor::symmetric(question.initial_phase_error.upper()),
        rigor::symmetric(question.initial_frequency_error.upper());
    start_level_ = metric_norm(set, start);
    // For the steady state nothing needs to be checked: the bounds are invariant under the Riccati map at
    // |z| = 1 without a turn, whose iterates from any covariance tend to the steady state.
    starts_inside_ = question.initial_covariance
                         ? certainly_contains(set, start, *question.initial_covariance)
                         : certainly_less_equal(start_level_, radius_);
  }

  [[nodiscard]] Condition start_in_set() const {
    Condition condition{"start-in-set",
                        "|T e(0)| \\le R,\\ P_{lo} \\le P(0) \\le P_{hi}",
                        starts_inside_ ? Verdict::proved : Verdict::undecided,
                        Interval(start_level_.upper()),
                        radius_,
                        {}};
    condition.reason =
        starts_inside_ ? "every assumed start lies in the certified set."
        : certainly_less_equal(start_level_, radius_)
            ? "the initial covariance is not certainly between the bounds of the certified set."
            : "the assumed start errors reach " + at_most(start_level_) +
                  " in a metric where the set ends at " + at_least(radius_) +
                  ": smaller start errors, or a proof of capture, would do.";
    return condition;
  }

  void add_to(std::vector<Quantity>& quantities) const {
    const IntervalVector<3> bounds = error_bounds(set_, radius_);
    quantities.push_back(quantity("contraction_rate", "\\kappa", "\\sup |T e^+| / |T e|", rate_));
    quantities.push_back(quantity("radius", "R", "", radius_));
    quantities.push_back(quantity("frequency_error_radius", "\\nu_R", "R\\,|e_3' T^{-1}|", bounds[2]));
    quantities.push_back(quantity("phase_error_radius", "\\psi_R", "R\\,|e_2' T^{-1}|", bounds[1]));
    quantities.push_back(quantity("amplitude_error_radius", "a_R", "R\\,|e_1' T^{-1}|", bounds[0]));
    quantities.push_back(quantity("ultimate_frequency_error", "\\nu_\\infty",
                                  "\\frac{L_v V + L_w W}{1 - \\kappa}\\,|e_3' T^{-1}|",
                                  error_bounds(set_, ultimate_)[2]));
    add_bound(quantities);
    add_settling(quantities);
  }

 private:
  /// |T e(k)| <= kappa^k l + (1 - kappa^k) u <= max(l, u).
  void add_bound(std::vector<Quantity>& quantities) const {
    const std::string name = "frequency_error_bound";
    const std::string symbol = "\\sup_k |\\nu(k)|";
    const std::string formula = "\\max(|T e(0)|, \\tfrac{L_v V + L_w W}{1 - \\kappa})\\,|e_3' T^{-1}|";
    if (!starts_inside_) {
      quantities.push_back(
          missing(name, symbol, formula, "The assumed starts are not in the certified set."));
      return;
    }
    const Interval level(std::max(start_level_.upper(), ultimate_.upper()));
    quantities.push_back(quantity(name, symbol, formula, Interval(error_bounds(set_, level)[2].upper())));
  }

  /// The least k with kappa^k l <= u: then |T e(k)| <= 2 u.
  void add_settling(std::vector<Quantity>& quantities) const {
    const std::string name = "settling_samples";
    const std::string symbol = "k_s";
    const std::string formula =
        "\\lceil \\log(u / |T e(0)|) / \\log \\kappa \\rceil,\\ u = \\tfrac{L_v V + L_w W}{1 - \\kappa}";
    if (!certainly_positive(ultimate_)) {
      quantities.push_back(missing(name, symbol, formula,
                                   "Without noise and slew the ultimate bound is zero, which is approached "
                                   "but not reached."));
      return;
    }
    const Interval start(starts_inside_ ? start_level_.upper() : radius_.upper());
    const Interval smallest(ultimate_.lower());
    if (certainly_less_equal(start, smallest)) {
      quantities.push_back(quantity(name, symbol, formula, Interval(0.0)));
      return;
    }
    const Interval samples = rigor::log(smallest / start) / rigor::log(rate_);
    quantities.push_back(quantity(name, symbol, formula, Interval(std::ceil(samples.upper()))));
  }

  CertifiedSet set_;
  Interval rate_;
  Interval radius_;
  Interval ultimate_;
  Interval start_level_;
  bool starts_inside_ = false;
};

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
  Condition condition{"invariant-set", "\\kappa R + L_v V + L_w W \\le R", Verdict::undecided, {}, {}, {}};
  if (certificate.set) {
    const CertifiedSet& set = certificate.set->set;
    condition.verdict = certificate.set->verdict;
    condition.lhs = Interval(set.rate) * Interval(set.radius) +
                    Interval(set.noise_gain) * Interval(set.noise) +
                    Interval(set.slew_gain) * Interval(set.slew);
    condition.rhs = Interval(set.radius);
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
    certificate.set = largest_set(question, Objective::start_error);
    certificate.noise_set = largest_set(question, Objective::noise);
    certificate.slew_set = largest_set(question, Objective::slew);
  }
  derivation.conditions = {leak(question.design.epsilon), controllable_amplitude(question.design.q1),
                           invariant_set(question, certificate)};
  auto& quantities = derivation.quantities;
  if (certificate.set) {
    const SetReport report(question, certificate.set->set);
    derivation.conditions.push_back(report.start_in_set());
    report.add_to(quantities);
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
  std::vector<Verdict> verdicts;
  for (const Condition& condition : derivation.conditions) {
    verdicts.push_back(condition.verdict);
  }
  derivation.verdict = rigor::conjunction(verdicts);
  return certificate;
}

}  // namespace veritrack::contraction

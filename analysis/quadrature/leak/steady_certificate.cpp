#include "analysis/quadrature/leak/steady_certificate.hpp"

#include <utility>

#include "analysis/quadrature/falsifier/steady_sampled_quantities.hpp"
#include "analysis/quadrature/leak/steady_report.hpp"
#include "analysis/quadrature/leak/steady_search.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/theorems/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;
using Tube = sets::FixedPointTube<sets::QuadraturePolarLoop::kStates>;

constexpr const char* kSource = "docs/leak.md";

theorems::Evidence evidence_of(const char* name, const SteadySet& set) {
  theorems::Evidence evidence{
      name,
      {{"noise", set.noise}, {"slew", set.slew}},
      {{"metric", set.metric}, {"covariance_below", set.below}, {"covariance_above", set.above}}};
  for (std::size_t j = 0; j < set.levels.size(); ++j) {
    evidence.numbers.emplace_back("s_" + std::to_string(j), set.levels[j]);
  }
  return evidence;
}

/// The sets that were verified: everything that is said is proved from them.
std::vector<theorems::Evidence> evidence_of(const SteadySearch& search) {
  std::vector<theorems::Evidence> evidence;
  if (search.found()) {
    evidence.push_back(evidence_of("start-error", search.set->set));
  }
  if (search.noise_set) {
    evidence.push_back(evidence_of("largest-noise", *search.noise_set));
  }
  if (search.slew_set) {
    evidence.push_back(evidence_of("largest-slew", *search.slew_set));
  }
  return evidence;
}

}  // namespace

LeakCertificate certify_with_leak(const LeakQuestion& question) {
  const rigor::UpwardRounding upward;
  LeakCertificate certificate;
  theorems::Derivation& derivation = certificate.derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction in a set around the steady state of every frequency of the band";
  derivation.notes = {
      "Covers the tracker in exact arithmetic, for every frequency of the band, signal amplitude constant.",
      "With a leak the tracker settles off the truth: radii are about the steady state, error bounds about "
      "the truth. Amplitude error and noise are relative to the true amplitude."};
  // Wider cells are fewer, narrower ones give larger sets.
  constexpr double kCellWidth = 0.1;  // rad/sample
  const sets::LockBranch branch =
      sets::verify_lock_branch(question.tracker.design, question.band, {.largest = kCellWidth});
  double largest_noise = 0.0;
  double largest_slew = 0.0;
  std::string why = branch.reason;
  if (branch.verdict == Verdict::proved && is_finite(question.band) &&
      sets::is_well_posed(question.tracker)) {
    SteadySearch search = search_steady_sets(question.tracker, branch);
    why = "no set was found in which the steps contract";
    largest_noise = search.largest_noise();
    largest_slew = search.largest_slew();
    derivation.evidence = evidence_of(search);
    certificate.set = std::move(search.set);
  }
  const bool proved = certificate.set && certificate.set->verdict == Verdict::proved;
  if (certificate.set) {
    why = certificate.set->reason;
  }
  Condition invariant{"invariant-set",
                      "\\Omega_{s_j} \\to \\Omega_{s_{j+1}}",
                      proved ? Verdict::proved : Verdict::undecided,
                      Interval::empty(),
                      Interval(1.0),
                      why};
  if (!proved && branch.verdict == Verdict::proved) {
    invariant.reason = "no set could be certified for this noise and slew: " + why + " Of the limits: " +
                       sets::beyond_the_limits(question.tracker, largest_noise, largest_slew) + ".";
  }
  std::optional<SteadyReport> report;
  std::optional<Interval> rate;
  if (proved) {
    report.emplace(question.tracker, branch, certificate.set->set);
    rate = report->rate();
    invariant.lhs = *rate;
  }
  derivation.conditions = {{"steady-state", "X^*(\\omega) = G(X^*(\\omega)) \\text{ on the band}",
                            branch.verdict, Interval::empty(), Interval::empty(), branch.reason},
                           invariant};
  if (report) {
    derivation.conditions.push_back(report->start_in_set());
  }
  const auto said = [&](const auto& function) {
    return report ? std::optional<Interval>(function(*report)) : std::nullopt;
  };
  const auto radius = [&](Eigen::Index i) {
    return said([i](const SteadyReport& r) { return r.radius(i); });
  };
  const std::string outside =
      report ? "The assumed starts do not certainly come into the certified set." : why;
  const auto add = [&](const char* name, const char* symbol, const char* formula,
                       const std::optional<Interval>& value, const std::string& missing) {
    theorems::add_quantity(derivation, {name, symbol, formula, kSource}, value.value_or(Interval()), missing);
  };
  add("contraction_rate", "\\kappa", "\\max_j s_{j+1} / s_j", rate, why);
  add("radius", "R", "|T (e - e^*)| \\le 1", report ? std::optional(Interval(1.0)) : std::nullopt, why);
  add("frequency_error_radius", "\\nu_R", "|e_3' T^{-1}|", radius(2), why);
  add("phase_error_radius", "\\psi_R", "|e_2' T^{-1}|", radius(1), why);
  add("amplitude_error_radius", "a_R", "|e_1' T^{-1}|", radius(0), why);
  add("ultimate_frequency_error", "\\nu_\\infty", "\\sup_\\omega |\\nu^*| + s_n |e_3' T^{-1}|",
      said([](const SteadyReport& r) { return r.ultimate(); }), why);
  add("frequency_error_bound", "\\sup_k |\\nu(k)|",
      "\\sup_\\omega (|\\nu^*| + \\max(s(k_c), s_{j(k_c)+1}) |e_3' T^{-1}|)",
      report ? report->bound() : std::nullopt, outside);
  add("capture_samples", "k_c", "", report ? report->capture_samples() : std::nullopt, outside);
  add("settling_samples", "k_s", "k_c + n - j(k_c),\\ s_{j(k_c)} \\ge s(k_c)",
      said([](const SteadyReport& r) { return r.settling(); }), why);
  add("largest_noise", "V_{max}", "",
      largest_noise > 0.0 ? std::optional(Interval(largest_noise)) : std::nullopt, why);
  add("largest_slew", "W_{max}", "",
      largest_slew > 0.0 ? std::optional(Interval(largest_slew)) : std::nullopt, why);
  derivation.quantities.push_back(sets::frequency_bias(branch));
  if (report && question.tracker.with_samples) {
    add_steady_sampled_quantities(claims_of(question.tracker.design, branch, certificate.set->set),
                                  derivation);
  }
  theorems::conclude(derivation);
  return certificate;
}

}  // namespace veritrack::quadrature

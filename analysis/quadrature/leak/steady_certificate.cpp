#include "analysis/quadrature/leak/steady_certificate.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "analysis/quadrature/falsifier/steady_sampled_quantities.hpp"
#include "analysis/quadrature/leak/steady_search.hpp"
#include "analysis/quadrature/start_covariance.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/sets/fixed_point_bias.hpp"
#include "analysis/sets/harder_questions.hpp"
#include "analysis/sets/lock_limit.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;

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

/// Appends sets that cover the band: one as it is, several with their frequencies.
void add_evidence(const char* name, const std::vector<SteadyPiece>& pieces,
                  std::vector<theorems::Evidence>& evidence) {
  for (const SteadyPiece& piece : pieces) {
    evidence.push_back(evidence_of(name, piece.set));
    if (pieces.size() > 1) {
      evidence.back().numbers.emplace_back("from", piece.from);
      evidence.back().numbers.emplace_back("to", piece.to);
    }
  }
}

/// The sets that were verified: everything that is said is proved from them.
std::vector<theorems::Evidence> evidence_of(const SteadySearch& search) {
  std::vector<theorems::Evidence> evidence;
  if (search.found()) {
    evidence.push_back(evidence_of("start-error", search.set->set));
  }
  add_evidence("frequency-error-radius", search.radius_sets, evidence);
  add_evidence("largest-noise", search.noise_sets, evidence);
  if (search.slew_set) {
    evidence.push_back(evidence_of("largest-slew", *search.slew_set));
  }
  return evidence;
}

/// The object of the search, and how far it came.
struct Search {
  sets::LockBranch branch;
  double largest_noise = 0.0;  ///< zero when none was certified
  double largest_slew = 0.0;
  bool is_lock = false;  ///< the frequency errors in every set tell the lock from others
  std::vector<SteadyPiece> radius_sets;
  std::string why;  ///< a clause: why there is no set, or the ground of the set
};

/// Whether the frequency errors in all sets that were found tell the lock from others.
bool are_lock(const SteadySearch& found, const sets::LockBranch& branch) {
  const Interval bias = abs(sets::frequency_bias(branch).value);
  const auto is_lock = [&](const SteadySet& set) {
    return sets::excludes_other_locks(bias + error_bounds(set, Interval(1.0))[2]);
  };
  const auto of_piece = [&](const SteadyPiece& piece) { return is_lock(piece.set); };
  return (!found.set || is_lock(found.set->set)) && (!found.slew_set || is_lock(*found.slew_set)) &&
         std::all_of(found.noise_sets.begin(), found.noise_sets.end(), of_piece) &&
         std::all_of(found.radius_sets.begin(), found.radius_sets.end(), of_piece);
}

/// Looks for sets around the lock branch of the band; what is found goes to the certificate.
Search search(const LeakQuestion& question, LeakCertificate& certificate) {
  // Wider cells are fewer, narrower ones give larger sets.
  constexpr double kCellWidth = 0.1;  // rad/sample
  Search search;
  search.branch = sets::verify_lock_branch(question.tracker.design, question.band, {.largest = kCellWidth});
  search.why = search.branch.reason;
  if (search.branch.verdict == Verdict::proved && is_finite(question.band) &&
      sets::is_well_posed(question.tracker)) {
    SteadySearch found = search_steady_sets(question.tracker, search.branch);
    search.why = "no set was found in which the steps contract";
    search.is_lock = are_lock(found, search.branch);
    search.largest_noise = search.is_lock ? found.largest_noise() : 0.0;
    search.largest_slew = search.is_lock ? found.largest_slew() : 0.0;
    certificate.derivation.evidence = evidence_of(found);
    search.radius_sets = std::move(found.radius_sets);
    certificate.set = std::move(found.set);
  }
  if (certificate.set) {
    search.why = certificate.set->reason;
  }
  return search;
}

/// True only when the set, which must be PROVED, does all that is required of the assumed starts.
bool satisfies(const sets::ContractionQuestion& question, const SteadyReport& report) {
  const std::optional<Interval> bound = report.bound();
  const sets::RequiredBounds& required = question.required;
  return bound &&
         (!required.frequency_error || certainly_less(*bound, Interval(*required.frequency_error))) &&
         (!required.samples ||
          (certainly_less_equal(*report.settling(), Interval(*required.samples)) &&
           question.settled_frequency_error &&
           certainly_less_equal(report.ultimate(), Interval(*question.settled_frequency_error))));
}

bool is_proved(const std::optional<SteadyVerification>& set) {
  return set && set->verdict == Verdict::proved;
}

/// Where what is required is not proved: a set for more, over more frequencies, that does it.
void replace_by_set_for_more(const LeakQuestion& question, Search& search, LeakCertificate& certificate) {
  const sets::ContractionQuestion& tracker = question.tracker;
  const auto is_enough = [&](const std::optional<SteadyVerification>& set) {
    return is_proved(set) && certainly_less_equal(tracker.noise, Interval(set->set.noise)) &&
           certainly_less_equal(tracker.slew, Interval(set->set.slew)) &&
           satisfies(tracker, SteadyReport(tracker, search.branch, set->set));
  };
  if (!tracker.required.any() || search.branch.verdict != Verdict::proved || is_enough(certificate.set)) {
    return;
  }
  constexpr double kCellWidth = 0.1;  // rad/sample
  constexpr std::size_t kMost = 3;
  const sets::LockBranch wider =
      sets::verify_lock_branch(tracker.design, sets::aligned_band(question.band), {.largest = kCellWidth});
  std::vector<sets::ContractionQuestion> questions = sets::harder_questions(tracker);
  questions.resize(std::min(questions.size(), kMost));
  for (sets::ContractionQuestion& harder : questions) {
    harder.with_limits = false;
    const SteadySearch found =
        search_steady_sets(harder, wider.verdict == Verdict::proved ? wider : search.branch);
    if (!found.found()) {
      continue;
    }
    auto here = verify_steady_set(tracker.design, search.branch.cells, found.set->set,
                                  {tracker.amplitude, tracker.largest_frequency});
    if (is_enough(here)) {
      certificate.set = std::move(here);
      search.why = certificate.set->reason;
      std::erase_if(certificate.derivation.evidence,
                    [](const theorems::Evidence& one) { return one.name == "start-error"; });
      certificate.derivation.evidence.insert(certificate.derivation.evidence.begin(),
                                             evidence_of("start-error", certificate.set->set));
      return;
    }
  }
}

Condition invariant_set(const LeakQuestion& question, const Search& search,
                        const std::optional<Interval>& rate) {
  Condition invariant{"invariant-set",
                      "\\Omega_{s_j} \\to \\Omega_{s_{j+1}}",
                      rate ? Verdict::proved : Verdict::undecided,
                      rate.value_or(Interval::empty()),
                      Interval(1.0),
                      search.why,
                      theorems::Sense::at_most};
  if (!rate && search.branch.verdict == Verdict::proved) {
    invariant.reason = "no set could be certified for this noise and slew: " + search.why + " The limits: " +
                       sets::beyond_the_limits(question.tracker, search.largest_noise, search.largest_slew) +
                       ".";
  }
  return invariant;
}

void set(theorems::Quantity& quantity, const char* formula, const std::optional<Interval>& value,
         const std::string& why_not) {
  quantity.formula = formula;
  quantity.source = kSource;
  theorems::set_value(quantity, value.value_or(Interval()), why_not);
}

std::optional<Interval> above_zero(double limit) {
  return limit > 0.0 ? std::optional(Interval(limit)) : std::nullopt;
}

/// The size of an error that every one of the sets contains.
Interval least_radius(const std::vector<SteadyPiece>& pieces, Eigen::Index i) {
  Interval least(std::numeric_limits<double>::max());
  for (const SteadyPiece& piece : pieces) {
    least = rigor::min(least, error_bounds(piece.set, Interval(1.0))[i]);
  }
  return least;
}

/// The result; `report` is there when a set is PROVED.
sets::KalmanFilterResult result_of(const Search& search, const std::optional<SteadyReport>& report,
                                   const std::optional<Interval>& rate) {
  const std::string& why = search.why;
  const auto said = [&](const auto& function) {
    return report ? std::optional<Interval>(function(*report)) : std::nullopt;
  };
  const auto radius = [&](Eigen::Index i) {
    return said([&](const SteadyReport& r) {
      return search.radius_sets.empty() ? r.radius(i) : least_radius(search.radius_sets, i);
    });
  };
  sets::KalmanFilterResult result;
  result.about_steady_state = true;
  set(result.contraction_rate, "\\max_j s_{j+1} / s_j", rate, why);
  set(result.radius, "|T (e - e^*)| \\le 1", report ? std::optional(Interval(1.0)) : std::nullopt, why);
  set(result.frequency_error_radius, "|e_3' T^{-1}|", search.is_lock ? radius(2) : std::nullopt, why);
  set(result.phase_error_radius, "|e_2' T^{-1}|", radius(1), why);
  set(result.amplitude_error_radius, "|e_1' T^{-1}|", radius(0), why);
  sets::StartResult& starts = result.starts;
  const std::string outside = report ? "The assumed starts are not proved to enter the certified set." : why;
  set(starts.ultimate_frequency_error, "\\sup_\\omega |\\nu^*| + s_n |e_3' T^{-1}|",
      said([](const SteadyReport& r) { return r.ultimate(); }), why);
  set(starts.frequency_error_bound, "\\sup_\\omega (|\\nu^*| + \\max(s(k_c), s_{j(k_c)+1}) |e_3' T^{-1}|)",
      report ? report->bound() : std::nullopt, outside);
  starts.capture_samples = sets::quantities::capture_samples();
  set(*starts.capture_samples, "", report ? report->capture_samples() : std::nullopt, outside);
  set(starts.settling_samples, "k_c + n - j(k_c),\\ s_{j(k_c)} \\ge s(k_c)",
      report ? report->settling() : std::nullopt, outside);
  set(starts.settled_frequency_error, "",
      report && report->settling() ? std::optional(report->ultimate()) : std::nullopt, outside);
  set(result.largest_noise, "", above_zero(search.largest_noise), why);
  set(result.largest_slew, "", above_zero(search.largest_slew), why);
  result.bias_frequency = sets::frequency_bias(search.branch);
  return result;
}

}  // namespace

LeakCertificate certify_with_leak(const LeakQuestion& asked) {
  LeakQuestion question = asked;
  question.tracker = with_start_covariance(asked.tracker, midpoint(asked.band));
  const rigor::UpwardRounding upward;
  LeakCertificate certificate;
  theorems::Derivation& derivation = certificate.derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction in a set around the steady state of every frequency of the band";
  derivation.notes = {
      "Covers the tracker in double precision (IEEE 754, round to nearest, sine and cosine within 1 ulp), at "
      "every frequency of the band, for a signal of constant amplitude.",
      "With a leak the tracker settles with a bias; radii are measured from that state, error bounds from "
      "the true signal. Amplitude error and noise are relative to the true amplitude."};
  Search found = search(question, certificate);
  certificate.branch_ends_at = found.branch.ends_at;
  if (is_finite(question.band) && sets::is_well_posed(question.tracker)) {
    replace_by_set_for_more(question, found, certificate);
  }
  std::optional<SteadyReport> report;
  std::optional<Interval> rate;
  if (certificate.set && certificate.set->verdict == Verdict::proved) {
    report.emplace(question.tracker, found.branch, certificate.set->set);
    rate = report->rate();
  }
  derivation.conditions = {{"steady-state", "X^*(\\omega) = G(X^*(\\omega)) \\text{ on the band}",
                            found.branch.verdict, Interval::empty(), Interval::empty(), found.branch.reason},
                           invariant_set(question, found, rate)};
  if (report) {
    derivation.conditions.push_back(report->start_in_set());
    certificate.start = report->start();
  }
  certificate.result = result_of(found, report, rate);
  if (report && question.tracker.with_samples) {
    add_steady_sampled_quantities(claims_of(question.tracker.design, found.branch, certificate.set->set),
                                  derivation);
  }
  sets::conclude(derivation, certificate.result);
  return certificate;
}

}  // namespace veritrack::quadrature

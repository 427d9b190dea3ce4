#include "certificates/quadrature/capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "analysis/quadrature/capture/capture_starts.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/sets/lock_limit.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/quadrature/region.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

namespace {

using quadrature::StartCapture;
using rigor::Interval;
using rigor::Verdict;
using sets::ContractionQuestion;

// Chosen for less than a minute on two cores, together.
constexpr std::size_t kMostCells = 4000;
constexpr std::size_t kMostCellsWithoutNoise = 2000;
constexpr std::size_t kMostCellsAtReducedNoise = 600;

bool is_lock(const quadrature::CertifiedSet& set) {
  const rigor::UpwardRounding upward;
  return sets::excludes_other_locks(quadrature::error_bounds(set, Interval(set.radius))[2]);
}

bool starts_are_outside(const sets::KalmanFilterResult& contraction) {
  const auto& conditions = contraction.starts.conditions;
  return std::any_of(conditions.begin(), conditions.end(), [](const theorems::Condition& condition) {
    return condition.id == "start-in-set" && condition.verdict != Verdict::proved;
  });
}

/// The claim that starts are captured with this noise and slew (the assumed ones by default), whose evidence
/// is the derivation.
Claim claim_of(const Certificate& certificate, const StartCapture& capture, std::string id,
               const std::optional<std::string>& disturbance) {
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  const GuaranteeTerms terms{tables.assume,
                             tables.require,
                             !tables.design.without_leak(),
                             true,
                             covariance_words(quadrature_particulars(certificate).start_covariance,
                                              capture.result.covariance_multiples),
                             kDoublePrecision};
  Claim claim;
  claim.id = std::move(id);
  claim.statement = hypotheses(terms, disturbance.value_or(assumed_disturbance(terms))) +
                    "the tracker enters the certified set, in which the frequency error stays below " +
                    lock_words(terms) + ", and never leaves it.";
  claim.verdict = capture.result.verdict;
  for (const theorems::Condition& condition : capture.result.conditions) {
    if (condition.verdict == claim.verdict) {
      claim.reason = condition.reason;  // of the last one: the condition on the starts, when the set is valid
    }
  }
  for (const theorems::Quantity& quantity : capture.derivation.quantities) {
    if (quantity.applies()) {
      claim.evidence.push_back(quantity);
    }
  }
  return claim;
}

/// Adds the derivation and the claim that all starts are captured under less noise and slew, for the first
/// share that works among a few; otherwise adds nothing.
void add_capture_at_reduced_noise(Certificate& certificate, const quadrature::CertifiedSet& set,
                                  const std::function<bool(const quadrature::RegionProgress&)>& progress) {
  const ContractionQuestion question = contraction_question(certificate.design);
  const StartCovarianceText& covariance = quadrature_particulars(certificate).start_covariance;
  for (const double share : {0.5, 0.25, 0.125}) {
    ContractionQuestion reduced = question;
    reduced.noise = Interval(share) * question.noise;
    reduced.slew = Interval(share) * question.slew;
    StartCapture capture =
        quadrature::capture_starts(reduced, set, "capture/reduced-noise", kMostCellsAtReducedNoise, progress);
    if (capture.result.verdict == Verdict::proved) {
      constexpr int kDigits = 3;
      const auto text = [](const Interval& x) {
        return x.upper() > 0.0 ? rigor::lower_decimal(Interval(x.upper()), kDigits) : std::string();
      };
      certificate.claims.push_back(claim_of(certificate, capture, "ekf/capture-at-reduced-noise",
                                            disturbance_of(text(reduced.noise), text(reduced.slew))));
      certificate.contraction->starts.proved_instead = certificate.claims.back().statement;
      add_start_covariance(covariance, capture.result.covariance_multiples, capture.derivation);
      certificate.derivations.push_back(std::move(capture.derivation));
      return;
    }
  }
}

quadrature::SimulatedBasin basin_of_starts(const ContractionQuestion& question) {
  constexpr int kGrid = 48;
  constexpr int kSamples = 500;
  const std::optional<quadrature::CaptureProblem> problem = quadrature::capture_problem(question);
  return problem ? quadrature::simulate_basin(*problem, quadrature::assumed_starts(question), kGrid, kGrid,
                                              kSamples)
                 : quadrature::SimulatedBasin{};
}

}  // namespace

void add_capture(Certificate& certificate, const CertifyProgress& progress) {
  const auto set = std::find_if(quadrature_particulars(certificate).certified_sets.begin(),
                                quadrature_particulars(certificate).certified_sets.end(),
                                [](const NamedSet& named) { return named.purpose == "start-error"; });
  if (set == quadrature_particulars(certificate).certified_sets.end() ||
      !starts_are_outside(*certificate.contraction) || !is_lock(set->set)) {
    return;
  }
  const search::Deadline never;
  const auto report = region_progress(progress, never);
  ContractionQuestion question = contraction_question(certificate.design);
  StartCapture capture = quadrature::capture_starts(question, set->set, "capture", kMostCells, report);
  const StartCovarianceText covariance = quadrature_particulars(certificate).start_covariance;
  const auto add = [&](theorems::Derivation derivation) {
    if (!derivation.evidence.empty()) {
      add_start_covariance(covariance, std::nullopt, derivation);
    }
    certificate.derivations.push_back(std::move(derivation));
  };
  Claim claim = claim_of(certificate, capture, "ekf/capture", std::nullopt);
  const bool is_disturbed = !(question.noise == Interval(0.0) && question.slew == Interval(0.0));
  std::optional<StartCapture> noise_free;
  if (claim.verdict == Verdict::undecided && is_disturbed) {
    question.noise = Interval(0.0);
    question.slew = Interval(0.0);
    noise_free =
        quadrature::capture_starts(question, set->set, "capture/noise-free", kMostCellsWithoutNoise, report);
    if (noise_free->result.verdict == Verdict::refuted) {
      claim.verdict = Verdict::refuted;
      claim.reason = "Without noise and slew, which is allowed: " +
                     claim_of(certificate, *noise_free, "", std::nullopt).reason;
    }
  }
  sets::StartResult& starts = certificate.contraction->starts;
  starts = std::move(capture.result);
  starts.loses_lock = claim.verdict == Verdict::refuted;
  certificate.claims.push_back(std::move(claim));
  add(std::move(capture.derivation));
  if (noise_free) {
    certificate.claims.push_back(
        claim_of(certificate, *noise_free, "ekf/capture-noise-free", disturbance_of("", "")));
    const bool captured = noise_free->result.verdict == Verdict::proved;
    add(std::move(noise_free->derivation));
    if (captured) {
      starts.proved_instead = certificate.claims.back().statement;
      add_capture_at_reduced_noise(certificate, set->set, report);
    }
  }
  quadrature_particulars(certificate).followed_starts = FollowedStarts{
      std::move(capture.region), basin_of_starts(question), std::move(capture.frequency_errors)};
}

}  // namespace veritrack::certificates
